#include "services/obstacle-tracker/core/coverage.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "tests/unit/obstacle-tracker/simulated_lidar.hpp"

namespace aisle::obstacle_tracker {
namespace {

using namespace std::chrono_literals;
using geometry::Point2;

constexpr double kCell_m = 0.5;

grid::Geometry ground(double width_m, double height_m) {
  return {
      static_cast<int>(std::lround(width_m / 0.05)), static_cast<int>(std::lround(height_m / 0.05)), 0.05, {0.0, 0.0}};
}

/// A lidar that measures exactly.
Scan exact_scan(const test::World& world, geometry::Pose2 base_in_map, time::Stamp stamp, int rays = 360) {
  Scan scan;
  scan.agv_id = "agv-1";
  scan.stamp = stamp;
  scan.base_in_map = base_in_map;
  scan.angle_step_rad = 2.0 * geometry::kPi / rays;
  scan.range_min_m = 0.05;
  for (int i = 0; i < rays; ++i) {
    const double range_m =
        world.ray_m(base_in_map.position(), base_in_map.yaw + scan.angle_step_rad * i, scan.range_max_m);
    scan.ranges_m.push_back(static_cast<float>(range_m));
  }
  return scan;
}

/// Age code of the cell that holds the point; never seen where no tile is.
std::uint8_t age_at(const std::vector<CoverageTile>& tiles, Point2 in_map) {
  for (const CoverageTile& tile : tiles) {
    const int x = static_cast<int>(std::floor((in_map.x - tile.low_in_map.x) / tile.cell_m));
    const int y = static_cast<int>(std::floor((in_map.y - tile.low_in_map.y) / tile.cell_m));
    if (x < 0 || y < 0 || x >= tile.width_cells || y >= tile.height_cells) continue;
    return tile
        .ages[static_cast<std::size_t>(y) * static_cast<std::size_t>(tile.width_cells) + static_cast<std::size_t>(x)];
  }
  return kNeverSeen;
}

/// Marches from the sensor: is there nothing on the way, but for a graze that lies between two rays?
bool is_way_clear(const test::World& world, Point2 from, Point2 to, double graze_m) {
  const double away_m = geometry::distance(from, to);
  for (double s = 0.0; s < away_m; s += 0.02) {
    const Point2 at = from + (s / away_m) * (to - from);
    if (world.clearance.clearance_m(at) <= 0.0) return false;
    for (const test::Disc& disc : world.discs)
      if (geometry::distance(at, disc.center_in_map) < disc.radius_m - graze_m) return false;
  }
  return true;
}

/// All around the cell's inner disc, and a little wider: one ray's distance.
bool is_fan_clear(const test::World& world, Point2 from, Point2 center) {
  const double away_m = geometry::distance(from, center);
  const double half_rad = 0.25 * kCell_m / away_m + 2.2 * geometry::kPi / 180.0;
  const double middle_rad = geometry::bearing(from, center);
  for (double angle_rad = middle_rad - half_rad; angle_rad <= middle_rad + half_rad; angle_rad += 0.004)
    if (world.ray_m(from, angle_rad, 20.0) < away_m + 0.02) return false;
  return true;
}

test::World crowded_room(std::mt19937_64& random) {
  test::World world(test::room(16.0, 12.0));
  std::uniform_real_distribution<double> across(1.0, 15.0), up(1.0, 11.0), radius(0.2, 0.6);
  for (int i = 0; i < 12; ++i) world.discs.push_back({{across(random), up(random)}, radius(random)});
  return world;
}

Point2 free_place(const test::World& world, std::mt19937_64& random) {
  std::uniform_real_distribution<double> across(1.0, 15.0), up(1.0, 11.0);
  for (;;) {
    const Point2 place{across(random), up(random)};
    const bool is_free = std::none_of(world.discs.begin(), world.discs.end(), [&](const test::Disc& d) {
      return geometry::distance(place, d.center_in_map) < d.radius_m + 0.4;
    });
    if (is_free) return place;
  }
}

TEST(Coverage, AgreesWithRaysThatAreMarched) {
  std::mt19937_64 random(7);
  int seen = 0, hidden = 0;
  for (int scene = 0; scene < 4; ++scene) {
    const test::World world = crowded_room(random);
    const Point2 from = free_place(world, random);
    Coverage coverage;
    coverage.set_ground(world.grid.geometry());
    coverage.take(exact_scan(world, {from.x, from.y, 0.3 * scene}, 10s));
    const std::vector<CoverageTile> tiles = coverage.due(10s);
    for (double y = 0.25; y < 12.0; y += kCell_m) {
      for (double x = 0.25; x < 16.0; x += kCell_m) {
        const Point2 center{x, y};
        const double away_m = geometry::distance(from, center);
        if (away_m < 0.3 || std::abs(away_m - 10.0) < 0.01) continue;
        const bool is_seen = age_at(tiles, center) == 0;
        seen += is_seen ? 1 : 0;
        hidden += is_seen ? 0 : 1;
        const auto where = [&] {
          return "scene " + std::to_string(scene) + ", cell at " + std::to_string(x) + ", " + std::to_string(y);
        };
        if (is_seen) {
          EXPECT_LT(away_m, 10.0) << where();
          EXPECT_TRUE(is_way_clear(world, from, center, 0.03)) << where();
        } else {
          EXPECT_FALSE(away_m < 10.0 && is_fan_clear(world, from, center)) << where();
        }
      }
    }
  }
  EXPECT_GT(seen, 300);
  EXPECT_GT(hidden, 300);
}

TEST(Coverage, WhatNobodyLookedAtWasNeverSeen) {
  test::World world(test::room(16.0, 12.0));
  test::fill(world.grid, {8.0, 0.0}, {8.1, 12.0});  // a wall between two halves
  world.clearance = grid::ClearanceField(world.grid);
  Coverage coverage;
  coverage.set_ground(world.grid.geometry());
  coverage.take(exact_scan(world, {4.0, 6.0, 0.0}, 10s));
  const auto tiles = coverage.due(11s);
  EXPECT_EQ(age_at(tiles, {6.25, 6.25}), 2);  // a second ago
  EXPECT_EQ(age_at(tiles, {10.25, 6.25}), kNeverSeen);
}

TEST(Coverage, AgesGoOnUntilACellIsSeenAgain) {
  const test::World world(test::room(16.0, 12.0));
  Coverage coverage;
  coverage.set_ground(world.grid.geometry());
  coverage.take(exact_scan(world, {4.0, 6.0, 0.0}, 10s));
  EXPECT_EQ(age_at(coverage.due(10s), {6.25, 6.25}), 0);
  EXPECT_EQ(age_at(coverage.due(20'100ms), {6.25, 6.25}), 21);  // rounded up
  coverage.take(exact_scan(world, {4.0, 6.0, 0.0}, 21s));
  Scan late = exact_scan(world, {5.0, 6.0, 0.0}, 20s);
  late.agv_id = "agv-2";
  coverage.take(late);
  EXPECT_EQ(age_at(coverage.due(21s), {6.25, 6.25}), 0) << "a late scan made it older";
  EXPECT_EQ(age_code(0s, 126'900ms), 254);
  EXPECT_EQ(age_code(0s, 126'400ms), 253);
  EXPECT_EQ(age_code(0s, 3600s), kSeenLongAgo);
  EXPECT_EQ(age_code(time::Stamp::min(), 3600s), kNeverSeen);
}

TEST(Coverage, SeveralVehiclesSeeMoreThanOne) {
  test::World world(test::room(16.0, 12.0));
  test::fill(world.grid, {8.0, 0.0}, {8.1, 12.0});
  world.clearance = grid::ClearanceField(world.grid);
  Coverage coverage;
  coverage.set_ground(world.grid.geometry());
  coverage.take(exact_scan(world, {4.0, 6.0, 0.0}, 10s));
  Scan other = exact_scan(world, {12.0, 6.0, 0.0}, 10s);
  other.agv_id = "agv-2";
  coverage.take(other);
  const auto tiles = coverage.due(10s);
  EXPECT_EQ(age_at(tiles, {6.25, 6.25}), 0);
  EXPECT_EQ(age_at(tiles, {10.25, 6.25}), 0);
}

TEST(Coverage, APartialFanSeesNothingBesideIt) {
  const test::World world(test::room(16.0, 12.0));
  Scan scan = exact_scan(world, {8.0, 6.0, 0.0}, 10s);
  scan.ranges_m.resize(91);  // ahead to the left
  Coverage coverage;
  coverage.set_ground(world.grid.geometry());
  coverage.take(scan);
  const auto tiles = coverage.due(10s);
  EXPECT_EQ(age_at(tiles, {10.25, 8.25}), 0);
  EXPECT_EQ(age_at(tiles, {10.25, 3.75}), kNeverSeen);
  EXPECT_EQ(age_at(tiles, {5.75, 8.25}), kNeverSeen);
  EXPECT_EQ(age_at(tiles, {5.75, 3.75}), kNeverSeen);
}

TEST(Coverage, RaysThatSawNothingReachAsFarAsTheSensorAndTooNearOnesNowhere) {
  Scan scan = exact_scan(test::World(test::room(40.0, 40.0)), {20.0, 20.0, 0.0}, 10s);
  std::fill(scan.ranges_m.begin(), scan.ranges_m.end(), std::numeric_limits<float>::infinity());
  for (int i = 80; i < 100; ++i)
    scan.ranges_m[static_cast<std::size_t>(i)] = 0.01F;  // something hangs before the sensor
  Coverage coverage;
  coverage.set_ground(ground(40.0, 40.0));
  coverage.take(scan);
  const auto tiles = coverage.due(10s);
  EXPECT_EQ(age_at(tiles, {29.25, 20.25}), 0);
  EXPECT_EQ(age_at(tiles, {30.75, 20.25}), kNeverSeen);
  EXPECT_EQ(age_at(tiles, {20.25, 23.25}), kNeverSeen);
}

TEST(Coverage, TellsOnlyTilesThatWereSeenAndNotThoseWithoutNews) {
  Coverage coverage;
  EXPECT_TRUE(coverage.due(10s).empty());
  coverage.take(exact_scan(test::World(test::room(16.0, 12.0)), {4.0, 6.0, 0.0}, 10s));
  EXPECT_TRUE(coverage.due(10s).empty()) << "there is no ground yet";
  coverage.set_ground(ground(100.0, 70.0));  // 32 m a tile: 4 x 3
  Scan scan = exact_scan(test::World(test::room(100.0, 70.0)), {90.0, 53.0, 0.0}, 11s);
  coverage.take(scan);
  const auto tiles = coverage.due(11s);
  ASSERT_EQ(tiles.size(), 2U);  // 80 to 100 m across, 43 to 63 m up
  EXPECT_EQ(tiles[0].tile_x, 2U);
  EXPECT_EQ(tiles[0].width_cells, 64);
  EXPECT_EQ(tiles[1].tile_x, 3U);
  EXPECT_EQ(tiles[1].tile_y, 1U);
  EXPECT_EQ(tiles[1].width_cells, 8);  // of 100 m, 96 are in three tiles
  EXPECT_EQ(tiles[1].height_cells, 64);
  EXPECT_EQ(tiles[1].ages.size(), 8U * 64U);
  EXPECT_DOUBLE_EQ(tiles[1].low_in_map.x, 96.0);
  EXPECT_TRUE(coverage.due(12s).empty());
  EXPECT_EQ(coverage.due(21'500ms).size(), 2U) << "a late joiner would take old ages for new ones";
}

TEST(Coverage, ForgetsWhenTheGroundIsAnother) {
  const test::World world(test::room(16.0, 12.0));
  Coverage coverage;
  coverage.set_ground(world.grid.geometry());
  coverage.take(exact_scan(world, {4.0, 6.0, 0.0}, 10s));
  EXPECT_EQ(coverage.due(10s).size(), 1U);
  EXPECT_TRUE(coverage.set_ground(world.grid.geometry()).empty());
  const auto gone = coverage.set_ground(ground(20.0, 20.0));
  ASSERT_EQ(gone.size(), 1U);
  EXPECT_EQ(gone.front(), (std::pair<std::uint32_t, std::uint32_t>{0, 0}));
  EXPECT_TRUE(coverage.due(30s).empty());
}

}  // namespace
}  // namespace aisle::obstacle_tracker
