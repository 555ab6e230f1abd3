#include "tools/lab/driving/fused_drive.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <regex>
#include <sstream>

#include "common/config/reader.hpp"
#include "tests/support/places.hpp"
#include "tools/lab/driving/curves_svg.hpp"

namespace aisle::lab {
namespace {

const std::filesystem::path kMaps = test_support::source_folder() / "deploy/experiments";

FusedDrive wang_drive(const Surprises& surprises) {
  const local_planner::Variant wang = paper_variant("wang");
  return {"wang-1", "wang", wang, wang.paper, surprises};
}

TEST(FusedDrive, IsHardlyLongerThanItsPlan) {
  const DriveFigures figures = drive_fused(wang_drive({}), kMaps);
  EXPECT_TRUE(figures.arrived());
  EXPECT_EQ(figures.result.contacts, 0);
  EXPECT_GT(figures.result.planned_m, 25.0);
  EXPECT_LE(figures.result.distance_m, 1.03 * figures.result.planned_m);
  EXPECT_GT(figures.changes_of_v(), 1.0) << "it sped up and braked";
}

TEST(FusedDrive, AvoidsWhatThePaperPutsInTheWay) {
  const DriveFigures figures = drive_fused(wang_drive({1, 1}), kMaps);
  EXPECT_TRUE(figures.arrived());
  EXPECT_EQ(figures.movers, 1);
  EXPECT_TRUE(figures.met_a_mover()) << "nothing to avoid: " << figures.nearest_mover_m();
  EXPECT_EQ(figures.result.contacts_moving_vehicle, 0);
}

/// One moment of a drive past one mover and one box.
DriveFigures driven_past(double mover_gap_m, double box_gap_m) {
  DriveFigures figures;
  DrivePoint point;
  point.linear_mps = 1.0;
  point.mover_gap_m = mover_gap_m;
  point.box_gap_m = box_gap_m;
  figures.points = {point};
  figures.encounters.movers.resize(1);
  figures.encounters.boxes.resize(1);
  return figures;
}

TEST(FusedDrive, MetBothKindsOfWhatWasPlaced) {
  const double near_m = 0.5 * kMetWithinM, far_m = 2.0 * kMetWithinM;
  EXPECT_TRUE(driven_past(near_m, near_m).met({1, 1}));
  EXPECT_FALSE(driven_past(near_m, far_m).met({1, 1})) << "no box";
  EXPECT_FALSE(driven_past(far_m, near_m).met({1, 1})) << "no mover";
  EXPECT_TRUE(driven_past(far_m, far_m).met({0, 0})) << "nothing was asked for";
}

TEST(FusedDrive, CanMeetOnlyWhatTheMapHadAPlaceFor) {
  const double near_m = 0.5 * kMetWithinM, far_m = 2.0 * kMetWithinM;
  DriveFigures without_box = driven_past(near_m, far_m);
  without_box.encounters.boxes.clear();
  EXPECT_TRUE(without_box.met({1, 1}));

  DriveFigures without_any = driven_past(far_m, far_m);
  without_any.encounters = {};
  EXPECT_FALSE(without_any.met({0, 1})) << "such a drive shows nothing";
}

FusedDrive own_drive(const std::string& map, const std::string& paper, const Surprises& surprises) {
  const local_planner::Variant variant = paper_variant(paper);
  return {map, paper, variant, variant.paper, surprises};
}

TEST(FusedDrive, TurnsSharplyFromOneNarrowAisleIntoAnother) {
  const DriveFigures figures = drive_fused(own_drive("li-complex", "li", {}), kMaps);
  EXPECT_TRUE(figures.arrived());
  EXPECT_EQ(figures.result.contacts, 0);
  EXPECT_LE(figures.result.distance_m, 1.03 * figures.result.planned_m);
  EXPECT_LT(figures.result.driven_s, 60.0) << "it stood at the corner";
}

TEST(FusedDrive, GoesThroughADoorThatItSeesFromAfar) {
  const DriveFigures figures = drive_fused(own_drive("yu-1", "yu", {0, 1}), kMaps);
  EXPECT_TRUE(figures.arrived());
  EXPECT_EQ(figures.result.contacts, 0);
  EXPECT_LE(figures.result.distance_m, 1.05 * figures.result.planned_m);
  EXPECT_LT(figures.result.driven_s, 50.0) << "it was driven off its way before the door";
}

TEST(FusedDrive, MeetsOneAndTwoMoversOnQusMaps) {
  for (const char* map : {"qu-simple", "qu-maze"}) {
    const DriveFigures alone = drive_fused(own_drive(map, "qu", {}), kMaps);
    const DriveFigures one = drive_fused(own_drive(map, "qu", {1, 0}), kMaps);
    const DriveFigures two = drive_fused(own_drive(map, "qu", {2, 0}), kMaps);
    EXPECT_EQ(alone.movers + one.movers + two.movers, 0 + 1 + 2) << map;
    EXPECT_TRUE(one.met_a_mover() && two.met_a_mover()) << map;
    EXPECT_NE(one.changes_of_v(), alone.changes_of_v()) << map << ": it reacts to the mover";
    EXPECT_NE(two.changes_of_v(), one.changes_of_v()) << map << ": it reacts to the second one";
  }
}

TEST(FusedDrive, GoesOnWhenWhoCrossedHasPassed) {
  const DriveFigures figures = drive_fused(own_drive("wang-map-2", "wang", {1, 1}), kMaps);
  EXPECT_TRUE(figures.met_a_mover());
  EXPECT_TRUE(figures.arrived());
  EXPECT_EQ(figures.result.contacts_moving_vehicle, 0);
  EXPECT_LE(figures.result.distance_m, 1.03 * figures.result.planned_m) << "it backed off in vain";
}

TEST(FusedDrive, IsSlowerNearThingsWithWusCriticsThanWithTheTraditional) {
  const local_planner::PaperLimits limits = paper_variant("wu").paper;
  const DriveFigures own = drive_fused({"wu", "wu", paper_variant("wu"), limits, {0, 1}, false}, kMaps);
  const DriveFigures traditional = drive_fused({"wu", "wu", traditional_with_path(), limits, {0, 1}, false}, kMaps);
  ASSERT_TRUE(own.arrived() && traditional.arrived());
  EXPECT_LT(own.mean_speed_near(0.6), traditional.mean_speed_near(0.6));
  EXPECT_EQ(own.mean_speed_near(-1.0), 0.0);
}

TEST(FusedDrive, KeepsToThePapersLimits) {
  const DriveFigures figures = drive_fused(wang_drive({}), kMaps);
  for (const DrivePoint& p : figures.points) {
    EXPECT_LE(p.linear_mps, 1.5 + 1e-9);
    EXPECT_LE(std::abs(p.angular_radps), local_planner::from_degrees(40.0) + 1e-9);
  }
}

TEST(FusedDrive, NeedsItsMap) {
  FusedDrive drive = wang_drive({});
  drive.map = "no-such-map";
  EXPECT_THROW(drive_fused(drive, kMaps), config::BadInput);
}

TEST(CurvesSvg, ShowsEveryDrive) {
  DriveFigures figures;
  figures.points = {{0.0, {}, 0.0, 0.0}, {1.0, {}, 1.0, 0.5}};
  const std::string svg = curves_svg("speeds", {{"one", &figures}, {"two", &figures}});
  EXPECT_NE(svg.find(">one<"), std::string::npos);
  EXPECT_NE(svg.find(">two<"), std::string::npos);
  EXPECT_EQ(svg.rfind("<svg", 0), 0U);
}

/// The heights in pixels of the curve that is drawn last, which is the attitude's.
std::vector<double> heights_of_last_curve(const std::string& svg) {
  std::vector<double> heights;
  const std::size_t from = svg.rfind(" d=\"", svg.rfind("stroke-linejoin")) + 4;
  std::istringstream numbers(
      std::regex_replace(svg.substr(from, svg.find('"', from) - from), std::regex("[ML,]"), " "));
  for (double x = 0.0, y = 0.0; numbers >> x >> y;) heights.push_back(y);
  return heights;
}

TEST(CurvesSvg, ShowsTheAttitudeWithoutAJumpAtHalfATurn) {
  DriveFigures figures;
  figures.points = {{0.0, {0.0, 0.0, 3.1}, 0.0, 0.0}, {1.0, {0.0, 0.0, -3.1}, 0.0, 0.0}};
  const std::string svg = curves_svg("speeds", {{"one", &figures}});
  EXPECT_NE(svg.find(">attitude (heading in the map), rad<"), std::string::npos);

  const std::vector<double> heights = heights_of_last_curve(svg);
  ASSERT_EQ(heights.size(), 2U) << svg;
  EXPECT_LT(heights[1], heights[0]) << "it turns left, upwards";
  EXPECT_LT(heights[0] - heights[1], 10.0) << "by a hundredth of a turn";
}

}  // namespace
}  // namespace aisle::lab
