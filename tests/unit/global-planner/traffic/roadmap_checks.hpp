#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <set>
#include <utility>
#include <vector>

#include "services/global-planner/core/traffic/roadmap.hpp"
#include "tests/unit/global-planner/traffic/floors.hpp"

namespace aisle::global_planner::traffic {

inline constexpr double kNeedM = 0.45;

inline Kind cart() { return {}; }

inline Kind forklift() {
  Kind kind;
  kind.footprint = geometry::rectangle(2.4, 1.1, 0.4);
  kind.limits.model = kinematics::Model::kTricycle;
  kind.limits.max_speed_mps = 1.0;
  kind.tube_m = 0.12;
  kind.turning_radius_m = 1.17;
  return kind;
}

struct Made {
  Roadmap roadmap;
  KindId kind;
};

inline Made made_for(const FloorMap& floor, const Kind& kind = cart()) {
  Made made;
  made.kind = made.roadmap.kind(kind);
  made.roadmap.set_map(floor.clearance, {0, 0}, floor.high());
  return made;
}

/// All places that are not temporary.
inline std::vector<PlaceId> lattice(const Roadmap& roadmap) {
  std::vector<PlaceId> out;
  for (PlaceId id = 0; id < roadmap.places(); ++id)
    if (!roadmap.place(id).is_temporary && roadmap.place(id).kind != kNoId && !roadmap.place(id).standing.empty())
      out.push_back(id);
  return out;
}

/// Metres over the grid from a cell to each other, eight neighbours, cutting no corner; infinity where there is no way.
inline std::vector<double> grid_distances_m(const FloorMap& floor, grid::Cell from, double need_m) {
  const grid::Geometry& g = floor.grid.geometry();
  std::vector<double> out(g.cells(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, std::size_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto is_free = [&](grid::Cell c) { return floor.clearance.is_traversable(c, need_m); };
  if (!is_free(from)) return out;

  out[g.index(from)] = 0.0;
  open.push({0.0, g.index(from)});
  while (!open.empty()) {
    const auto [so_far_m, index] = open.top();
    open.pop();
    if (so_far_m > out[index]) continue;

    const grid::Cell at{static_cast<int>(index % static_cast<std::size_t>(g.width)),
                        static_cast<int>(index / static_cast<std::size_t>(g.width))};
    for (int dy = -1; dy <= 1; ++dy) {
      for (int dx = -1; dx <= 1; ++dx) {
        const grid::Cell to{at.x + dx, at.y + dy};
        if (!is_free(to) || !is_free({to.x, at.y}) || !is_free({at.x, to.y})) continue;
        const double length_m = so_far_m + std::hypot(dx, dy) * g.resolution_m;
        if (length_m >= out[g.index(to)]) continue;
        out[g.index(to)] = length_m;
        open.push({length_m, g.index(to)});
      }
    }
  }
  return out;
}

/// Of each place and motion: free of walls, ends where it says, apart from its neighbours.
inline void expect_sound(const FloorMap& floor, const Roadmap& roadmap, double need_m, double pitch_m) {
  const auto places = lattice(roadmap);
  for (const PlaceId a : places) {
    const geometry::Point2 at = roadmap.place(a).base_in_map.position();
    ASSERT_GE(floor.clearance.clearance_m(at), need_m);
    for (const PlaceId b : places) {
      if (b >= a) continue;
      ASSERT_GT(distance(at, roadmap.place(b).base_in_map.position()), kLeastApart * pitch_m - 1e-6);
    }
  }

  for (MotionId id = 0; id < roadmap.motions(); ++id) {
    const Motion& motion = roadmap.motion(id);
    if (motion.is_temporary || motion.path_in_map.empty()) continue;

    ASSERT_EQ(motion.path_in_map.front(), roadmap.place(motion.from).base_in_map.position());
    ASSERT_EQ(motion.path_in_map.back(), roadmap.place(motion.to).base_in_map.position());
    for (std::size_t i = 1; i < motion.path_in_map.size(); ++i)
      for (double t = 0.0; t <= 1.0; t += 0.05)
        ASSERT_GE(floor.clearance.clearance_m(motion.path_in_map[i - 1] +
                                              t * (motion.path_in_map[i] - motion.path_in_map[i - 1])),
                  need_m - 1e-6);
  }
}

/// Places that the floor connects are joined by motions, both ways; each piece of free floor has a place.
inline void expect_joined_as_the_floor(const FloorMap& floor, Roadmap& roadmap, double need_m) {
  const grid::Geometry& g = floor.grid.geometry();
  const auto places = lattice(roadmap);
  std::set<PlaceId> seen;
  std::vector<bool> is_covered(g.cells(), false);

  const auto cell_near = [&](geometry::Point2 p) {
    const grid::Cell c = g.cell_at(p);
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx)
        if (floor.clearance.is_traversable({c.x + dx, c.y + dy}, need_m)) return grid::Cell{c.x + dx, c.y + dy};
    return c;
  };

  for (const PlaceId first : places) {
    if (seen.count(first) > 0) continue;

    const auto& table = roadmap.seconds_to(first);
    const auto metres = grid_distances_m(floor, cell_near(roadmap.place(first).base_in_map.position()), need_m);
    for (std::size_t i = 0; i < metres.size(); ++i) is_covered[i] = is_covered[i] || std::isfinite(metres[i]);
    for (const PlaceId other : places) {
      const bool is_connected = std::isfinite(metres[g.index(cell_near(roadmap.place(other).base_in_map.position()))]);
      ASSERT_EQ(std::isfinite(table[other]), is_connected) << first << " " << other;
      if (is_connected) seen.insert(other);
    }
  }

  for (int y = 0; y < g.height; ++y)
    for (int x = 0; x < g.width; ++x)
      ASSERT_TRUE(is_covered[g.index({x, y})] || !floor.clearance.is_traversable({x, y}, need_m));
}

}  // namespace aisle::global_planner::traffic
