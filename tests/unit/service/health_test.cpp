#include "common/service/health.hpp"

#include <gtest/gtest.h>

namespace aisle::service {
namespace {

TEST(Health, CountsAtMostThirtyTwoNames) {
  Health health;
  for (int i = 0; i < 40; ++i) health.count("c" + std::to_string(i));
  health.count("c0", 4);
  EXPECT_EQ(health.counters.size(), 32U);
  EXPECT_EQ(health.counters["c0"], 5U);
}

TEST(Health, ListsWhatIsWaitedForWithinTheRoomOfTheSample) {
  Health health;
  health.wait_for("map_info");
  health.wait_for("scan");
  EXPECT_EQ(health.waits_for, "map_info, scan");
  for (int i = 0; i < 100; ++i) health.wait_for(std::string(50, 'x'));
  EXPECT_LE(health.waits_for.size(), 256U);
}

}  // namespace
}  // namespace aisle::service
