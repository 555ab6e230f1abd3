#include "tools/cli/cli.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

#include "tests/support/refusal.hpp"
#include "tools/cli/coordinates.hpp"
#include "tools/cli/edit_shape.hpp"
#include "tools/cli/fleet_view.hpp"
#include "tools/cli/rates.hpp"
#include "tools/cli/topic_table.hpp"
#include "tools/cli/traffic_picture.hpp"
#include "tools/cli/traffic_view.hpp"

namespace aisle::cli {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test_support::refusal_of;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Coordinates, OfAPoseMayHaveAYaw) {
  const TypedPose plain = parse_pose("goal", " -4.5,1e1");
  EXPECT_EQ(plain.in_map.x, -4.5);
  EXPECT_EQ(plain.in_map.y, 10.0);
  EXPECT_FALSE(plain.has_yaw);
  const TypedPose turned = parse_pose("goal", "1,2,4");
  EXPECT_TRUE(turned.has_yaw);
  EXPECT_NEAR(turned.in_map.yaw, 4.0 - 2.0 * geometry::kPi, 1e-12);
}

TEST(Coordinates, ThatDoNotFitAreRefusedWithAnExample) {
  for (const char* text : {"", "1", "1,2,3,4", "1,", ",1", "a,b", "1;2", "nan,1", "inf,0", "1,2 x", "1e9,0", "0x1,2"}) {
    EXPECT_THAT(refusal_of([&] { parse_pose("goal", text); }), HasSubstr("write e.g. 4.5,12")) << text;
  }
}

TEST(Coordinates, OfAFootprintAreLengthWidthAndHowFarItLiesAhead) {
  const geometry::Footprint centred = parse_footprint("--footprint", "2.4,1.1");
  EXPECT_FALSE(centred.is_disc());
  EXPECT_EQ(centred.length_m, 2.4);
  EXPECT_EQ(centred.width_m, 1.1);
  EXPECT_EQ(centred.ahead_m, 0.0);
  EXPECT_EQ(parse_footprint("--footprint", "2.4,1.1,-0.4").ahead_m, -0.4);
  for (const char* text : {"", "2.4", "1,2,3,4", "2.4,0", "-1,1", "2.4,nan", "2.4x1.1", "101,1", "1,1,-200"}) {
    EXPECT_THAT(refusal_of([&] { parse_footprint("--footprint", text); }), HasSubstr("write e.g. 2.4,1.1")) << text;
  }
}

TEST(Arguments, WithAMinusAndADigitAreNoFlags) {
  const char* argv[] = {"aisle", "goal", "send", "agv-1", "-4,5", "-.5,1", "--json", "-h", "-"};
  EXPECT_THAT(protect_negative_numbers(9, argv),
              ElementsAre("aisle", "goal", "send", "agv-1", " -4,5", " -.5,1", "--json", "-h", "-"));
}

TEST(EditShape, IsOneOfThree) {
  fleet::MapEdit rectangle;
  set_shape({"1,2,3,4", "", {}}, rectangle);
  EXPECT_EQ(rectangle.shape, fleet::MapEdit::Shape::kRectangle);
  ASSERT_EQ(rectangle.points_in_map.size(), 2u);
  EXPECT_EQ(rectangle.points_in_map[1].y, 4.0);
  fleet::MapEdit disc;
  set_shape({"", "1,2,0.5", {}}, disc);
  EXPECT_EQ(disc.shape, fleet::MapEdit::Shape::kDisc);
  EXPECT_EQ(disc.radius_m, 0.5);
  fleet::MapEdit polygon;
  set_shape({"", "", {"0,0", "4,0", "2,3"}}, polygon);
  EXPECT_EQ(polygon.shape, fleet::MapEdit::Shape::kPolygon);
  EXPECT_EQ(polygon.points_in_map.size(), 3u);
}

TEST(EditShape, ThatDoesNotFitIsRefused) {
  fleet::MapEdit edit;
  EXPECT_THAT(refusal_of([&] { set_shape({}, edit); }), HasSubstr("give one shape"));
  EXPECT_THAT(refusal_of([&] { set_shape({"1,2,3,4", "1,2,3", {}}, edit); }), HasSubstr("give one shape"));
  EXPECT_THAT(refusal_of([&] { set_shape({"1,2,1,4", "", {}}, edit); }), HasSubstr("has no area"));
  EXPECT_THAT(refusal_of([&] { set_shape({"1,2,3", "", {}}, edit); }), HasSubstr("has 3 numbers, not 4"));
  EXPECT_THAT(refusal_of([&] { set_shape({"", "1,2,0", {}}, edit); }), HasSubstr("must be above 0"));
  EXPECT_THAT(refusal_of([&] { set_shape({"", "", {"0,0", "1,1"}}, edit); }), HasSubstr("2 corners; give 3 to 64"));
}

TEST(TopicTable, FindsNamesAndSuggestsTheNearest) {
  EXPECT_EQ(find_topic("plan").type, "aisle::Plan");
  EXPECT_EQ(refusal_of([] { find_topic("velocity_comand"); }),
            "unknown topic 'velocity_comand'; did you mean 'velocity_command'?");
  EXPECT_EQ(refusal_of([] { find_topic("thermometer"); }), "unknown topic 'thermometer'; see aisle topic list");
  EXPECT_EQ(text_of(find_topic("plan").qos), "reliable, transient local, keep last 1, exclusive, lease 200 ms");
  EXPECT_EQ(text_of(find_topic("map_edit").qos, History::kNotAnnounced), "reliable");
}

TEST(Rate, CountsGapsBetweenSamples) {
  Rate rate;
  EXPECT_EQ(rate.hz(), 0.0);
  for (const int ms : {0, 20, 40, 100}) rate.add(milliseconds(ms), 64);
  EXPECT_EQ(rate.samples(), 4u);
  EXPECT_DOUBLE_EQ(rate.hz(), 30.0);
  EXPECT_NEAR(rate.mean_gap_ms(), 33.333, 1e-3);
  EXPECT_DOUBLE_EQ(rate.longest_gap_ms(), 60.0);
  EXPECT_DOUBLE_EQ(rate.bytes_per_s(), 30.0 * 64);
}

fleet::VehicleState state_of(const std::string& agv_id) {
  fleet::VehicleState state;
  state.agv_id = agv_id;
  state.motion.twist.linear_mps = 0.8;
  state.hold = fleet::Hold::kNone;
  return state;
}

fleet::TrafficStatus status_of_two_that_wait() {
  fleet::TrafficStatus status;
  status.source_id = "global-planner-1";
  status.vehicles = 4;
  status.with_goal = 3;
  status.share_of_places = 0.125;
  status.waiting = {{"agv-1", "agv-2", "the lane is taken", 7.2}, {"agv-3", "", "no way free", 1.0}};
  status.silent = {{"agv-4", {3.0, 4.5}}};
  return status;
}

TEST(FleetView, ShowsWhatAVehicleDoesAndWhenItIsSilent) {
  FleetView view;
  view.take(state_of("agv-1"), seconds(10));
  fleet::NavigationStatus status;
  status.agv_id = "agv-1";
  status.goal_id = "g7";
  status.phase = fleet::Phase::kBlocked;
  status.reason = fleet::Reason::kObstacle;
  status.distance_left_m = 12.34;
  view.take(status);
  const std::string text = text_of_fleet(view.snapshot(seconds(10)));
  EXPECT_THAT(text, HasSubstr("agv-1    blocked  obstacle  g7    12.3    0.80       0.00  0.00  -"));
  EXPECT_THAT(text_of_fleet(view.snapshot(milliseconds(11001))), HasSubstr("offline"));
  view.lose_navigation("agv-1");
  EXPECT_THAT(text_of_fleet(view.snapshot(seconds(10))), HasSubstr("no local planner"));
}

TEST(FleetView, TellsForWhichVehicleOneWaitsAndWhy) {
  FleetView view;
  view.take(state_of("agv-1"), seconds(10));
  view.take(status_of_two_that_wait(), {}, seconds(10));
  EXPECT_THAT(text_of_fleet(view.snapshot(seconds(10))), HasSubstr("-     agv-2 7 s: the lane is taken"));
}

TEST(FleetView, KnowsServicesThatAreGone) {
  FleetView view;
  fleet::ServiceHealth health;
  health.instance_id = "map";
  health.state = fleet::ServiceState::kWaiting;
  health.waits_for = "map_info";
  view.take(health, {});
  EXPECT_THAT(text_of_fleet(view.snapshot(seconds(1))), HasSubstr("map      waiting  map_info"));
  view.lose_service("map");
  EXPECT_THAT(text_of_fleet(view.snapshot(seconds(1))), HasSubstr("gone"));
}

/// In the second epoch.
fleet::Origin second_leader() {
  fleet::Origin by;
  by.source_id = "global-planner-1";
  by.epoch = 2;
  return by;
}

TEST(TrafficView, TellsWhichVehicleWaitsForWhichSinceWhenAndWhy) {
  TrafficView view;
  EXPECT_FALSE(view.has_leader());
  view.take(status_of_two_that_wait(), second_leader(), seconds(10));
  fleet::NavigationStatus status;
  status.agv_id = "agv-1";
  status.goal_id = "g7";
  status.reason = fleet::Reason::kNoGrant;
  view.take(status);
  const std::string text = text_of_traffic(view.snapshot(milliseconds(10500)));
  EXPECT_THAT(text, HasSubstr("leader global-planner-1, epoch 2, heard 0.5 s ago"));
  EXPECT_THAT(text, HasSubstr("4 vehicles, 3 with a goal; 12.5 % of the places taken (saturated)"));
  EXPECT_THAT(text, HasSubstr("0 refused, 0 circles"));
  EXPECT_THAT(text, HasSubstr("agv-1    agv-2      7.2      waiting  no_grant  the lane is taken"));
  EXPECT_THAT(text, HasSubstr("agv-3    -          1.0      -        -         no way free"));
  EXPECT_THAT(text, HasSubstr("agv-4   3.00  4.50"));
}

TEST(TrafficView, TellsOfAVehicleThatStandsWithoutBeingNamedByTheLeader) {
  TrafficView view;
  view.take(fleet::TrafficStatus{}, second_leader(), seconds(10));
  fleet::NavigationStatus status;
  status.agv_id = "agv-9";
  status.goal_id = "g1";
  status.phase = fleet::Phase::kBlocked;
  status.reason = fleet::Reason::kObstacle;
  status.detail = "a box";
  view.take(status);
  EXPECT_THAT(text_of_traffic(view.snapshot(seconds(10))), HasSubstr("agv-9    -          -        blocked  obstacle"));
  status.phase = fleet::Phase::kDriving;
  view.take(status);
  EXPECT_THAT(text_of_traffic(view.snapshot(seconds(10))), HasSubstr("no vehicle waits"));
}

TEST(TrafficView, BelievesTheHigherEpochUntilItIsGone) {
  TrafficView view;
  view.take(status_of_two_that_wait(), second_leader(), seconds(10));
  fleet::TrafficStatus old;
  old.source_id = "global-planner-2";
  fleet::Origin first = second_leader();
  first.epoch = 1;
  view.take(old, first, seconds(11));
  EXPECT_EQ(view.snapshot(seconds(11))["leader"]["source_id"], "global-planner-1");
  view.lose_planner("global-planner-2");
  EXPECT_TRUE(view.has_leader());
  view.lose_planner("global-planner-1");
  EXPECT_FALSE(view.has_leader());
}

/// agv-1 at (1, 1), agv-2 at (3, 1); agv-1 waits for agv-2 and may drive to 1.5 m of its way.
TEST(TrafficPicture, ShowsPlansGrantsAndAnArrowToTheWaitedForVehicle) {
  TrafficView view;
  view.take(status_of_two_that_wait(), second_leader(), seconds(10));
  fleet::VehicleState first = state_of("agv-1");
  first.motion.base_in_map = {1.0, 1.0, 0.0};
  view.take(first);
  fleet::VehicleState second = state_of("agv-2");
  second.motion.base_in_map = {3.0, 1.0, 0.0};
  view.take(second);
  fleet::Plan plan;
  plan.agv_id = "agv-1";
  plan.id = 5;
  plan.waypoints_in_map = {{1.0, 1.0}, {2.0, 1.0}, {2.0, 3.0}};
  view.take(plan);
  fleet::Grant grant;
  grant.agv_id = "agv-1";
  grant.number = 1;
  grant.plan_id = 5;
  grant.limit_m = 1.5;
  view.take(grant);
  const std::vector<DrawnVehicle> drawn = view.drawn();
  ASSERT_EQ(drawn.size(), 2u);
  EXPECT_EQ(drawn[0].granted_m, 1.5);
  EXPECT_EQ(drawn[0].waits_for, "agv-2");
  const std::string svg = traffic_svg(grid::OccupancyGrid({40, 40, 0.1, {0.0, 0.0}}, grid::Occupancy::kFree), drawn);
  EXPECT_THAT(svg, HasSubstr("agv-1 waits for agv-2"));
  EXPECT_THAT(svg, HasSubstr("marker-end=\"url(#tip)\""));
  EXPECT_THAT(svg, HasSubstr("stroke-width=\"5\" stroke-linecap"));
  grant.plan_id = 4;  // of another plan: its length says nothing of this one
  view.take(grant);
  EXPECT_EQ(view.drawn()[0].granted_m, 0.0);
}

TEST(TrafficPicture, CutsTheGrantedPartOutOfAWay) {
  const std::vector<geometry::Point2> way{{0.0, 0.0}, {2.0, 0.0}, {2.0, 2.0}};
  const std::vector<geometry::Point2> part = part_of(way, 1.0, 3.0);
  ASSERT_EQ(part.size(), 3u);
  EXPECT_DOUBLE_EQ(part[0].x, 1.0);
  EXPECT_DOUBLE_EQ(part[2].y, 1.0);
  EXPECT_TRUE(part_of(way, 3.0, 3.0).empty());
  EXPECT_TRUE(part_of(way, 5.0, 9.0).empty());
}

}  // namespace
}  // namespace aisle::cli
