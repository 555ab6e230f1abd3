#include "services/fake-vehicle/core/duplicate_watch.hpp"

#include <gtest/gtest.h>

namespace aisle::fake_vehicle {
namespace {

using std::chrono::milliseconds;

void hear(DuplicateWatch& watch, std::uint64_t boot, int from_ms, int to_ms) {
  for (int t = from_ms; t <= to_ms; t += 20) watch.heard(boot, milliseconds(t));
}

TEST(DuplicateWatch, TheNewcomerYields) {
  DuplicateWatch newcomer(20);
  hear(newcomer, 10, 0, 300);
  EXPECT_TRUE(newcomer.must_yield(milliseconds(310)));
  DuplicateWatch first(10);
  hear(first, 20, 0, 300);
  EXPECT_TRUE(first.is_duplicate(milliseconds(310)));
  EXPECT_FALSE(first.must_yield(milliseconds(310)));
}

TEST(DuplicateWatch, OwnEchoesAndLeftoversDoNotCount) {
  DuplicateWatch watch(20);
  hear(watch, 20, 0, 1000);
  EXPECT_FALSE(watch.is_duplicate(milliseconds(1000)));
  hear(watch, 10, 1000, 1040);
  EXPECT_FALSE(watch.is_duplicate(milliseconds(1300)));
}

TEST(DuplicateWatch, OneSampleOfAnEarlierProcessTakesTheName) {
  DuplicateWatch newcomer(20);
  EXPECT_FALSE(newcomer.is_taken(milliseconds(0)));
  newcomer.heard(10, milliseconds(0));
  EXPECT_TRUE(newcomer.is_taken(milliseconds(2400)));
  EXPECT_FALSE(newcomer.is_taken(milliseconds(2600)));
  DuplicateWatch first(10);
  first.heard(20, milliseconds(0));
  EXPECT_FALSE(first.is_taken(milliseconds(10)));
}

TEST(DuplicateWatch, EndsWhenTheOtherFallsSilent) {
  DuplicateWatch watch(20);
  hear(watch, 10, 0, 500);
  EXPECT_TRUE(watch.must_yield(milliseconds(2900)));
  EXPECT_FALSE(watch.must_yield(milliseconds(3100)));
}

}  // namespace
}  // namespace aisle::fake_vehicle
