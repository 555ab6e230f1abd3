#include "common/wire/json/json.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace aisle::wire {
namespace {

TEST(JsonOf, APlanHasItsFieldsInTheOrderOfTheIdl) {
  aisle::Plan plan;
  plan.agv_id(std::string("agv-1"));
  plan.outcome(PlanOutcome::PLAN_GOAL_BLOCKED);
  plan.trigger(PlanTrigger::TRIGGER_TAKEOVER);
  plan.plan_id(7);
  aisle::Point point;
  point.x_m(1.5);
  point.y_m(2.0);
  plan.waypoints_in_map().push_back(point);
  const Json json = to_json(plan);
  EXPECT_EQ(json.begin().key(), "agv_id");
  EXPECT_EQ(json["outcome"], "goal_blocked");
  EXPECT_EQ(json["trigger"], "takeover");
  EXPECT_EQ(json["plan_id"], 7);
  EXPECT_EQ(write_json(json["waypoints_in_map"]), R"([{"x_m":1.5,"y_m":2.0}])");
}

TEST(JsonOf, EnumeratorsCoversTheLastOfEach) {
  aisle::Plan plan;
  plan.outcome(PlanOutcome::PLAN_CANCELLED);
  EXPECT_EQ(to_json(plan)["outcome"], "cancelled");
  aisle::NavigationStatus status;
  status.phase(NavigationPhase::PHASE_HELD);
  status.reason(NavigationReason::REASON_PERSON);
  EXPECT_EQ(to_json(status)["phase"], "held");
  EXPECT_EQ(to_json(status)["reason"], "person");
  aisle::VehicleState state;
  state.hold(HoldReason::HOLD_PERSON);
  EXPECT_EQ(to_json(state)["hold"], "person");
  aisle::ServiceHealth health;
  health.state(ServiceState::SERVICE_STOPPING);
  EXPECT_EQ(to_json(health)["state"], "stopping");
  aisle::MapEditResult result;
  result.outcome(EditOutcome::EDIT_REFUSED);
  EXPECT_EQ(to_json(result)["outcome"], "refused");
  health.state(static_cast<ServiceState>(7));
  EXPECT_EQ(to_json(health)["state"], "7");
}

TEST(JsonOf, NumbersThatAreNoneAndBytesThatAreNoTextCanBeWritten) {
  aisle::NavigationStatus status;
  status.distance_left_m(std::nan(""));
  status.detail(std::string("\xff broken"));
  const std::string text = write_json(to_json(status));
  EXPECT_NE(text.find("\"distance_left_m\":null"), std::string::npos);
  EXPECT_NE(text.find("broken"), std::string::npos);
}

TEST(JsonOf, HashesKeepAllTheirDigits) {
  aisle::MapInfo info;
  info.hash(0xfedcba9876543210u);
  EXPECT_EQ(to_json(info)["hash"], "0xfedcba9876543210");
}

}  // namespace
}  // namespace aisle::wire
