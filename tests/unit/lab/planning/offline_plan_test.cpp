#include "tools/lab/planning/offline_plan.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/ascii_grid.hpp"

namespace aisle::lab {
namespace {

const std::vector<std::string> kRooms{"S....", ".###.", "..#G#", "..###"};

class OfflinePlan : public ::testing::Test {
 protected:
  OfflinePlan() {
    task_.queries = {{test_support::find_letter(kRooms, 'S'), {4.5, 2.5}, 0.0}};
    planners_ = {global_planner::find_variant("astar"), global_planner::find_variant("theta")};
  }
  OfflineResult run() const {
    return plan_offline(task_, planners_, clearance_, [] { return false; });
  }
  grid::ClearanceField clearance_{test_support::grid_from_text(kRooms), 10.0};
  OfflineTask task_;
  std::vector<const global_planner::Variant*> planners_;
};

TEST_F(OfflinePlan, AsksEveryPlannerAndComparesASingleQueryWithTheGridsOptimum) {
  const OfflineResult result = run();
  ASSERT_EQ(result.tallies.size(), 2U);
  EXPECT_EQ(result.tallies[0].solved(), 1);
  EXPECT_DOUBLE_EQ(result.tallies[0].length_ratio_mean(), 1.0);
  EXPECT_LE(result.tallies[1].length_ratio_mean(), 1.0);
  ASSERT_EQ(result.paths.size(), 2U);
  EXPECT_EQ(result.paths[1].name, "theta");
  EXPECT_EQ(result.refusal, "");
}

TEST_F(OfflinePlan, SaysWhyTheFirstRefusedQueryWasRefused) {
  task_.queries.front().goal_in_map = test_support::find_letter(kRooms, 'G');
  const OfflineResult result = run();
  EXPECT_EQ(result.tallies[0].solved(), 0);
  EXPECT_THAT(result.paths, testing::IsEmpty());
  EXPECT_NE(result.refusal, "");
}

TEST_F(OfflinePlan, GoesToTheNearestPlaceWhenItMay) {
  task_.queries.front().goal_in_map = test_support::find_letter(kRooms, 'G');
  task_.goes_to_nearest = true;
  EXPECT_EQ(run().tallies[0].solved(), 1);
}

TEST_F(OfflinePlan, NeedsClearancesAsFarAsTheLargestOfItsDistances) {
  task_.radius_m = 0.4;
  task_.preferred_clearance_m = 1.5;
  EXPECT_DOUBLE_EQ(task_.needed_clearance_m(), 1.5);
  task_.outline = geometry::Footprint{geometry::rectangle(4.0, 3.0)};
  EXPECT_DOUBLE_EQ(task_.needed_clearance_m(), 2.5);
}

TEST_F(OfflinePlan, EndsWhenInterrupted) {
  const OfflineResult result = plan_offline(task_, planners_, clearance_, [] { return true; });
  EXPECT_EQ(result.tallies[0].asked(), 0);
}

}  // namespace
}  // namespace aisle::lab
