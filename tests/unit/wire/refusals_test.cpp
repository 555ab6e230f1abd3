// What each codec refuses, field by field: the sample of the golden bytes with one field spoiled. The reason names the
// field. Codecs of the map and of vehicle_info have their own tests.
#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "common/wire/codecs.hpp"
#include "tests/unit/bus/golden_samples.hpp"

namespace aisle::wire {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class Sample>
struct Spoiled {
  std::string field;  // the reason begins with it
  std::function<void(Sample&)> spoil;
};

template <class Sample>
void expect_refusals(const std::vector<Spoiled<Sample>>& cases) {
  Sample sound;
  bus_test::fill(sound);
  ASSERT_EQ(decode(sound).reason(), "");
  for (const auto& [field, spoil] : cases) {
    Sample sample = sound;
    spoil(sample);
    EXPECT_EQ(decode(sample).reason().rfind(field, 0), 0U) << field << ": '" << decode(sample).reason() << "'";
  }
}

TEST(Refusals, OfAGoal) {
  expect_refusals<aisle::Goal>({
      {"agv_id", [](auto& s) { s.agv_id(""); }},
      {"agv_id", [](auto& s) { s.agv_id("agv\t1"); }},
      {"goal_id", [](auto& s) { s.goal_id(""); }},
      {"pose_in_map", [](auto& s) { s.pose_in_map().x_m(kNan); }},
      {"pose_in_map", [](auto& s) { s.pose_in_map().y_m(1e7); }},
      {"pose_in_map", [](auto& s) { s.pose_in_map().yaw_rad(100.0); }},
      {"position_tolerance_m", [](auto& s) { s.position_tolerance_m(-0.1); }},
      {"position_tolerance_m", [](auto& s) { s.position_tolerance_m(kInfinity); }},
      {"yaw_tolerance_rad", [](auto& s) { s.yaw_tolerance_rad(kNan); }},
  });
}

TEST(Refusals, OfAPlan) {
  expect_refusals<aisle::Plan>({
      {"agv_id", [](auto& s) { s.agv_id(""); }},
      {"goal_id", [](auto& s) { s.goal_id("goal\n1"); }},
      {"map_id", [](auto& s) { s.map_id("\x7f"); }},
      {"outcome", [](auto& s) { s.outcome(static_cast<PlanOutcome>(7)); }},
      {"trigger", [](auto& s) { s.trigger(static_cast<PlanTrigger>(-1)); }},
      {"planner", [](auto& s) { s.planner("\n"); }},
      {"goal_in_map", [](auto& s) { s.goal_in_map().x_m(-1e7); }},
      {"position_tolerance_m", [](auto& s) { s.position_tolerance_m(101.0); }},
      {"yaw_tolerance_rad", [](auto& s) { s.yaw_tolerance_rad(-1.0); }},
      {"waypoints_in_map", [](auto& s) { s.waypoints_in_map()[1].y_m(kNan); }},
      {"waypoints_in_map has 0",
       [](auto& s) {
         s.outcome(PlanOutcome::PLAN_FOUND);
         s.waypoints_in_map().clear();
       }},
      {"length_m", [](auto& s) { s.length_m(-1.0); }},
      {"planning_ms", [](auto& s) { s.planning_ms(kInfinity); }},
  });
}

TEST(Refusals, OfANavigationStatus) {
  expect_refusals<aisle::NavigationStatus>({
      {"agv_id", [](auto& s) { s.agv_id(""); }},
      {"goal_id", [](auto& s) { s.goal_id("\n"); }},
      {"phase", [](auto& s) { s.phase(static_cast<NavigationPhase>(8)); }},
      {"reason", [](auto& s) { s.reason(static_cast<NavigationReason>(17)); }},
      {"distance_left_m", [](auto& s) { s.distance_left_m(kNan); }},
      {"time_left_s", [](auto& s) { s.time_left_s(kInfinity); }},
      {"blocked_at_in_map", [](auto& s) { s.blocked_at_in_map().x_m(kNan); }},
      {"blocked_radius_m", [](auto& s) { s.blocked_radius_m(-0.1); }},
      {"control_ms", [](auto& s) { s.control_ms(kNan); }},
      {"intent.offset_s", [](auto& s) { s.intent()[0].offset_s(-0.1); }},
      {"intent.offset_s", [](auto& s) { s.intent().push_back(IntentPoint{}); }},  // before the one ahead of it
      {"intent.base_in_map", [](auto& s) { s.intent()[0].base_in_map().y_m(kNan); }},
  });
}

TEST(Refusals, OfAVehicleState) {
  expect_refusals<aisle::VehicleState>({
      {"agv_id", [](auto& s) { s.agv_id(""); }},
      {"base_in_map", [](auto& s) { s.base_in_map().x_m(kNan); }},
      {"twist", [](auto& s) { s.twist().linear_mps(101.0); }},
      {"steering_rad", [](auto& s) { s.steering_rad(3.2); }},
      {"hold", [](auto& s) { s.hold(static_cast<HoldReason>(5)); }},
  });
}

/// The pose is good without the command.
TEST(Refusals, NotOfAVehicleStateForTheCommandInForce) {
  const std::function<void(aisle::VehicleState&)> spoils[]{
      [](auto& s) { s.command_agv_id(""); },
      [](auto& s) { s.command_agv_id("\n"); },
      [](auto& s) { s.command_by().source_id(""); },
      [](auto& s) { s.command_by().source_id("a\nb"); },
      [](auto& s) { s.command_by().sequence_number(0); },
  };
  aisle::VehicleState sound;
  bus_test::fill(sound);
  ASSERT_TRUE(decode(sound)->command.has_value());
  for (const auto& spoil : spoils) {
    aisle::VehicleState sample = sound;
    spoil(sample);
    const auto decoded = decode(sample);
    ASSERT_TRUE(static_cast<bool>(decoded)) << decoded.reason();
    EXPECT_FALSE(decoded->command.has_value());
    EXPECT_EQ(decoded->accepted_epoch, sound.accepted_epoch());
  }
}

TEST(Refusals, OfAScan) {
  expect_refusals<aisle::Scan>({{"agv_id", [](auto& s) { s.agv_id(""); }}});
}

TEST(Refusals, OfAVelocityCommand) {
  expect_refusals<aisle::VelocityCommand>({
      {"agv_id", [](auto& s) { s.agv_id(""); }},
      {"goal_id", [](auto& s) { s.goal_id("\n"); }},
      {"twist", [](auto& s) { s.twist().linear_mps(kNan); }},
      {"twist", [](auto& s) { s.twist().angular_radps(-101.0); }},
      {"twist", [](auto& s) { s.twist().sideways_mps(kInfinity); }},
  });
}

/// It is for people, and drives nothing.
TEST(Refusals, NotOfAVelocityCommandForItsComputingTime) {
  for (const double bad : {kNan, kInfinity}) {
    aisle::VelocityCommand sample;
    bus_test::fill(sample);
    sample.control_ms(bad);
    const auto decoded = decode(sample);
    ASSERT_TRUE(static_cast<bool>(decoded)) << decoded.reason();
    EXPECT_EQ(decoded->control_ms, 0.0);
  }
}

TEST(Refusals, OfAWorldObstacle) {
  expect_refusals<aisle::WorldObstacle>({
      {"obstacle_id", [](auto& s) { s.obstacle_id(""); }},
      {"kind", [](auto& s) { s.kind(static_cast<BodyKind>(3)); }},
      {"shape", [](auto& s) { s.shape(static_cast<FootprintKind>(2)); }},
      {"base_in_map", [](auto& s) { s.base_in_map().yaw_rad(kNan); }},
      {"velocity_x_mps", [](auto& s) { s.velocity_x_mps(101.0); }},
      {"velocity_y_mps", [](auto& s) { s.velocity_y_mps(kNan); }},
      {"radius_m", [](auto& s) { s.radius_m(-1.0); }},
      {"length_m", [](auto& s) { s.length_m(1001.0); }},
      {"width_m", [](auto& s) { s.width_m(kNan); }},
      {"ahead_m", [](auto& s) { s.ahead_m(-1001.0); }},
  });
}

TEST(Refusals, OfATrack) {
  expect_refusals<aisle::Track>({
      {"position_in_map", [](auto& s) { s.position_in_map().x_m(kNan); }},
      {"velocity_x_mps", [](auto& s) { s.velocity_x_mps(101.0); }},
      {"velocity_y_mps", [](auto& s) { s.velocity_y_mps(kNan); }},
      {"covariance", [](auto& s) { s.covariance()[15] = kNan; }},
      {"radius_m", [](auto& s) { s.radius_m(101.0); }},
      {"age_s", [](auto& s) { s.age_s(kInfinity); }},
      {"unseen_s", [](auto& s) { s.unseen_s(kNan); }},
  });
}

TEST(Refusals, OfATrackingStatus) {
  expect_refusals<aisle::TrackingStatus>({
      {"source_id", [](auto& s) { s.source_id(""); }},
      {"newest_scans.agv_id", [](auto& s) { s.newest_scans()[0].agv_id(""); }},
      {"processing_ms", [](auto& s) { s.processing_ms(kNan); }},
  });
}

TEST(Refusals, OfCoverage) {
  expect_refusals<aisle::Coverage>({
      {"source_id", [](auto& s) { s.source_id(""); }},
      {"map_id", [](auto& s) { s.map_id("\n"); }},
      {"low_in_map", [](auto& s) { s.low_in_map().x_m(kNan); }},
      {"cell_m", [](auto& s) { s.cell_m(0.0); }},
      {"age_step_s", [](auto& s) { s.age_step_s(kNan); }},
      {"width_cells", [](auto& s) { s.width_cells(0); }},
      {"height_cells", [](auto& s) { s.height_cells(5000); }},
      {"ages has 5", [](auto& s) { s.ages().pop_back(); }},
  });
}

TEST(Refusals, OfServiceHealth) {
  expect_refusals<aisle::ServiceHealth>({
      {"instance_id", [](auto& s) { s.instance_id(""); }},
      {"service", [](auto& s) { s.service("\n"); }},
      {"host", [](auto& s) { s.host("\n"); }},
      {"state", [](auto& s) { s.state(static_cast<ServiceState>(5)); }},
      {"cpu_percent", [](auto& s) { s.cpu_percent(kNan); }},
      {"resident_mb", [](auto& s) { s.resident_mb(kInfinity); }},
  });
}

TEST(Refusals, OfAMapRequest) {
  expect_refusals<aisle::MapRequest>({
      {"requester_id", [](auto& s) { s.requester_id(""); }},
      {"map_id", [](auto& s) { s.map_id("\n"); }},
  });
}

}  // namespace
}  // namespace aisle::wire
