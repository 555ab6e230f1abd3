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

}  // namespace
}  // namespace aisle::cli
