// WU's rolling window, closed loop: detours where they are needed, none where not, and back to the path.
#include "tools/lab/driving/window_cases.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace aisle::lab {
namespace {

WindowDrive drive_named(const std::string& name) {
  const std::vector<WindowCase> cases = window_cases();
  const auto found = std::find_if(cases.begin(), cases.end(), [&](const WindowCase& of) { return of.name == name; });
  return drive_window_case(*found);
}

TEST(WindowCases, WhoPassesAheadIsNoReasonForADetour) {
  const WindowDrive drive = drive_named("window-ahead");
  EXPECT_EQ(drive.result.goals_reached, 1);
  EXPECT_EQ(drive.result.contacts, 0);
  EXPECT_LT(drive.farthest_off_m, 0.3);
}

TEST(WindowCases, WhoPassesBehindIsNoReasonForADetour) {
  const WindowDrive drive = drive_named("window-behind");
  EXPECT_EQ(drive.result.goals_reached, 1);
  EXPECT_EQ(drive.result.contacts, 0);
  EXPECT_LT(drive.farthest_off_m, 0.3);
}

TEST(WindowCases, ACollisionCourseIsLeftAndThePathTakenAgain) {
  const WindowDrive drive = drive_named("window-collision");
  EXPECT_GT(drive.sub_target_s, 0.3);
  EXPECT_EQ(drive.result.goals_reached, 1);
  EXPECT_EQ(drive.result.contacts_moving_vehicle, 0);
  EXPECT_TRUE(drive.farthest_off_m > 0.1 || drive.slowest_mps < 0.6) << "it neither left the path nor slowed";
  EXPECT_LT(drive.back_on_it_m, 0.2);
}

TEST(WindowCases, WhoComesTowardsItIsDrivenAroundAndThePathTakenAgain) {
  const WindowDrive drive = drive_named("window-oncoming");
  EXPECT_EQ(drive.result.goals_reached, 1);
  EXPECT_EQ(drive.result.contacts, 0);
  EXPECT_GT(drive.farthest_off_m, 1.0) << "keeping right alone is 0.8 m";
  EXPECT_GT(drive.slowest_mps, 0.2);
  EXPECT_LT(drive.back_on_it_m, 0.2);
}

TEST(WindowCases, AnUnknownBoxIsDrivenAround) {
  const WindowDrive drive = drive_named("window-box");
  EXPECT_EQ(drive.result.goals_reached, 1);
  EXPECT_EQ(drive.result.contacts, 0);
  EXPECT_GT(drive.farthest_off_m, 0.7);
  EXPECT_LT(drive.back_on_it_m, 0.2);
}

TEST(WindowCases, BeforeAClosedAisleItStopsAndAsksForAnotherPlan) {
  const WindowDrive drive = drive_named("window-closed");
  EXPECT_EQ(drive.result.goals_reached, 0);
  EXPECT_EQ(drive.result.contacts, 0);
  EXPECT_TRUE(drive.asked_for_a_plan);
}

}  // namespace
}  // namespace aisle::lab
