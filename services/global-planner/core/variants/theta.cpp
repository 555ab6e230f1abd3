// Lazy Theta* (Nash, Koenig, Tovey 2010): any-angle paths. A cell's parent need not be its neighbour, only in sight;
// that is looked at when the cell is expanded, not when it is reached. Before it the grid's optimum is searched and
// smoothed; it bounds the search, and is the answer where Theta* finds nothing shorter. So a path is never longer than
// the grid's optimum.
#include <algorithm>
#include <array>
#include <limits>
#include <vector>

#include "services/global-planner/core/open_steps.hpp"
#include "services/global-planner/core/passes/passes.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {

Variant jps();

namespace {

using geometry::Point2;
using grid::Cell;
using Path = std::vector<Point2>;

void smooth(const Drivable& drivable, Path& path) {
  passes::collinear(drivable, path);
  passes::greedy_line_of_sight(drivable, path);
  for (double before_m = std::numeric_limits<double>::infinity(), now_m = path_length_m(path);
       now_m < before_m - 1e-6;) {
    passes::interpolated_forward(drivable, path);
    passes::interpolated_backward(drivable, path);
    before_m = now_m;
    now_m = path_length_m(path);
  }
}

class LazyTheta final : public Planner {
 public:
  void rest() override {
    on_grid_->rest();
    nodes_ = {};
    open_ = {};
  }

 private:
  PlannedPath search(const Problem& problem, const Drivable& drivable, const OutOfTime& out_of_time) override {
    PlannedPath plan = on_grid_->plan(problem, out_of_time);
    if (plan.outcome != Outcome::kFound) return plan;
    smooth(drivable, plan.waypoints_in_map);
    const double on_grid_m = path_length_m(plan.waypoints_in_map);

    geometry_ = drivable.geometry();
    start_ = index(geometry_.cell_at(problem.start_in_map));
    goal_ = index(geometry_.cell_at(problem.goal_in_map));
    start_in_map_ = problem.start_in_map;
    goal_in_map_ = problem.goal_in_map;
    Path path = plan.waypoints_in_map.size() > 2 && run(drivable, on_grid_m, out_of_time, plan.expanded) ? found_path()
                                                                                                         : Path{};
    if (path.empty()) return plan;
    smooth(drivable, path);
    if (path_length_m(path) < on_grid_m) plan.waypoints_in_map = std::move(path);
    return plan;
  }

  /// Whether a path shorter than `bound_m` was found.
  bool run(const Drivable& drivable, double bound_m, const OutOfTime& out_of_time, std::size_t& expanded) {
    begin();
    reach(start_, 0.0F, start_);
    while (!open_.empty()) {
      std::pop_heap(open_.begin(), open_.end());
      const Open entry = open_.back();
      open_.pop_back();
      Node& node = nodes_[entry.cell];
      if (node.is_closed || node.cost_m != entry.cost_m) continue;  // stale
      if (expanded++ % 256 == 0 && out_of_time && out_of_time()) return false;
      node.is_closed = true;
      const unsigned steps = open_steps(drivable, cell(entry.cell));
      if (!drivable.is_line_free(point(node.parent), point(entry.cell))) take_best_neighbour(entry.cell, steps);
      if (entry.cell == goal_) return static_cast<double>(node.cost_m) < bound_m;
      const std::uint32_t parent = node.parent;
      for (unsigned left = steps; left != 0; left &= left - 1) {
        const std::uint32_t next = beside(entry.cell, __builtin_ctz(left));
        Node& other = nodes_[next];
        if (other.generation == generation_ && other.is_closed) continue;
        const float cost_m = nodes_[parent].cost_m + distance_m(parent, next);
        if (other.generation == generation_ && cost_m >= other.cost_m) continue;
        if (static_cast<double>(cost_m + distance_m(next, goal_)) < bound_m) reach(next, cost_m, parent);
      }
    }
    return false;
  }

  /// The parent is out of sight after all: the cheapest expanded neighbour is the parent, as in A*.
  void take_best_neighbour(std::uint32_t at, unsigned steps) {
    Node& node = nodes_[at];
    node.cost_m = std::numeric_limits<float>::infinity();
    for (unsigned left = steps; left != 0; left &= left - 1) {
      const std::uint32_t other = beside(at, __builtin_ctz(left));
      if (nodes_[other].generation != generation_ || !nodes_[other].is_closed) continue;
      const float cost_m = nodes_[other].cost_m + distance_m(other, at);
      if (cost_m >= node.cost_m) continue;
      node.cost_m = cost_m;
      node.parent = other;
    }
  }

  void begin() {
    open_.clear();
    if (nodes_.size() != geometry_.cells() || generation_ == std::numeric_limits<std::uint32_t>::max() >> 1) {
      nodes_.assign(geometry_.cells(), Node{});
      generation_ = 0;
    }
    ++generation_;
  }

  void reach(std::uint32_t at, float cost_m, std::uint32_t parent) {
    Node& node = nodes_[at];
    node.cost_m = cost_m;
    node.parent = parent;
    node.generation = generation_;
    node.is_closed = false;
    open_.push_back({cost_m + distance_m(at, goal_), cost_m, at});
    std::push_heap(open_.begin(), open_.end());
  }

  Path found_path() const {
    Path path{goal_in_map_};
    for (std::uint32_t at = goal_; at != start_;) {
      at = nodes_[at].parent;
      path.push_back(point(at));
    }
    std::reverse(path.begin(), path.end());
    return path;
  }

  std::uint32_t index(Cell c) const { return static_cast<std::uint32_t>(geometry_.index(c)); }
  Cell cell(std::uint32_t at) const {
    const auto width = static_cast<std::uint32_t>(geometry_.width);
    return {static_cast<int>(at % width), static_cast<int>(at / width)};
  }
  std::uint32_t beside(std::uint32_t at, int direction) const {
    const Step& step = kSteps[static_cast<std::size_t>(direction)];
    return static_cast<std::uint32_t>(static_cast<std::int64_t>(at) +
                                      step.dy * static_cast<std::int64_t>(geometry_.width) + step.dx);
  }
  Point2 point(std::uint32_t at) const {
    if (at == start_) return start_in_map_;
    return at == goal_ ? goal_in_map_ : geometry_.center_in_map(cell(at));
  }
  float distance_m(std::uint32_t a, std::uint32_t b) const {
    const Point2 d = point(a) - point(b);
    return static_cast<float>(std::sqrt(d.x * d.x + d.y * d.y));
  }

  struct Node {
    float cost_m{0.0F};
    std::uint32_t parent{0};
    std::uint32_t generation : 31;
    std::uint32_t is_closed : 1;
    Node() : generation(0), is_closed(0) {}
  };
  struct Open {
    float through_m;
    float cost_m;
    std::uint32_t cell;
    bool operator<(const Open& other) const {
      return through_m != other.through_m ? through_m > other.through_m
                                          : cost_m < other.cost_m;  // on ties the one farther on
    }
  };

  std::unique_ptr<Planner> on_grid_{jps().make()};
  grid::Geometry geometry_;
  std::uint32_t start_{0}, goal_{0};
  Point2 start_in_map_, goal_in_map_;
  std::vector<Node> nodes_;
  std::vector<Open> open_;
  std::uint32_t generation_{0};
};

}  // namespace

Variant theta() {
  return {"theta", "lazy Theta*, any angle; never longer than the grid's optimum", false,
          [](Parameters&) -> std::unique_ptr<Planner> { return std::make_unique<LazyTheta>(); }, true};
}

}  // namespace aisle::global_planner
