// The fleet planner under load, without DDS: 100 vehicles that ask at once, and map edits that block the way of ten and more.
// On the 1.7 M cells of nav2_warehouse where the shared data is at hand, else on the shipped warehouse. CPU time of one thread.
#include <time.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "common/grid/map_file.hpp"
#include "services/global-planner/core/fleet_planner.hpp"
#include "services/global-planner/core/variant.hpp"

namespace {

using namespace aisle;
using namespace aisle::global_planner;
using geometry::Point2;

constexpr double kRadius_m = 0.3;
constexpr int kVehicles = 100;
constexpr std::size_t kBlocked = 10;

double cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

double quantile(std::vector<double> of, double part) {
  std::sort(of.begin(), of.end());
  return of.empty() ? 0.0 : of[std::min(of.size() - 1, static_cast<std::size_t>(part * static_cast<double>(of.size())))];
}

class Load {
 public:
  Load(const std::string& map, const std::string& planner)
      : grid_(grid::read_map_file(map)), planner_(FleetSettings{}, find_variant(planner)->make()), random_(3) {
    planner_.set_map("bench", ++revision_, grid_, {0, 0}, {grid_.geometry().width - 1, grid_.geometry().height - 1});
    find_places();
    for (int i = 0; i < kVehicles; ++i) {
      const std::string id = "agv-" + std::to_string(i);
      planner_.set_vehicle(id, kRadius_m);
      const Point2 start = place();
      planner_.set_pose(id, {start.x, start.y, 0.0}, now_);
    }
  }

  /// Everybody gets another goal. Milliseconds until nobody waits.
  double ask_all() {
    ++goals_;
    for (int i = 0; i < kVehicles; ++i) {
      const Point2 goal = place();
      planner_.set_goal("agv-" + std::to_string(i), {"goal-" + std::to_string(goals_), {goal.x, goal.y, 0.0}, 0.1, 0.0, false});
    }
    const double begun_ms = cpu_ms();
    answer();
    return cpu_ms() - begun_ms;
  }
  int found() const {
    return static_cast<int>(std::count_if(plans_.begin(), plans_.end(), [](const auto& p) { return p.second.outcome == FleetOutcome::kFound; }));
  }

  /// Blocks a square of 1 m where at least ten plans pass, then frees it again. Milliseconds from the edit to the last new plan, or
  /// less than 0 when no such place was found.
  double edit(std::size_t& replaced) {
    Point2 at;
    if (!busy_place(at)) return -1.0;
    const grid::Cell low = grid_.geometry().cell_at(at - Point2{0.5, 0.5});
    const grid::Cell high = grid_.geometry().cell_at(at + Point2{0.5, 0.5});
    const grid::OccupancyGrid before = grid_;
    set(low, high, nullptr);
    const double begun_ms = cpu_ms();
    planner_.set_map("bench", ++revision_, grid_, low, high);
    replaced = answer();
    const double took_ms = cpu_ms() - begun_ms;
    set(low, high, &before);
    planner_.set_map("bench", ++revision_, grid_, low, high);
    answer();
    return took_ms;
  }

 private:
  /// Plans with another id than before.
  std::size_t answer() {
    std::size_t replaced = 0;
    while (auto plan = planner_.step(now_, nullptr)) {
      replaced += plans_[plan->agv_id].plan_id != plan->plan_id ? 1U : 0U;
      plans_[plan->agv_id] = *plan;
    }
    planner_.take_events();
    return replaced;
  }
  void set(grid::Cell low, grid::Cell high, const grid::OccupancyGrid* from) {
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) {
        if (grid_.geometry().contains({x, y})) grid_.set({x, y}, from != nullptr ? from->at({x, y}) : grid::Occupancy::kOccupied);
      }
    }
  }
  /// Places where a vehicle may be, all of which are reachable from each other.
  void find_places() {
    const grid::ClearanceField clearance(grid_, 2.0);
    const auto judge = find_variant("jps")->make();
    const grid::Geometry& g = grid_.geometry();
    std::uniform_int_distribution<int> x(0, g.width - 1);
    std::uniform_int_distribution<int> y(0, g.height - 1);
    std::vector<Point2> tried;
    while (places_.size() < 400) {
      const grid::Cell cell{x(random_), y(random_)};
      if (clearance.clearance_m(cell) < kRadius_m + 0.15) continue;
      const Point2 p = g.center_in_map(cell);
      if (places_.empty() || judge->plan({clearance, places_.front(), p, kRadius_m + 0.1}, nullptr).outcome == Outcome::kFound) {
        places_.push_back(p);
      } else if (places_.size() == 1 && tried.size() > 20) {
        places_.clear();   // the first one was in a corner of its own
        tried.clear();
      } else {
        tried.push_back(p);
      }
    }
  }
  Point2 place() { return places_[std::uniform_int_distribution<std::size_t>(0, places_.size() - 1)(random_)]; }

  /// A random metre that at least ten plans cross and in which none begins or ends.
  bool busy_place(Point2& at) {
    std::map<std::pair<int, int>, std::size_t> crossing;
    for (const auto& [id, plan] : plans_) {
      std::map<std::pair<int, int>, bool> seen;
      for (std::size_t i = 1; i < plan.waypoints_in_map.size(); ++i) {
        const Point2 a = plan.waypoints_in_map[i - 1];
        const Point2 b = plan.waypoints_in_map[i];
        const int pieces = 1 + static_cast<int>(geometry::distance(a, b) / 0.25);
        for (int k = 0; k <= pieces; ++k) {
          const Point2 p = a + (static_cast<double>(k) / pieces) * (b - a);
          seen[{static_cast<int>(std::floor(p.x)), static_cast<int>(std::floor(p.y))}] = true;
        }
      }
      for (const auto& [metre, is_there] : seen) crossing[metre] += 1;
    }
    std::vector<Point2> busy;
    for (const auto& [metre, count] : crossing) {
      const Point2 center{metre.first + 0.5, metre.second + 0.5};
      const bool is_end = std::any_of(places_.begin(), places_.end(), [&](Point2 p) { return geometry::distance(p, center) < 1.5; });
      if (count >= kBlocked && count < 2 * kBlocked && !is_end) busy.push_back(center);
    }
    if (busy.empty()) return false;
    at = busy[std::uniform_int_distribution<std::size_t>(0, busy.size() - 1)(random_)];
    return true;
  }

  grid::OccupancyGrid grid_;
  FleetPlanner planner_;
  std::mt19937 random_;
  time::Stamp now_{time::from_seconds(100.0)};
  std::uint64_t revision_{0};
  int goals_{0};
  std::vector<Point2> places_;
  std::map<std::string, FleetPlan> plans_;
};

}  // namespace

int main(int argc, char** argv) {
  std::string map = AISLE_BENCH_DATA "/ros/nav2_warehouse.yaml";
  if (!std::filesystem::exists(map)) map = AISLE_BENCH_MAP;
  std::vector<std::string> planners{"wang", "astar", "jps", "jps-smooth"};
  int rounds = 3;
  int edits = 20;
  CLI::App app("Times the fleet planner: 100 vehicles at once, and edits that block at least ten plans");
  app.add_option("--map", map)->capture_default_str();
  app.add_option("--planner", planners)->capture_default_str();
  app.add_option("--rounds", rounds)->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--edits", edits, "in all")->check(CLI::Range(1, 100000))->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  std::printf("%s, %d vehicles of radius %.1f m\n", std::filesystem::path(map).filename().c_str(), kVehicles, kRadius_m);
  std::printf("  %-12s %22s %8s %28s %18s\n", "planner", "all answered, ms", "found", "edit to all plans, ms", "plans replaced");
  for (const std::string& planner : planners) {
    Load load(map, planner);
    std::vector<double> all_ms;
    std::vector<double> edit_ms;
    std::vector<double> replaced;
    int found = kVehicles;
    for (int round = 0; round < rounds; ++round) {
      all_ms.push_back(load.ask_all());
      found = std::min(found, load.found());
      for (int i = 0; i * rounds < edits; ++i) {
        std::size_t count = 0;
        const double took_ms = load.edit(count);
        if (took_ms < 0.0) break;
        edit_ms.push_back(took_ms);
        replaced.push_back(static_cast<double>(count));
      }
    }
    std::printf("  %-12s %10.1f (max %6.1f) %8d   p50 %8.1f  p99 %8.1f   p50 %4.0f  max %4.0f\n", planner.c_str(), quantile(all_ms, 0.5),
                quantile(all_ms, 1.0), found, quantile(edit_ms, 0.5), quantile(edit_ms, 0.99), quantile(replaced, 0.5), quantile(replaced, 1.0));
  }
  return 0;
}
