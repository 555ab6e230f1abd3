// Jump point search without corner cutting (Harabor, Grastien 2011, 2012, 2014): A* that expands only cells where a
// shortest path can have to turn. Straight jumps look at 64 cells at once; cells on a diagonal are passed without being
// opened, so from a parent to its child a path runs diagonally first, then straight. Lengths are those of A*.
#include <algorithm>
#include <vector>

#include "services/global-planner/core/distances.hpp"
#include "services/global-planner/core/neighbours.hpp"
#include "services/global-planner/core/search_memory.hpp"
#include "services/global-planner/core/traversable_bits.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

using grid::Cell;

constexpr int kNorthEast = 4;  // the first diagonal of kSteps

class JumpPointSearch final : public Planner {
 public:
  void rest() override { *this = JumpPointSearch(); }

 private:
  PlannedPath search(const Problem& problem, const Drivable& drivable, const OutOfTime& out_of_time) override {
    geometry_ = drivable.geometry();
    start_ = geometry_.cell_at(problem.start_in_map);
    goal_ = geometry_.cell_at(problem.goal_in_map);
    bits_.make(drivable);
    parents_.resize(geometry_.cells());
    PlannedPath plan = blank();
    plan.outcome = run(out_of_time, plan.expanded);
    if (plan.outcome != Outcome::kFound) return plan;
    trace(plan.waypoints_in_map);
    join_exact_ends(problem, plan.waypoints_in_map);
    return plan;
  }

  Outcome run(const OutOfTime& out_of_time, std::size_t& expanded) {
    nodes_.begin(geometry_.cells());
    open_.begin();
    const std::uint32_t start = index(start_);
    const std::uint32_t goal = index(goal_);
    found_ = false;
    nodes_.reach(start, 0, 0);
    open_.push(octile(start_, goal_), start, 0);
    BucketQueue::Entry entry;
    while (open_.pop(entry)) {
      if (found_ && open_.rank() > BucketQueue::rank_of(nodes_.cost(goal))) break;
      if (nodes_.is_closed(entry.cell) || nodes_.cost(entry.cell) != entry.cost) continue;  // stale
      if (expanded % 256 == 0 && out_of_time && out_of_time()) return found_ ? Outcome::kFound : Outcome::kOutOfTime;
      nodes_.close(entry.cell);
      if (entry.cell == goal) continue;  // the rest of this bucket might lead there at a lower cost
      ++expanded;
      expand(entry);
    }
    return found_ ? Outcome::kFound : Outcome::kNoPath;
  }

  void expand(const BucketQueue::Entry& entry) {
    const auto width = static_cast<std::uint32_t>(geometry_.width);
    from_ = entry;
    const Cell cell{static_cast<int>(entry.cell % width), static_cast<int>(entry.cell / width)};
    if (entry.cell == index(start_)) {
      for (int straight = 0; straight < 4; ++straight) jump_straight(cell, entry.cost, straight);
      for (int diagonal = kNorthEast; diagonal < 8; ++diagonal) jump_diagonally(cell, diagonal);
      return;
    }
    // Opened cells are reached straight; they turn where a cell beside the one before is blocked.
    const int ahead = nodes_.direction(entry.cell);
    const Step& step = kSteps[static_cast<std::size_t>(ahead)];
    jump_straight(cell, entry.cost, ahead);
    for (const int side : {(ahead + 1) % 4, (ahead + 3) % 4}) {
      const Step& aside = kSteps[static_cast<std::size_t>(side)];
      const bool is_forced = is_open({cell.x + aside.dx, cell.y + aside.dy}) &&
                             !is_open({cell.x - step.dx + aside.dx, cell.y - step.dy + aside.dy});
      if (!is_forced) continue;
      jump_straight(cell, entry.cost, side);
      jump_diagonally(cell, kNorthEast + (side == (ahead + 1) % 4 ? ahead : side));
    }
  }

  /// Opens the first jump point straight ahead; `cost` is that of `cell`.
  void jump_straight(Cell cell, std::uint32_t cost, int direction) {
    if (is_too_late(cell, cost)) return;
    const bool is_row = direction % 2 == 0;
    const bool is_up = direction < 2;
    const BitLines& lines = is_row ? bits_.rows() : bits_.columns();
    const int line = is_row ? cell.y : cell.x;
    const int at = is_row ? cell.x : cell.y;
    const BitLines::Stop stop = is_up ? lines.scan_up(line, at) : lines.scan_down(line, at);
    const int goal_at = is_row ? goal_.x : goal_.y;
    const bool meets_goal = line == (is_row ? goal_.y : goal_.x) &&
                            (is_up ? goal_at > at && goal_at < stop.at : goal_at < at && goal_at > stop.at);
    if (!meets_goal && !stop.is_jump_point) return;
    const int end = meets_goal ? goal_at : stop.at;
    reach(is_row ? Cell{end, line} : Cell{line, end},
          cost + kStraightCost * static_cast<std::uint32_t>(std::abs(end - at)), direction);
  }

  /// Opens what straight jumps find from each cell of the diagonal.
  void jump_diagonally(Cell cell, int direction) {
    const Step& step = kSteps[static_cast<std::size_t>(direction)];
    const int first = direction - kNorthEast;  // the two straight directions that the diagonal lies between
    const int second = (first + 1) % 4;
    std::uint32_t cost = from_.cost;
    while (is_open({cell.x + step.dx, cell.y}) && is_open({cell.x, cell.y + step.dy}) &&
           is_open({cell.x + step.dx, cell.y + step.dy})) {
      cell = {cell.x + step.dx, cell.y + step.dy};
      cost += kDiagonalCost;
      if (cell == goal_) return reach(cell, cost, first);
      if (is_too_late(cell, cost)) return;
      jump_straight(cell, cost, first);
      jump_straight(cell, cost, second);
    }
  }

  /// Is the path that was found no longer than any through this cell?
  bool is_too_late(Cell cell, std::uint32_t cost) const {
    return found_ && cost + octile(cell, goal_) >= nodes_.cost(index(goal_));
  }

  void reach(Cell cell, std::uint32_t cost, int direction) {
    const std::uint32_t at = index(cell);
    if (nodes_.is_known(at) && cost >= nodes_.cost(at)) return;
    nodes_.reach(at, cost, direction);
    parents_[at] = from_.cell;
    found_ = found_ || cell == goal_;
    open_.push(cost + octile(cell, goal_), at, cost);
  }

  /// Centres of the cells where the path begins, turns and ends.
  void trace(std::vector<geometry::Point2>& points) const {
    const auto width = static_cast<std::uint32_t>(geometry_.width);
    points.push_back(geometry_.center_in_map(goal_));
    for (Cell cell = goal_; cell != start_;) {
      const std::uint32_t before = parents_[index(cell)];
      const Cell parent{static_cast<int>(before % width), static_cast<int>(before / width)};
      const int dx = cell.x - parent.x;
      const int dy = cell.y - parent.y;
      const int diagonal = std::min(std::abs(dx), std::abs(dy));
      const Cell turn{parent.x + (dx > 0 ? diagonal : -diagonal), parent.y + (dy > 0 ? diagonal : -diagonal)};
      if (turn != cell && turn != parent) points.push_back(geometry_.center_in_map(turn));
      points.push_back(geometry_.center_in_map(parent));
      cell = parent;
    }
    std::reverse(points.begin(), points.end());
  }

  /// A straight piece holds between centres; from a point beside one it might not, so that one step leads to the next
  /// centre.
  void join_exact_ends(const Problem& problem, std::vector<geometry::Point2>& points) const {
    const auto one_step = [&](geometry::Point2 from, geometry::Point2 to) {
      const Cell a = geometry_.cell_at(from);
      const Cell b = geometry_.cell_at(to);
      const auto sign = [](int d) { return d > 0 ? 1 : d < 0 ? -1 : 0; };
      return geometry_.center_in_map({a.x + sign(b.x - a.x), a.y + sign(b.y - a.y)});
    };
    if (problem.start_in_map != points.front()) {
      const geometry::Point2 next = one_step(points.front(), points[1]);
      if (geometry_.cell_at(next) != geometry_.cell_at(points[1])) points.insert(points.begin() + 1, next);
      points.front() = problem.start_in_map;
    }
    if (problem.goal_in_map != points.back()) {
      const geometry::Point2 next = one_step(points.back(), points[points.size() - 2]);
      if (geometry_.cell_at(next) != geometry_.cell_at(points[points.size() - 2]))
        points.insert(points.end() - 1, next);
      points.back() = problem.goal_in_map;
    }
  }

  bool is_open(Cell c) const { return bits_.is_open(c); }
  std::uint32_t index(Cell c) const { return static_cast<std::uint32_t>(geometry_.index(c)); }

  grid::Geometry geometry_;
  Cell start_, goal_;
  TraversableBits bits_;
  SearchNodes nodes_;
  std::vector<std::uint32_t> parents_;
  BucketQueue open_;
  BucketQueue::Entry from_{};  // being expanded
  bool found_{false};
};

}  // namespace

Variant jps() {
  return {"jps", "jump point search on the grid that the vehicle can drive; optimal, no passes", true,
          [](Parameters&) -> std::unique_ptr<Planner> { return std::make_unique<JumpPointSearch>(); }};
}

}  // namespace aisle::global_planner
