#include "tools/lab/driving/encounters.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>

#include "common/grid/clearance.hpp"
#include "services/fake-world/core/walker.hpp"
#include "tests/support/places.hpp"
#include "tools/lab/driving/fused_drive.hpp"
#include "tools/lab/planning/paper_maps.hpp"

namespace aisle::lab {
namespace {

const std::filesystem::path kMaps = test_support::source_folder() / "deploy/experiments";

DrawnMap map_named(const std::string& name) { return read_drawn_map(kMaps / (name + ".txt"), 1.0); }

/// From (0.5, y) to the other end, in the middle of a hall of `length` x `width` cells.
DrawnMap hall(int length, int width) {
  DrawnMap map{grid::OccupancyGrid(grid::Geometry{length, width, 1.0, {0.0, 0.0}}), {}, {}};
  map.start_in_map = {0.5, 0.5 * width};
  map.goal_in_map = {length - 0.5, 0.5 * width};
  return map;
}

void expect_same(const Encounters& a, const Encounters& b) {
  ASSERT_EQ(a.movers.size(), b.movers.size());
  ASSERT_EQ(a.boxes.size(), b.boxes.size());
  for (std::size_t i = 0; i < a.movers.size(); ++i) {
    EXPECT_EQ(a.movers[i].waypoints_in_map, b.movers[i].waypoints_in_map);
    EXPECT_EQ(a.movers[i].start_s, b.movers[i].start_s);
  }
  for (std::size_t i = 0; i < a.boxes.size(); ++i)
    EXPECT_EQ(a.boxes[i].center_in_map.position(), b.boxes[i].center_in_map.position());
}

TEST(Encounters, StandWhereLiPrintsThem) {
  const Encounters there = encounters_of_paper("li-complex", map_named("li-complex"), {1, 2}, 2.0);
  ASSERT_EQ(there.movers.size(), 1U);
  EXPECT_EQ(there.movers[0].waypoints_in_map, (std::vector<geometry::Point2>{{14.0, 7.0}, {14.0, 11.0}}));
  EXPECT_EQ(there.boxes.size(), 2U);
}

// QU, figures 6 and 7; a map without its movers shows nothing.
TEST(Encounters, AreOneAndTwoMoversOnBothMapsOfQu) {
  for (const char* name : {"qu-simple", "qu-maze"}) {
    EXPECT_EQ(encounters_of_paper(name, map_named(name), {1, 0}, 2.0).movers.size(), 1U) << name;
    EXPECT_EQ(encounters_of_paper(name, map_named(name), {2, 0}, 2.0).movers.size(), 2U) << name;
  }
}

TEST(Encounters, AreTheSameForEveryContestant) {
  const DrawnMap map = paper_map(*find_paper_map_kind("wang-map-1"), 1);
  const local_planner::Variant wang = paper_variant("wang");
  const Encounters there = encounters_on(map, {1, 1}, wang.paper.max_speed_mps);
  expect_same(there, encounters_on(map, {1, 1}, wang.paper.max_speed_mps));
  ASSERT_EQ(there.movers.size(), 1U);

  const DriveFigures own = drive_fused({"wang-map-2", "wang", wang, wang.paper, {1, 1}}, kMaps);
  const DriveFigures other = drive_fused({"wang-map-2", "astar", traditional_with_path(), wang.paper, {1, 1}}, kMaps);
  expect_same(own.encounters, other.encounters);
  EXPECT_TRUE(own.met_a_mover());
  EXPECT_TRUE(other.met_a_mover());
}

TEST(Encounters, HaveAMoverOnThePathWhenTheNominalVehicleIsThere) {
  const DrawnMap map = hall(21, 9);
  const double speed_mps = 1.5;
  const Encounters there = encounters_on(map, {1, 0}, speed_mps);
  ASSERT_EQ(there.movers.size(), 1U);
  const scenario::Mover& mover = there.movers[0];
  fake_world::Walker walker(mover, {});
  const double crossing_s = (mover.waypoints_in_map[0].x - map.start_in_map.x) / nominal_speed_mps(speed_mps);
  walker.step(crossing_s - mover.start_s, {});
  EXPECT_NEAR(walker.motion().position_in_map.y, map.start_in_map.y, 0.1);
  EXPECT_NEAR(std::abs(mover.waypoints_in_map[0].y - mover.waypoints_in_map[1].y), 2.8, 1e-6);
  EXPECT_FALSE(mover.courteous);
}

TEST(Encounters, HaveBoxesThatAVehicleCanPass) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    const DrawnMap map = paper_map(*find_paper_map_kind("wu"), seed);
    const grid::ClearanceField clearance(map.grid, 4.0);
    for (const scenario::Block& box : encounters_on(map, {0, 2}, 1.0).boxes)
      EXPECT_GE(clearance.clearance_m(box.center_in_map.position()), 0.25 + 0.7) << seed;
  }
  EXPECT_TRUE(encounters_on(hall(21, 1), {0, 1}, 1.0).boxes.empty()) << "it would close the aisle";
}

TEST(Encounters, AreNoneWhereNoneAreAskedFor) {
  const Encounters there = encounters_on(hall(21, 9), {}, 1.0);
  EXPECT_TRUE(there.movers.empty() && there.boxes.empty());
}

}  // namespace
}  // namespace aisle::lab
