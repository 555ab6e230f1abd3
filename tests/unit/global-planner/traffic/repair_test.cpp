#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>

#include "tests/unit/global-planner/traffic/roadmap_checks.hpp"

namespace aisle::global_planner::traffic {
namespace {

using geometry::Point2;
using grid::Cell;

/// Sets the cells of a rectangle, in metres, and tells field and roadmap.
void edit(FloorMap& floor, Roadmap& roadmap, Point2 low_in_map, Point2 high_in_map, grid::Occupancy to) {
  const grid::Geometry& g = floor.grid.geometry();
  Cell low = g.cell_at(low_in_map);
  Cell high = g.cell_at(high_in_map);
  low = {std::max(low.x, 0), std::max(low.y, 0)};
  high = {std::min(high.x, g.width - 1), std::min(high.y, g.height - 1)};
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x) floor.grid.set({x, y}, to);

  floor.clearance.update(floor.grid, low, high);
  roadmap.set_map(floor.clearance, low, high);
}

/// Mean of way over the roadmap / way over the grid, between all places at least 3 m apart and every tenth.
double mean_detour(const FloorMap& floor, Roadmap& roadmap) {
  const grid::Geometry& g = floor.grid.geometry();
  const auto cell_of = [&](PlaceId id) { return g.cell_at(roadmap.place(id).base_in_map.position()); };
  const auto places = lattice(roadmap);
  double sum = 0.0;
  int count = 0;

  for (std::size_t i = 0; i < places.size(); i += 10) {
    const auto metres = grid_distances_m(floor, cell_of(places[i]), kNeedM);
    const auto& table = roadmap.seconds_to(places[i]);
    for (const PlaceId from : places) {
      const double direct_m = metres[g.index(cell_of(from))];
      if (!std::isfinite(direct_m) || direct_m < 3.0) continue;
      sum += table[from] * 0.9 * cart().limits.max_speed_mps / direct_m;
      ++count;
    }
  }

  return count > 0 ? sum / count : 1.0;
}

TEST(Repair, AWallThroughARoomParts) {
  FloorMap floor = room();
  auto made = made_for(floor);
  const PlaceId left = made.roadmap.nearest(made.kind, {1.5, 4.0, 0.0});
  const PlaceId right = made.roadmap.nearest(made.kind, {11.5, 4.0, 0.0});

  edit(floor, made.roadmap, {6.0, 0.0}, {6.2, 9.0}, grid::Occupancy::kOccupied);
  EXPECT_FALSE(std::isfinite(made.roadmap.seconds_to(left, right)));
  edit(floor, made.roadmap, {6.0, 3.0}, {6.2, 5.0}, grid::Occupancy::kFree);
  EXPECT_TRUE(std::isfinite(made.roadmap.seconds_to(left, right)));
  expect_sound(floor, made.roadmap, kNeedM, 1.0);
  expect_joined_as_the_floor(floor, made.roadmap, kNeedM);
}

TEST(Repair, AVehicleInsideMayLeaveUntilThePlaceIsSwept) {
  FloorMap floor = room();
  auto made = made_for(floor);
  Roadmap& roadmap = made.roadmap;
  const PlaceId inside = roadmap.nearest(made.kind, {6.1, 4.0, 0.0});
  const PlaceId right = roadmap.nearest(made.kind, {11.5, 4.0, 0.0});

  edit(floor, roadmap, {6.0, 0.0}, {6.9, 9.0}, grid::Occupancy::kOccupied);
  EXPECT_TRUE(roadmap.place(inside).is_closed);
  EXPECT_TRUE(std::isfinite(roadmap.seconds_to(inside, right)));
  EXPECT_FALSE(std::isfinite(roadmap.seconds_to(right, inside)));
  roadmap.sweep({inside}, {});
  EXPECT_TRUE(std::isfinite(roadmap.seconds_to(inside, right)));
  roadmap.sweep({}, {});
  EXPECT_TRUE(roadmap.place(inside).standing.empty());
}

TEST(Repair, WhereTheFloorCameBackIsANewPlace) {
  FloorMap floor = room();
  auto made = made_for(floor);
  Roadmap& roadmap = made.roadmap;
  const PlaceId before = roadmap.nearest(made.kind, {6.1, 4.0, 0.0});
  const geometry::Pose2 there = roadmap.place(before).base_in_map;

  edit(floor, roadmap, {5.0, 3.0}, {7.0, 5.0}, grid::Occupancy::kOccupied);
  edit(floor, roadmap, {5.0, 3.0}, {7.0, 5.0}, grid::Occupancy::kFree);
  const PlaceId after = roadmap.temporary_place(made.kind, there);
  ASSERT_NE(after, kNoId);
  EXPECT_NE(after, before);
  EXPECT_FALSE(roadmap.place(after).is_closed);
}

TEST(Repair, ChangesNothingFarAway) {
  FloorMap floor = all_floors()[2];  // the demo warehouse
  auto made = made_for(floor);
  std::map<MotionId, std::vector<Point2>> before;
  for (MotionId id = 0; id < made.roadmap.motions(); ++id) before[id] = made.roadmap.motion(id).path_in_map;

  edit(floor, made.roadmap, {20.0, 13.0}, {20.6, 13.6}, grid::Occupancy::kOccupied);
  for (const auto& [id, path] : before) {
    const bool is_far = std::all_of(path.begin(), path.end(), [](Point2 p) { return distance(p, {20.3, 13.3}) > 4.0; });
    if (!is_far) continue;
    ASSERT_FALSE(made.roadmap.motion(id).is_closed);
    ASSERT_EQ(made.roadmap.motion(id).path_in_map, path);
  }
}

// After many edits, walls and gaps at random, the roadmap has the properties of one that is made anew.
TEST(Repair, AfterManyEditsHasThePropertiesOfANewOne) {
  std::mt19937 random(21);
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };

  for (FloorMap floor : {lane_with_bay(), room(30, 24)}) {
    const grid::OccupancyGrid original = floor.grid;
    const Box box = floor_box(floor.clearance);
    auto made = made_for(floor);

    for (int round = 0; round < 16; ++round) {
      const Point2 low{uniform(0.5, box.high_in_map.x - 2.0), uniform(0.5, box.high_in_map.y - 2.0)};
      const Point2 high = low + Point2{uniform(0.1, 2.5), uniform(0.1, 1.5)};
      edit(floor, made.roadmap, low, high, random() % 2 == 0 ? grid::Occupancy::kOccupied : grid::Occupancy::kFree);
      if (round % 5 == 4) made.roadmap.sweep({}, {});
      if (round % 4 != 3) continue;

      expect_sound(floor, made.roadmap, kNeedM, 1.0);
      expect_joined_as_the_floor(floor, made.roadmap, kNeedM);
      if (HasFatalFailure()) return;
    }

    auto anew = made_for(floor);
    EXPECT_LE(mean_detour(floor, made.roadmap), mean_detour(floor, anew.roadmap) + 0.05) << floor.name;
  }
}

}  // namespace
}  // namespace aisle::global_planner::traffic
