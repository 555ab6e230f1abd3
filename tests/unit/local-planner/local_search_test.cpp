#include "services/local-planner/core/local_search.hpp"

#include <gtest/gtest.h>

#include "tests/unit/local-planner/hall.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;

std::function<bool(Point2)> near(Point2 goal) {
  return [goal](Point2 p) { return geometry::distance(p, goal) < 0.25; };
}

void expect_allowed(const Room& room, const std::vector<Point2>& way) {
  for (std::size_t i = 0; i + 1 < way.size(); ++i) EXPECT_TRUE(room.is_line_free(way[i], way[i + 1])) << i;
}

TEST(LocalSearch, GoesAroundWhatStands) {
  const grid::ClearanceField clearance(aisle(3.0));
  const std::vector<Disc> discs{{{10.0, 4.6}, 0.4}};
  const Room room{clearance, discs};
  const auto way = search_way(room, {8.0, 4.6}, {12.0, 4.6}, 6.0, near({12.0, 4.6}));
  ASSERT_GE(way.size(), 3U);
  expect_allowed(room, way);
}

TEST(LocalSearch, PassesOnTheRightWhenBothSidesAreOpen) {
  const grid::ClearanceField clearance(hall(20.0, 10.0));
  const std::vector<Disc> discs{{{10.0, 5.0}, 0.5}};
  const auto way = search_way({clearance, discs}, {8.0, 5.0}, {12.0, 5.0}, 6.0, near({12.0, 5.0}));
  ASSERT_GE(way.size(), 3U);
  for (std::size_t i = 1; i + 1 < way.size(); ++i) EXPECT_LT(way[i].y, 5.0);
}

TEST(LocalSearch, FindsNothingWhereNothingIs) {
  const grid::ClearanceField clearance(aisle(1.6));
  const std::vector<Disc> discs{{{10.0, 5.0}, 0.4}};
  EXPECT_TRUE(search_way({clearance, discs}, {8.0, 5.0}, {12.0, 5.0}, 6.0, near({12.0, 5.0})).empty());
}

TEST(LocalSearch, FindsTheWayOutOfAPlaceWithTooLittleRoom) {
  const grid::ClearanceField clearance(hall(20.0, 10.0));
  const std::vector<Disc> discs{{{10.0, 5.0}, 0.4}};
  const Room room{clearance, discs};
  const Point2 from{9.3, 5.0};
  ASSERT_LT(room.spare_m(from), 0.0);
  const auto way = search_way(room, from, {8.0, 5.0}, 4.0, [&](Point2 p) { return room.spare_m(p) > 0.1; });
  ASSERT_GE(way.size(), 2U);
  double spare = room.spare_m(from);
  for (double t = 0.1; t <= 1.0; t += 0.1) {
    const double next = room.spare_m(from + t * (way.back() - from));
    EXPECT_GE(next, spare - 1e-9);
    spare = next;
  }
}

TEST(Room, SparesTheLeastOfWallsAndDiscs) {
  const grid::ClearanceField clearance(aisle(3.0));
  const std::vector<Disc> discs{{{10.0, 5.0}, 0.4}};
  const Room room{clearance, discs, 0.35, 0.1, 0.15};
  EXPECT_NEAR(room.spare_m({10.0, 4.0}), std::min(0.5 - 0.45, 1.0 - 0.9), 0.03);
  EXPECT_NEAR(room.spare_m({4.0, 5.0}), 1.0, 1e-9);
}

}  // namespace
}  // namespace aisle::local_planner
