#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "services/global-planner/core/traffic/pose_lattice.hpp"
#include "tests/unit/global-planner/traffic/roadmap_checks.hpp"

namespace aisle::global_planner::traffic {
namespace {

using geometry::Point2;
using geometry::Pose2;

/// A block of racks with aisles of 4 m round it.
FloorMap ring() {
  std::vector<std::string> lines{std::string(42, '#')};
  for (int y = 0; y < 28; ++y) {
    const bool is_block = y >= 8 && y < 20;
    lines.push_back("#" + std::string(8, '.') + std::string(24, is_block ? '#' : '.') + std::string(8, '.') + "#");
  }
  lines.push_back(lines.front());
  return {"ring", half_metre_grid(lines)};
}

const FloorMap& warehouse() {
  static const FloorMap floor = all_floors()[2];
  return floor;
}

/// Is each point of the outline, every 10 cm, on a free cell?
bool is_outline_free(const FloorMap& floor, const Kind& kind, const Pose2& base_in_map) {
  const auto& f = kind.footprint;
  for (double x = -0.5; x <= 0.5001; x += 0.04)
    for (double y = -0.5; y <= 0.5001; y += 0.1)
      if (!floor.grid.is_free(
              floor.grid.geometry().cell_at(to_map(base_in_map, {f.ahead_m + x * f.length_m, y * f.width_m}))))
        return false;
  return true;
}

/// The motion starts and ends in the poses of its places, its headings follow its path, it turns no tighter than the
/// vehicle may, and the outline touches nothing.
void expect_drivable(const FloorMap& floor, const Roadmap& roadmap, const Motion& motion) {
  const Kind& kind = roadmap.kind(motion.kind);
  const auto& path = motion.path_in_map;
  const auto& headings = motion.headings_rad;
  ASSERT_EQ(path.size(), headings.size());
  ASSERT_EQ(path.front(), roadmap.place(motion.from).base_in_map.position());
  ASSERT_EQ(path.back(), roadmap.place(motion.to).base_in_map.position());
  ASSERT_NEAR(geometry::wrap(headings.front() - roadmap.place(motion.from).base_in_map.yaw), 0.0, 1e-6);
  ASSERT_NEAR(geometry::wrap(headings.back() - roadmap.place(motion.to).base_in_map.yaw), 0.0, 1e-6);

  for (std::size_t i = 1; i < path.size(); ++i) {
    const double turn = geometry::wrap(headings[i] - headings[i - 1]);
    const double length_m = distance(path[i - 1], path[i]);
    const double along = geometry::bearing(path[i - 1], path[i]) + (motion.is_reverse ? geometry::kPi : 0.0);
    ASSERT_NEAR(geometry::wrap(along - headings[i - 1] - 0.5 * turn), 0.0, 1e-3);
    ASSERT_GE(length_m / std::max(1e-9, std::abs(turn)), 0.99 * kind.turning_radius_m);
  }
  for (std::size_t i = 0; i < path.size(); ++i)
    ASSERT_TRUE(is_outline_free(floor, kind, {path[i].x, path[i].y, headings[i]}));
}

TEST(SteeredPlaces, MotionsAreDrivable) {
  const auto made = made_for(warehouse(), forklift());
  ASSERT_GT(made.roadmap.motions(), 1'000U);
  for (MotionId id = 0; id < made.roadmap.motions(); id += 7)
    ASSERT_NO_FATAL_FAILURE(expect_drivable(warehouse(), made.roadmap, made.roadmap.motion(id)));
}

TEST(SteeredPlaces, EachReachesEachOther) {
  for (const FloorMap& floor : {ring(), warehouse()}) {
    auto made = made_for(floor, forklift());
    const auto places = lattice(made.roadmap);
    ASSERT_GT(places.size(), 500U) << floor.name;

    const auto& to_first = made.roadmap.seconds_to(places.front());
    for (const PlaceId id : places) ASSERT_TRUE(std::isfinite(to_first[id]));
    for (std::size_t i = 0; i < places.size(); i += places.size() / 10)
      ASSERT_TRUE(std::isfinite(made.roadmap.seconds_to(places.front(), places[i])));
  }
}

TEST(SteeredPlaces, StandInAHeadingAndHoldTheirOutline) {
  const FloorMap floor = ring();
  const auto made = made_for(floor, forklift());
  for (const PlaceId id : lattice(made.roadmap)) {
    const Place& place = made.roadmap.place(id);
    ASSERT_TRUE(place.has_heading);
    ASSERT_TRUE(is_outline_free(floor, forklift(), place.base_in_map));
    ASSERT_EQ(gap_between_m(place.standing, standing_shape(forklift(), place.base_in_map)), 0.0);
  }
}

TEST(SteeredPlaces, BacksOnlyWhereItMay) {
  Kind kind = forklift();
  auto count = [&] {
    const FloorMap floor = ring();
    const auto made = made_for(floor, kind);
    int backs = 0;
    for (MotionId id = 0; id < made.roadmap.motions(); ++id) {
      const Motion& motion = made.roadmap.motion(id);
      if (!motion.is_reverse) continue;
      ++backs;
      EXPECT_LE(motion.speed_mps, 0.3);
    }
    return backs;
  };
  EXPECT_GT(count(), 100);
  kind.limits.max_reverse_mps = 0.0;
  EXPECT_EQ(count(), 0);
}

TEST(SteeredPlaces, GoalsAreJoinedInSomeHeadingBothWays) {
  auto made = made_for(warehouse(), forklift());
  const std::size_t lattice_motions = made.roadmap.motions();
  for (const Point2 goal : {Point2{34.0, 19.8}, {16.0, 7.2}, {34.0, 25.0}, {10.0, 3.0}, {28.0, 11.4}, {31.0, 15.6}}) {
    int good = 0;
    for (int quarter = 0; quarter < 4; ++quarter) {
      const PlaceId id = made.roadmap.temporary_place(made.kind, {goal.x, goal.y, heading_of(quarter)});
      if (id == kNoId) continue;
      const Place& place = made.roadmap.place(id);
      good += !place.leaving.empty() && !place.entering.empty() ? 1 : 0;
    }
    EXPECT_GE(good, 1) << goal.x << " " << goal.y;
  }

  for (MotionId id = static_cast<MotionId>(lattice_motions); id < made.roadmap.motions(); ++id)
    ASSERT_NO_FATAL_FAILURE(expect_drivable(warehouse(), made.roadmap, made.roadmap.motion(id)));
}

TEST(SteeredPlaces, AStartBetweenPosesIsJoined) {
  const FloorMap floor = ring();
  auto made = made_for(floor, forklift());
  for (double yaw = 1.0; yaw < 2.1; yaw += 0.1) {
    const PlaceId id = made.roadmap.temporary_place(made.kind, {2.6, 7.3, yaw});
    ASSERT_NE(id, kNoId);
    const std::size_t leaving = made.roadmap.place(id).leaving.size();
    EXPECT_GE(leaving, 1U) << yaw;
    made.roadmap.sweep({id}, {});
    EXPECT_EQ(made.roadmap.place(id).leaving.size(), leaving);
  }
  EXPECT_NE(made.roadmap.nearest(made.kind, {2.6, 7.3, 1.4}), kNoId);
}

TEST(SteeredPlaces, AnEditTakesAwayAndBringsBack) {
  FloorMap floor = ring();
  auto made = made_for(floor, forklift());
  const std::size_t before = lattice(made.roadmap).size();
  const PlaceId left = made.roadmap.nearest(made.kind, {3.0, 2.5, 0.0});
  const PlaceId right = made.roadmap.nearest(made.kind, {17.5, 2.5, 0.0});
  const double near_s = made.roadmap.seconds_to(left, right);

  const auto paint = [&](grid::Occupancy to) {
    const grid::Cell low{180, 10};
    const grid::Cell high{200, 90};
    for (int y = low.y; y <= high.y; ++y)
      for (int x = low.x; x <= high.x; ++x) floor.grid.set({x, y}, to);
    floor.clearance.update(floor.grid, low, high);
    made.roadmap.set_map(floor.clearance, low, high);
  };

  paint(grid::Occupancy::kOccupied);
  EXPECT_GT(made.roadmap.seconds_to(left, right), near_s + 10.0);
  for (const PlaceId id : lattice(made.roadmap))
    ASSERT_TRUE(is_outline_free(floor, forklift(), made.roadmap.place(id).base_in_map));
  paint(grid::Occupancy::kFree);
  EXPECT_NEAR(made.roadmap.seconds_to(left, right), near_s, 1e-9);
  EXPECT_EQ(lattice(made.roadmap).size(), before);
}

}  // namespace
}  // namespace aisle::global_planner::traffic
