// Parts by runs, against a flood that looks at every cell.
#include "services/global-planner/core/connected_parts.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "services/global-planner/core/fleet_planner.hpp"
#include "services/global-planner/core/nearest_reachable.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tests/unit/grid/random_grid.hpp"

namespace aisle::global_planner {
namespace {

using geometry::Point2;
using grid::Cell;

std::vector<bool> flooded(const Drivable& drivable, Cell start) {
  const grid::Geometry& geometry = drivable.geometry();
  std::vector<bool> is_seen(geometry.cells(), false);
  std::vector<Cell> open;
  const auto see = [&](Cell c) {
    if (!drivable.is_traversable(c) || is_seen[geometry.index(c)]) return;
    is_seen[geometry.index(c)] = true;
    open.push_back(c);
  };
  see(start);
  while (!open.empty()) {
    const Cell c = open.back();
    open.pop_back();
    for (const Cell next : {Cell{c.x + 1, c.y}, Cell{c.x - 1, c.y}, Cell{c.x, c.y + 1}, Cell{c.x, c.y - 1}}) see(next);
  }
  return is_seen;
}

Point2 random_center(std::mt19937& random, const grid::Geometry& geometry) {
  return geometry.center_in_map({static_cast<int>(random() % static_cast<unsigned>(geometry.width)),
                                 static_cast<int>(random() % static_cast<unsigned>(geometry.height))});
}

TEST(ConnectedParts, AreThoseOfAFlood) {
  std::mt19937 random(3);
  std::size_t apart = 0;
  std::size_t together = 0;
  ConnectedParts parts;  // the same for all maps
  for (int map = 0; map < 300; ++map) {
    const grid::OccupancyGrid grid = grid::testing::random_grid(random, 140);
    const grid::Geometry& geometry = grid.geometry();
    const grid::ClearanceField clearance(grid, 10.0 * geometry.resolution_m);
    for (int query = 0; query < 4; ++query) {
      const double radius_m = query % 2 == 0 ? 0.0 : 0.9 * geometry.resolution_m;
      Problem problem{clearance, random_center(random, geometry), random_center(random, geometry), radius_m};
      if (query > 1) problem.least_radius_m = 0.3 * geometry.resolution_m;  // ends may be tight
      problem.tight_range_m = 4.0 * geometry.resolution_m;
      const Drivable drivable(problem);
      const Cell start = geometry.cell_at(problem.start_in_map);
      const std::vector<bool> reached = flooded(drivable, start);
      parts.make(drivable);
      EXPECT_EQ(parts.is_made_for(drivable), !drivable.has_tight_end());
      double nearest_m = 1e9;
      for (int y = 0; y < geometry.height; ++y) {
        for (int x = 0; x < geometry.width; ++x) {
          const bool is_apart =
              drivable.is_traversable(start) && drivable.is_traversable(Cell{x, y}) && !reached[geometry.index({x, y})];
          ASSERT_EQ(parts.are_apart(start, {x, y}), is_apart)
              << "map " << map << ", query " << query << ", cell " << x << " " << y;
          apart += is_apart ? 1U : 0U;
          together += reached[geometry.index({x, y})] ? 1U : 0U;
          if (reached[geometry.index({x, y})])
            nearest_m = std::min(nearest_m, geometry::distance(geometry.center_in_map({x, y}), problem.goal_in_map));
        }
      }
      const auto nearest = nearest_reachable(problem, parts, nullptr);
      ASSERT_EQ(nearest.has_value(), drivable.is_traversable(start));
      if (!nearest) continue;
      EXPECT_TRUE(reached[geometry.index(geometry.cell_at(*nearest))]);
      EXPECT_NEAR(geometry::distance(*nearest, problem.goal_in_map), nearest_m, 1e-9);
    }
  }
  EXPECT_GT(apart, 100000U);
  EXPECT_GT(together, 100000U);
}

/// Finds nothing, and counts how often it was asked.
class InVain final : public Planner {
 public:
  explicit InVain(int& asked) : asked_(asked) {}

 private:
  PlannedPath search(const Problem&, const Drivable&, const OutOfTime&) override {
    ++asked_;
    return blank();
  }
  int& asked_;
};

/// Ten vehicles left of a wall, their goals right of it.
TEST(FleetPlanner, SearchesOnceInVainForAllWhoseGoalsAreCutOff) {
  grid::OccupancyGrid hall(grid::Geometry{200, 100, 0.1, {}});
  for (int y = 0; y < 100; ++y) hall.set({100, y}, grid::Occupancy::kOccupied);
  int asked = 0;
  FleetPlanner planner(FleetSettings{}, std::make_unique<InVain>(asked));
  const time::Stamp now = time::from_seconds(100.0);
  planner.set_map("hall", 1, hall, {0, 0}, {199, 99});
  for (int i = 0; i < 10; ++i) {
    const std::string id = "agv-" + std::to_string(i);
    planner.set_vehicle(id, 0.3);
    planner.set_pose(id, {1.0, 0.9 * (i + 1), 0.0}, now);
    planner.set_goal({id, "goal", {19.0, 0.9 * (i + 1), 0.0}, 0.1, 0.0, false});
  }
  for (int i = 0; i < 10; ++i) {
    const auto plan = planner.step(now, nullptr);
    ASSERT_TRUE(plan);
    EXPECT_EQ(plan->outcome, PlanOutcome::kNoPath);
    EXPECT_NE(plan->detail.find("nearest reachable point is (9."), std::string::npos) << plan->detail;
  }
  EXPECT_EQ(asked, 1);

  hall.set({100, 50}, grid::Occupancy::kFree);  // too narrow, but another map
  planner.set_map("hall", 2, hall, {100, 50}, {100, 50});
  ASSERT_TRUE(planner.step(now, nullptr));
  EXPECT_EQ(asked, 2);
}

}  // namespace
}  // namespace aisle::global_planner
