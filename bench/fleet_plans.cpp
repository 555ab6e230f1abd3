// The fleet planner under load, without a bus: 100 vehicles ask at once on the 1.7 M cells of nav2_warehouse; then a box of 1 m is blocked
// where at least 10 plans pass, and those are planned anew. Times from the moment of asking to each plan, in milliseconds.
// usage: fleet_plans DATA_FOLDER [PLANNER...]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "common/grid/map_file.hpp"
#include "services/global-planner/core/fleet_planner.hpp"
#include "services/global-planner/core/variant.hpp"

namespace {

using namespace aisle;
using namespace aisle::global_planner;
using Clock = std::chrono::steady_clock;

constexpr int kVehicles = 100;
constexpr double kRadius_m = 0.3;
constexpr time::Stamp kNow{std::chrono::seconds(1000)};

double milliseconds_since(Clock::time_point begun) { return 1e3 * std::chrono::duration<double>(Clock::now() - begun).count(); }

/// Free places with room to spare, by seed.
std::vector<geometry::Point2> places(const grid::ClearanceField& clearance, int count) {
  const grid::Geometry& geometry = clearance.geometry();
  std::mt19937 random(5);
  std::vector<geometry::Point2> points;
  while (static_cast<int>(points.size()) < count) {
    const grid::Cell cell{static_cast<int>(random() % static_cast<unsigned>(geometry.width)), static_cast<int>(random() % static_cast<unsigned>(geometry.height))};
    if (clearance.clearance_m(cell) > kRadius_m + 0.2) points.push_back(geometry.center_in_map(cell));
  }
  return points;
}

/// The plans made until there is nothing left to do, each with its time.
struct Round {
  std::vector<FleetPlan> plans;
  std::vector<double> ms;
};

Round plan_all(FleetPlanner& fleet, Clock::time_point begun) {
  Round round;
  while (const std::optional<FleetPlan> plan = fleet.step(kNow, nullptr)) {
    round.plans.push_back(*plan);
    round.ms.push_back(milliseconds_since(begun));
  }
  return round;
}

/// The cell that most plans pass within half a metre of, away from starts and goals.
grid::Cell busiest(const grid::Geometry& geometry, const std::vector<FleetPlan>& plans) {
  std::vector<int> passes(geometry.cells(), 0);
  grid::Cell best;
  for (const FleetPlan& plan : plans) {
    std::set<std::size_t> seen;
    for (std::size_t i = 1; i < plan.waypoints_in_map.size(); ++i) {
      const auto a = plan.waypoints_in_map[i - 1];
      const auto b = plan.waypoints_in_map[i];
      const int pieces = 1 + static_cast<int>(geometry::distance(a, b) / geometry.resolution_m);
      for (int k = 0; k <= pieces; ++k) {
        const grid::Cell at = geometry.cell_at(a + (static_cast<double>(k) / pieces) * (b - a));
        for (int dy = -8; dy <= 8; dy += 4) {
          for (int dx = -8; dx <= 8; dx += 4) {
            const grid::Cell cell{(at.x + dx) & ~3, (at.y + dy) & ~3};
            if (!geometry.contains(cell) || !seen.insert(geometry.index(cell)).second) continue;
            if (++passes[geometry.index(cell)] > passes[geometry.index(best)]) best = cell;
          }
        }
      }
    }
  }
  return best;
}

void run(const std::string& planner, const grid::OccupancyGrid& map) {
  grid::OccupancyGrid grid = map;
  const grid::Geometry& geometry = grid.geometry();
  FleetPlanner fleet(FleetSettings{}, find_variant(planner)->make());
  fleet.set_map("warehouse", 1, grid, {0, 0}, {geometry.width - 1, geometry.height - 1});
  const std::vector<geometry::Point2> points = places(grid::ClearanceField(grid, 2.0), 2 * kVehicles);
  for (int i = 0; i < kVehicles; ++i) {
    const std::string id = "agv-" + std::to_string(i);
    const auto at = static_cast<std::size_t>(i);
    fleet.set_vehicle(id, kRadius_m);
    fleet.set_pose(id, {points[at].x, points[at].y, 0.0}, kNow);
    Goal goal;
    goal.id = "goal-" + std::to_string(i);
    const geometry::Point2 there = points[at + kVehicles];
    goal.pose_in_map = {there.x, there.y, 0.0};
    fleet.set_goal(id, goal);
  }
  const Round first = plan_all(fleet, Clock::now());
  const auto found = std::count_if(first.plans.begin(), first.plans.end(), [](const FleetPlan& p) { return p.outcome == FleetOutcome::kFound; });

  const grid::Cell middle = busiest(geometry, first.plans);
  const int half = static_cast<int>(0.5 / geometry.resolution_m);
  const grid::Cell low{std::max(0, middle.x - half), std::max(0, middle.y - half)};
  const grid::Cell high{std::min(geometry.width - 1, middle.x + half), std::min(geometry.height - 1, middle.y + half)};
  for (int y = low.y; y <= high.y; ++y) {
    for (int x = low.x; x <= high.x; ++x) grid.set({x, y}, grid::Occupancy::kOccupied);
  }
  const Clock::time_point edited = Clock::now();
  fleet.set_map("warehouse", 2, grid, low, high);
  const Round second = plan_all(fleet, edited);
  std::set<std::uint64_t> before;
  for (const FleetPlan& plan : first.plans) before.insert(plan.plan_id);
  std::vector<double> replanned_ms;
  for (std::size_t i = 0; i < second.plans.size(); ++i) {
    if (before.count(second.plans[i].plan_id) == 0) replanned_ms.push_back(second.ms[i]);
  }
  std::printf("%-12s %3d of %d found, all answered after %8.1f ms | edit: %3zu new plans, the 10th after %7.1f ms, the last after %7.1f ms\n", planner.c_str(),
              static_cast<int>(found), kVehicles, first.ms.empty() ? 0.0 : first.ms.back(), replanned_ms.size(),
              replanned_ms.empty() ? 0.0 : replanned_ms[std::min<std::size_t>(9, replanned_ms.size() - 1)], replanned_ms.empty() ? 0.0 : replanned_ms.back());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: fleet_plans DATA_FOLDER [PLANNER...]\n");
    return 2;
  }
  const grid::OccupancyGrid map = grid::read_map_file(std::filesystem::path(argv[1]) / "ros" / "nav2_warehouse.yaml");
  std::vector<std::string> planners(argv + 2, argv + argc);
  if (planners.empty()) planners = {"direct", "jps", "wang", "astar"};
  for (const std::string& planner : planners) {
    if (find_variant(planner) == nullptr) {
      std::fprintf(stderr, "fleet_plans: no planner '%s'\n", planner.c_str());
      return 2;
    }
    run(planner, map);
  }
  return 0;
}
