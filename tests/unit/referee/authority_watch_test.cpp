#include "tools/referee/core/authority_watch.hpp"

#include <gtest/gtest.h>

namespace aisle::referee {
namespace {

using Kind = AuthorityViolation::Kind;

VehicleReport obeying(double t_s, std::uint32_t epoch, std::uint64_t sequence, std::uint64_t plan_id,
                      double speed_mps = 1.0) {
  return {"agv-1", 11, t_s, speed_mps, false, "agv-1", "local-planner-agv-1", 22, epoch, sequence, plan_id};
}

TEST(AuthorityWatch, IsContentWithAGoodVehicle) {
  AuthorityWatch watch;
  watch.plan_arrived("agv-1", 5, true, 0.0);
  for (int i = 0; i < 100; ++i) watch.vehicle_reported(obeying(0.02 * i, 1, 10 + static_cast<unsigned>(i), 5));
  EXPECT_TRUE(watch.violations().empty());
}

TEST(AuthorityWatch, NamesACommandForAnotherVehicleOnce) {
  AuthorityWatch watch;
  VehicleReport report = obeying(1.0, 1, 1, 5);
  report.command_agv_id = "agv-2";
  watch.vehicle_reported(report);
  watch.vehicle_reported(report);
  ASSERT_EQ(watch.violations().size(), 1u);
  EXPECT_EQ(watch.violations()[0].kind, Kind::kForeignVehicle);
}

TEST(AuthorityWatch, NamesAnEpochThatWentBackButNotOfARestartedVehicle) {
  AuthorityWatch watch;
  watch.vehicle_reported(obeying(1.0, 3, 1, 0, 0.0));
  VehicleReport restarted = obeying(2.0, 1, 1, 0, 0.0);
  restarted.boot_id = 12;
  watch.vehicle_reported(restarted);
  EXPECT_TRUE(watch.violations().empty());
  VehicleReport higher = obeying(2.5, 4, 1, 0, 0.0);
  higher.boot_id = 12;
  watch.vehicle_reported(higher);
  watch.vehicle_reported(restarted);
  ASSERT_EQ(watch.violations().size(), 1u);
  EXPECT_EQ(watch.violations()[0].kind, Kind::kEpochWentBack);
}

TEST(AuthorityWatch, NamesACommandThatIsOlderThanTheOneBefore) {
  AuthorityWatch watch;
  watch.vehicle_reported(obeying(1.0, 1, 100, 0, 0.0));
  watch.vehicle_reported(obeying(1.1, 1, 100, 0, 0.0));
  EXPECT_TRUE(watch.violations().empty());
  watch.vehicle_reported(obeying(1.2, 1, 99, 0, 0.0));
  ASSERT_EQ(watch.violations().size(), 1u);
  EXPECT_EQ(watch.violations()[0].kind, Kind::kSequenceWentBack);
}

TEST(AuthorityWatch, LetsTheSequenceStartAnewInANewEpoch) {
  AuthorityWatch watch;
  watch.vehicle_reported(obeying(1.0, 1, 100, 0, 0.0));
  watch.vehicle_reported(obeying(1.2, 2, 1, 0, 0.0));
  EXPECT_TRUE(watch.violations().empty());
}

TEST(AuthorityWatch, GivesHalfASecondToTakeANewPlan) {
  AuthorityWatch watch;
  watch.plan_arrived("agv-1", 5, true, 0.0);
  watch.plan_arrived("agv-1", 6, true, 10.0);
  watch.plan_named("agv-1", 6, 10.0);
  watch.vehicle_reported(obeying(10.49, 1, 1, 5));
  EXPECT_TRUE(watch.violations().empty());
  watch.vehicle_reported(obeying(10.51, 1, 2, 5, 0.0));  // it stands: nothing is driven by the old plan
  EXPECT_TRUE(watch.violations().empty());
  watch.vehicle_reported(obeying(10.53, 1, 3, 5));
  ASSERT_EQ(watch.violations().size(), 1u);
  EXPECT_EQ(watch.violations()[0].kind, Kind::kStalePlan);
}

TEST(AuthorityWatch, DoesNotStartTheGraceAnewWhenThePlanIsSentAgain) {
  AuthorityWatch watch;
  watch.plan_arrived("agv-1", 6, true, 10.0);
  watch.plan_arrived("agv-1", 6, true, 10.4);
  watch.plan_named("agv-1", 6, 10.0);
  watch.plan_named("agv-1", 6, 10.5);
  watch.vehicle_reported(obeying(10.6, 1, 1, 5));
  EXPECT_EQ(watch.violations().size(), 1u);
}

/// A planner that is cut off goes on by what it has; once its status names the new plan, it has half a second.
TEST(AuthorityWatch, DoesNotBlameAVehicleThatCannotHaveHeardOfTheNewestPlan) {
  AuthorityWatch watch;
  watch.plan_arrived("agv-1", 5, true, 0.0);
  watch.plan_named("agv-1", 5, 0.1);
  watch.plan_arrived("agv-1", 6, true, 10.0);
  watch.vehicle_reported(obeying(13.0, 1, 1, 5));
  EXPECT_TRUE(watch.violations().empty());
  watch.plan_named("agv-1", 6, 13.0);
  watch.vehicle_reported(obeying(13.4, 1, 2, 5));
  EXPECT_TRUE(watch.violations().empty());
  watch.vehicle_reported(obeying(13.6, 1, 3, 5));
  EXPECT_EQ(watch.violations().size(), 1u);
}

TEST(AuthorityWatch, DoesNotBlameAVehicleThatBrakesByItself) {
  AuthorityWatch watch;
  watch.plan_arrived("agv-1", 6, true, 10.0);
  watch.plan_named("agv-1", 6, 10.0);
  VehicleReport report = obeying(11.0, 1, 1, 5);
  report.holds = true;
  watch.vehicle_reported(report);
  EXPECT_TRUE(watch.violations().empty());
  report.holds = false;
  report.t_s = 11.1;
  watch.vehicle_reported(report);
  EXPECT_EQ(watch.violations().size(), 1u);
}

TEST(AuthorityWatch, LetsAVehicleBrakeWithoutAPlanButNotDriveOn) {
  AuthorityWatch watch;
  watch.plan_arrived("agv-1", 6, false, 10.0);
  watch.vehicle_reported(obeying(10.1, 1, 1, 0));
  watch.vehicle_reported(obeying(11.9, 1, 2, 0));
  EXPECT_TRUE(watch.violations().empty());
  watch.vehicle_reported(obeying(12.2, 1, 3, 0));
  EXPECT_EQ(watch.violations().size(), 1u);
}

}  // namespace
}  // namespace aisle::referee
