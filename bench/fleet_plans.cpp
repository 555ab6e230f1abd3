// The fleet planner under load, without a bus: 100 vehicles ask at once on the 1.7 M cells of nav2_warehouse; then,
// again and again, a box of 1 m is blocked where at least ten plans pass, and what it blocks is planned anew;
// afterwards the box is freed. Times are CPU time of the thread, from the asking or the edit to the plan: what one core
// needs that does nothing else. usage: fleet_plans DATA_FOLDER [EDITS [PLANNER...]]

#include <time.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "common/grid/formats/map_file.hpp"
#include "services/global-planner/core/fleet_planner.hpp"
#include "services/global-planner/core/variant.hpp"

namespace {

using namespace aisle;
using namespace aisle::global_planner;

constexpr int kVehicles = 100;
constexpr double kRadius_m = 0.3;
constexpr double kBox_m = 1.0;
constexpr std::size_t kBlocked = 10;  // plans, at least, by each edit that counts
constexpr unsigned kSeed = 5;
constexpr time::Stamp kNow{std::chrono::seconds(1000)};

/// Computing time of this thread.
double cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// The value below which `part` of them lie; 0 for none.
double quantile(std::vector<double> values, double part) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[std::min(values.size() - 1, static_cast<std::size_t>(part * static_cast<double>(values.size())))];
}

/// Free places with room to spare.
std::vector<geometry::Point2> places(const grid::ClearanceField& clearance, int count, std::mt19937& random) {
  const grid::Geometry& geometry = clearance.geometry();
  std::vector<geometry::Point2> points;

  while (static_cast<int>(points.size()) < count) {
    const grid::Cell cell{static_cast<int>(random() % static_cast<unsigned>(geometry.width)),
                          static_cast<int>(random() % static_cast<unsigned>(geometry.height))};
    if (clearance.clearance_m(cell) > kRadius_m + 0.2) points.push_back(geometry.center_in_map(cell));
  }

  return points;
}

/// A square that an edit blocks.
struct Box {
  geometry::Point2 center_in_map;
  grid::Cell low;
  grid::Cell high;
};

/// Does a vehicle on this path come so near that the box blocks it?
bool passes(const Plan& plan, const Box& box) {
  const double half_m = 0.5 * kBox_m + kRadius_m;
  for (std::size_t i = 1; i < plan.waypoints_in_map.size(); ++i) {
    if (geometry::distance_to_segment(box.center_in_map, plan.waypoints_in_map[i - 1], plan.waypoints_in_map[i]) <
        half_m)
      return true;
  }

  return false;
}

/// 100 vehicles with a goal each, and their plans.
class Fleet {
 public:
  /// Starts and goals lie anywhere with room to spare.
  Fleet(const std::string& planner, const grid::OccupancyGrid& map)
      : grid_(map), fleet_(FleetSettings{}, find_variant(planner)->make()), random_(kSeed) {
    const grid::Geometry& geometry = grid_.geometry();
    fleet_.set_map("warehouse", revision_, grid_, {0, 0}, {geometry.width - 1, geometry.height - 1});

    const std::vector<geometry::Point2> points = places(grid::ClearanceField(grid_, 2.0), 2 * kVehicles, random_);
    for (std::size_t i = 0; i < kVehicles; ++i) {
      const std::string id = "agv-" + std::to_string(i);
      fleet_.set_vehicle(id, kRadius_m);
      fleet_.set_pose(id, {points[i].x, points[i].y, 0.0}, kNow);

      Goal goal;
      goal.agv_id = id;
      goal.id = "goal-" + std::to_string(i);
      goal.pose_in_map = {points[i + kVehicles].x, points[i + kVehicles].y, 0.0};
      fleet_.set_goal(goal);
    }
  }

  /// Plans until there is nothing left to do. Returns when each plan that is not the one before was there, since
  /// `begun_ms`.
  std::vector<double> work(double begun_ms) {
    std::vector<double> new_plans_ms;
    while (const std::optional<Plan> plan = fleet_.step(kNow, nullptr)) {
      if (ids_.insert(plan->id).second) new_plans_ms.push_back(cpu_ms() - begun_ms);
      plans_[plan->agv_id] = *plan;
    }

    return new_plans_ms;
  }

  /// Blocks the box, or frees what was free of it before. Returns as work().
  std::vector<double> edit(const Box& box, const grid::OccupancyGrid& as, bool blocks) {
    for (int y = box.low.y; y <= box.high.y; ++y) {
      for (int x = box.low.x; x <= box.high.x; ++x)
        grid_.set({x, y}, blocks ? grid::Occupancy::kOccupied : as.at({x, y}));
    }

    const double begun_ms = cpu_ms();
    fleet_.set_map("warehouse", ++revision_, grid_, box.low, box.high);

    return work(begun_ms);
  }

  /// A box on a random plan that at least ten plans pass, away from vehicles and goals. Nothing when a thousand tries
  /// find none.
  std::optional<Box> crowded() {
    const grid::Geometry& geometry = grid_.geometry();
    const int half = static_cast<int>(0.5 * kBox_m / geometry.resolution_m);

    for (int tries = 0; tries < 1000; ++tries) {
      const Plan& plan = std::next(plans_.begin(), static_cast<std::ptrdiff_t>(random_() % plans_.size()))->second;
      if (plan.waypoints_in_map.size() < 2) continue;

      const std::size_t piece = random_() % (plan.waypoints_in_map.size() - 1);
      const double along = 0.001 * static_cast<double>(random_() % 1000);
      const geometry::Point2 a = plan.waypoints_in_map[piece];
      const grid::Cell middle = geometry.cell_at(a + along * (plan.waypoints_in_map[piece + 1] - a));

      const Box box{
          geometry.center_in_map(middle), {middle.x - half, middle.y - half}, {middle.x + half, middle.y + half}};
      if (!geometry.contains(box.low) || !geometry.contains(box.high) || is_near_an_end(box)) continue;

      // Enough plans pass it?
      const auto blocked =
          std::count_if(plans_.begin(), plans_.end(), [&](const auto& other) { return passes(other.second, box); });
      if (blocked >= static_cast<std::ptrdiff_t>(kBlocked)) return box;
    }

    return {};
  }

  /// Vehicles whose newest plan has a way.
  std::size_t found() const {
    return static_cast<std::size_t>(std::count_if(
        plans_.begin(), plans_.end(), [](const auto& plan) { return plan.second.outcome == PlanOutcome::kFound; }));
  }

 private:
  bool is_near_an_end(const Box& box) const {
    return std::any_of(plans_.begin(), plans_.end(), [&](const auto& plan) {
      const std::vector<geometry::Point2>& way = plan.second.waypoints_in_map;
      return way.empty() || geometry::distance(way.front(), box.center_in_map) < 2.0 * kBox_m ||
             geometry::distance(way.back(), box.center_in_map) < 2.0 * kBox_m;
    });
  }

  grid::OccupancyGrid grid_;
  FleetPlanner fleet_;
  std::mt19937 random_;
  std::uint64_t revision_{1};
  std::map<std::string, Plan> plans_;
  std::set<std::uint64_t> ids_;
};

/// One planner: the first plans, then `edits` edits, each taken back.
void run(const std::string& planner, const grid::OccupancyGrid& map, int edits) {
  Fleet fleet(planner, map);
  const std::vector<double> first_ms = fleet.work(cpu_ms());
  const std::size_t found = fleet.found();
  std::vector<double> tenth_ms, all_ms;
  std::size_t count = 0;

  for (int i = 0; i < edits; ++i) {
    const std::optional<Box> box = fleet.crowded();
    if (!box) break;

    const std::vector<double> new_ms = fleet.edit(*box, map, true);
    if (new_ms.size() >= kBlocked) {
      ++count;
      tenth_ms.push_back(new_ms[kBlocked - 1]);
      all_ms.insert(all_ms.end(), new_ms.begin(), new_ms.end());
    }

    fleet.edit(*box, map, false);
  }

  std::printf("%-10s %9zu %10.1f %8zu %8.1f %12.1f %9.1f %12.1f %9.1f\n", planner.c_str(), found,
              first_ms.empty() ? 0.0 : first_ms.back(), count,
              count == 0 ? 0.0 : static_cast<double>(all_ms.size()) / static_cast<double>(count),
              quantile(tenth_ms, 0.5), quantile(tenth_ms, 0.99), quantile(all_ms, 0.5), quantile(all_ms, 0.99));

  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: fleet_plans DATA_FOLDER [EDITS [PLANNER...]]\n");
    return 2;
  }

  const grid::OccupancyGrid map = grid::read_map_file(std::filesystem::path(argv[1]) / "ros" / "nav2_warehouse.yaml");
  const int edits = argc > 2 ? std::atoi(argv[2]) : 200;
  std::vector<std::string> planners(argv + std::min(argc, 3), argv + argc);

  if (planners.empty()) planners = {"direct", "jps", "wang", "astar"};
  std::printf("%d vehicles on nav2_warehouse (%zu cells), %d edits of %.0f m, seed %u; CPU ms\n", kVehicles,
              map.geometry().cells(), edits, kBox_m, kSeed);
  std::printf("%-10s %9s %10s %8s %8s %12s %9s %12s %9s\n", "planner", "found", "all after", "edits", "new/edit",
              "10th p50", "p99", "each p50", "p99");

  for (const std::string& planner : planners) {
    if (find_variant(planner) == nullptr) {
      std::fprintf(stderr, "fleet_plans: no planner '%s'\n", planner.c_str());
      return 2;
    }

    run(planner, map, planner == "direct" || planner == "jps" ? edits : std::min(edits, 3));  // the others need minutes
  }

  return 0;
}
