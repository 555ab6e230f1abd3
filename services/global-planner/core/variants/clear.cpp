// A* that prefers clearance: nearer to an obstacle than Problem::preferred_clearance_m a metre costs up to four times
// as much, so that a path runs in the middle of an aisle and not along its racks. Points are joined only where the
// straight line costs no more.
#include <algorithm>
#include <cmath>
#include <vector>

#include "services/global-planner/core/distances.hpp"
#include "services/global-planner/core/open_steps.hpp"
#include "services/global-planner/core/passes/passes.hpp"
#include "services/global-planner/core/search_memory.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

using geometry::Point2;
constexpr double kAversion = 3.0;

class PreferClearance final : public Planner {
 public:
  explicit PreferClearance(double aversion) : aversion_(aversion) {}

  void rest() override {
    nodes_.release();
    open_.release();
  }

 private:
  PlannedPath search(const Problem& problem, const Drivable& drivable, const OutOfTime& out_of_time) override {
    preferred_m_ =
        std::max(1e-6, problem.preferred_clearance_m > 0.0 ? problem.preferred_clearance_m : 2.0 * problem.radius_m);
    const grid::Geometry& geometry = drivable.geometry();
    const grid::Cell start = geometry.cell_at(problem.start_in_map);
    const grid::Cell goal = geometry.cell_at(problem.goal_in_map);
    PlannedPath plan;
    plan.outcome = run(problem.clearance, drivable, start, goal, out_of_time, plan.expanded);
    if (plan.outcome != Outcome::kFound) return plan;
    for (grid::Cell cell = goal; cell != start;) {
      plan.waypoints_in_map.push_back(geometry.center_in_map(cell));
      const Step& step = kSteps[static_cast<std::size_t>(nodes_.direction(geometry.index(cell)))];
      cell = {cell.x - step.dx, cell.y - step.dy};
    }
    plan.waypoints_in_map.push_back(problem.start_in_map);
    std::reverse(plan.waypoints_in_map.begin(), plan.waypoints_in_map.end());
    plan.waypoints_in_map.back() = problem.goal_in_map;
    join_where_no_dearer(problem.clearance, drivable, plan.waypoints_in_map);
    return plan;
  }

  Outcome run(const grid::ClearanceField& clearance, const Drivable& drivable, grid::Cell start, grid::Cell goal,
              const OutOfTime& out_of_time, std::size_t& expanded) {
    const grid::Geometry& geometry = drivable.geometry();
    const auto width = static_cast<std::uint32_t>(geometry.width);
    nodes_.begin(geometry.cells());
    open_.begin();
    nodes_.reach(geometry.index(start), 0, 0);
    open_.push(octile(start, goal), static_cast<std::uint32_t>(geometry.index(start)), 0);
    BucketQueue::Entry entry;
    while (open_.pop(entry)) {
      if (nodes_.is_closed(entry.cell) || nodes_.cost(entry.cell) != entry.cost) continue;  // stale
      if (expanded % 256 == 0 && out_of_time && out_of_time()) return Outcome::kOutOfTime;
      nodes_.close(entry.cell);
      const grid::Cell cell{static_cast<int>(entry.cell % width), static_cast<int>(entry.cell / width)};
      if (cell == goal) return Outcome::kFound;
      ++expanded;
      for (unsigned left = open_steps(drivable, cell); left != 0; left &= left - 1) {
        const int direction = __builtin_ctz(left);
        const Step& step = kSteps[static_cast<std::size_t>(direction)];
        const grid::Cell next{cell.x + step.dx, cell.y + step.dy};
        const std::size_t index = geometry.index(next);
        const std::uint32_t cost =
            entry.cost + static_cast<std::uint32_t>(step.cost * price(clearance.clearance_m(next)));
        if (nodes_.is_known(index) && cost >= nodes_.cost(index)) continue;
        nodes_.reach(index, cost, direction);
        open_.push(cost + octile(next, goal), static_cast<std::uint32_t>(index), cost);
      }
    }
    return Outcome::kNoPath;
  }

  /// Of a metre at a place with this clearance.
  double price(double clearance_m) const { return 1.0 + aversion_ * std::max(0.0, 1.0 - clearance_m / preferred_m_); }

  double price_of(const grid::ClearanceField& clearance, Point2 from, Point2 to) const {
    const double length_m = geometry::distance(from, to);
    const int pieces = 1 + static_cast<int>(2.0 * length_m / clearance.geometry().resolution_m);
    double sum = 0.0;
    for (int i = 0; i < pieces; ++i) sum += price(clearance.clearance_m(from + ((i + 0.5) / pieces) * (to - from)));
    return sum / pieces * length_m;
  }

  void join_where_no_dearer(const grid::ClearanceField& clearance, const Drivable& drivable,
                            std::vector<Point2>& path) const {
    passes::collinear(drivable, path);
    std::size_t kept = 1;
    double since_kept = path.size() > 1 ? price_of(clearance, path[0], path[1]) : 0.0;
    for (std::size_t next = 1; next + 1 < path.size(); ++next) {
      const double through = since_kept + price_of(clearance, path[next], path[next + 1]);
      const bool is_needless = price_of(clearance, path[kept - 1], path[next + 1]) <= through &&
                               drivable.is_line_free(path[kept - 1], path[next + 1]);
      since_kept = is_needless ? through : price_of(clearance, path[next], path[next + 1]);
      if (!is_needless) path[kept++] = path[next];
    }
    if (path.size() > 1) path[kept++] = path.back();
    path.resize(kept);
  }

  double aversion_;
  double preferred_m_{0.0};
  SearchNodes nodes_;
  BucketQueue open_;
};

}  // namespace

Variant clear() {
  return {"clear",
          "A* that prefers clearance: nearer than preferred_clearance_m a metre costs up to four times as much", false,
          [](Parameters& parameters) -> std::unique_ptr<Planner> {
            return std::make_unique<PreferClearance>(
                parameters.number("aversion", kAversion, 0.0, 100.0, "beside an obstacle a metre costs 1 + this many"));
          }};
}

}  // namespace aisle::global_planner
