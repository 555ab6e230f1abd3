#include "services/fake-vehicle/core/body_book.hpp"

#include <gtest/gtest.h>

namespace aisle::fake_vehicle {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

geometry::Body disc_at(double x) {
  geometry::Body body;
  body.base_in_map.x = x;
  body.radius_m = 0.3;
  return body;
}

TEST(BodyBook, LeavesOutItself) {
  BodyBook book("agv-1");
  book.seen("agv-1", disc_at(1), true, 1, seconds(0));
  book.seen("agv-2", disc_at(2), true, 1, seconds(0));
  ASSERT_EQ(book.bodies().size(), 1u);
  EXPECT_DOUBLE_EQ(book.bodies()[0].base_in_map.x, 2.0);
}

TEST(BodyBook, KeepsTheNewestPlaceUntilGone) {
  BodyBook book("agv-1");
  book.seen("p", disc_at(1), false, 1, seconds(0));
  book.seen("p", disc_at(3), false, 1, seconds(1));
  ASSERT_EQ(book.bodies().size(), 1u);
  EXPECT_DOUBLE_EQ(book.bodies()[0].base_in_map.x, 3.0);
  book.gone("p");
  EXPECT_TRUE(book.bodies().empty());
}

TEST(BodyBook, ASilentVehicleBlocksItsPlace) {
  BodyBook book("agv-1");
  book.seen("agv-2", disc_at(1), true, 1, seconds(0));
  book.seen("p", disc_at(5), false, 9, seconds(60));
  book.forget_old_world(seconds(120));
  EXPECT_EQ(book.bodies().size(), 2u);
}

TEST(BodyBook, ForgetsWhatARestartedWorldDoesNotShow) {
  BodyBook book("agv-1");
  book.seen("left", disc_at(1), false, 1, seconds(0));
  book.seen("stays", disc_at(2), false, 1, seconds(0));
  book.forget_old_world(seconds(10));
  EXPECT_EQ(book.bodies().size(), 2u) << "the world is silent, not restarted";
  book.seen("stays", disc_at(2), false, 2, seconds(10));
  book.forget_old_world(seconds(10) + milliseconds(500));
  EXPECT_EQ(book.bodies().size(), 2u) << "the rest may still come";
  book.forget_old_world(seconds(12));
  EXPECT_EQ(book.bodies().size(), 1u);
}

}  // namespace
}  // namespace aisle::fake_vehicle
