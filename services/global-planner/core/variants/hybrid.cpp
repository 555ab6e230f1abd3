// Hybrid A* (Dolgov, Thrun, Montemerlo, Diebel 2010), for vehicles that cannot turn on the spot: arcs of the turning
// radius to either side and straights, forwards and, dearer, backwards, over cells of place and heading. The heuristic
// is the way's length for a point, flooded from the goal; every now and then a Dubins path is tried that ends at the
// goal, heading included. Resolution-complete, not optimal. A vehicle that turns on the spot gets a Theta* path, which
// knows no headings.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <queue>
#include <unordered_map>
#include <vector>

#include "services/global-planner/core/dubins.hpp"
#include "services/global-planner/core/open_steps.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {

Variant theta();

namespace {

using geometry::Point2;
using geometry::Pose2;

constexpr int kHeadings = 72;

/// What a way costs beyond its length.
struct Prices {
  double reverse_factor;   // a metre backwards costs as much as so many forwards
  double steer_radii;      // steering otherwise costs as much as so many turning radii: a wheel takes its time
  double turn_back_radii;  // and changing between forwards and backwards as much as so many
};

constexpr std::size_t kMostExpanded = 1000000;
constexpr std::uint32_t kNoParent = std::numeric_limits<std::uint32_t>::max();

/// Way to the goal for a point, in metres, for every cell; infinite where there is none.
std::vector<float> distances_to_goal(const Drivable& drivable, grid::Cell goal) {
  const grid::Geometry& geometry = drivable.geometry();
  std::vector<float> distance_m(geometry.cells(), std::numeric_limits<float>::infinity());
  using Entry = std::pair<float, grid::Cell>;
  const auto is_later = [](const Entry& a, const Entry& b) { return a.first > b.first; };
  std::priority_queue<Entry, std::vector<Entry>, decltype(is_later)> open(is_later);
  distance_m[geometry.index(goal)] = 0.0F;
  open.push({0.0F, goal});
  while (!open.empty()) {
    const auto [here_m, cell] = open.top();
    open.pop();
    if (here_m > distance_m[geometry.index(cell)]) continue;
    for (unsigned left = open_steps(drivable, cell); left != 0; left &= left - 1) {
      const Step& step = kSteps[static_cast<std::size_t>(__builtin_ctz(left))];
      const grid::Cell next{cell.x + step.dx, cell.y + step.dy};
      const float there_m = here_m + static_cast<float>(geometry.resolution_m * step.cost / kStraightCost);
      if (there_m >= distance_m[geometry.index(next)]) continue;
      distance_m[geometry.index(next)] = there_m;
      open.push({there_m, next});
    }
  }
  return distance_m;
}

class Hybrid final : public Planner {
 public:
  explicit Hybrid(const Prices& prices) : prices_(prices) {}

  void rest() override { on_the_spot_->rest(); }

 private:
  struct Node {
    Pose2 pose_in_map;
    double cost_m;
    std::uint32_t parent;
    double turn;      // of the arc that led here
    double length_m;  // of that arc; negative: backwards
  };
  struct Open {
    double through_m;
    std::uint32_t node;
    bool operator<(const Open& other) const { return through_m > other.through_m; }
  };

  PlannedPath search(const Problem& problem, const Drivable& drivable, const OutOfTime& out_of_time) override {
    if (!(problem.steering.turning_radius_m > 0.0)) return on_the_spot_->plan(problem, out_of_time);
    drivable_ = &drivable;
    steering_ = problem.steering;
    goal_in_map_ = problem.goal_in_map;
    const double cell_m = drivable.geometry().resolution_m;
    // A step leaves its cell of place and heading: it turns by more than one of the headings, and is longer than a
    // diagonal.
    lattice_m_ = std::max(cell_m, 0.15 * steering_.turning_radius_m);
    step_m_ = std::max(1.5 * lattice_m_, 1.1 * 2.0 * geometry::kPi / kHeadings * steering_.turning_radius_m);
    sample_m_ = 0.5 * cell_m;
    cover(problem);
    if (problem.least_radius_m >= problem.radius_m && !fits(start_of(problem)))
      return {Outcome::kStartBlocked, {}, 0.0, 0, {}};
    if (steering_.goal_yaw_rad && !fits({goal_in_map_.x, goal_in_map_.y, *steering_.goal_yaw_rad}))
      return {Outcome::kGoalBlocked, {}, 0.0, 0, {}};
    to_goal_m_ = distances_to_goal(drivable, drivable.geometry().cell_at(goal_in_map_));
    PlannedPath plan;
    plan.outcome = run(start_of(problem), out_of_time, plan);
    return plan;
  }

  static Pose2 start_of(const Problem& problem) {
    return {problem.start_in_map.x, problem.start_in_map.y, geometry::wrap(problem.steering.start_yaw_rad)};
  }

  /// What the discs ahead must keep: between two samples they move on arcs beside the chords that are looked at, and
  /// who interpolates between the samples' poses moves a little beside those arcs.
  void cover(const Problem& problem) {
    double farthest_m = 0.0;
    for (const double ahead_m : steering_.discs_ahead_m) farthest_m = std::max(farthest_m, std::abs(ahead_m));
    arc_radii_ = std::hypot(1.0, farthest_m / steering_.turning_radius_m);
    Problem wider = problem;
    wider.radius_m += sample_m_ * sample_m_ * (1.0 + arc_radii_) / (8.0 * steering_.turning_radius_m);
    beside_chords_.emplace(wider);
    clearance_ = &problem.clearance;
    radius_m_ = std::max(wider.radius_m, 1e-3);
  }

  bool fits(const Pose2& pose) const {
    return std::all_of(steering_.discs_ahead_m.begin(), steering_.discs_ahead_m.end(), [&](double ahead_m) {
      return beside_chords_->is_free(geometry::to_map(pose, {ahead_m, 0.0}));
    });
  }

  Outcome run(const Pose2& start, const OutOfTime& out_of_time, PlannedPath& plan) {
    nodes_.assign(1, {start, 0.0, kNoParent, 0.0, 0.0});
    best_.clear();
    best_[key(start)] = 0.0;
    std::priority_queue<Open> open;
    open.push({heuristic_m(start), 0});
    std::size_t next_shot = 0;
    while (!open.empty() && plan.expanded < kMostExpanded) {
      const std::uint32_t at = open.top().node;
      open.pop();
      const Node node = nodes_[at];
      if (node.cost_m > best_[key(node.pose_in_map)]) continue;  // stale
      if (plan.expanded % 256 == 0 && out_of_time && out_of_time()) return Outcome::kOutOfTime;
      if (plan.expanded++ >= next_shot) {
        if (shoot(at, plan)) return Outcome::kFound;
        next_shot =
            plan.expanded + 1 + static_cast<std::size_t>(heuristic_m(node.pose_in_map) / steering_.turning_radius_m);
      }
      for (const double turn : {0.0, 1.0 / steering_.turning_radius_m, -1.0 / steering_.turning_radius_m}) {
        for (const double length_m : {step_m_, -step_m_}) {
          if (length_m < 0.0 && !steering_.may_reverse) continue;
          if (const std::uint32_t next = drive(at, turn, length_m); next != kNoParent) {
            open.push({nodes_[next].cost_m + heuristic_m(nodes_[next].pose_in_map), next});
          }
        }
      }
    }
    return Outcome::kNoPath;
  }

  /// The node at the end of the arc, kNoParent when it leads nowhere new.
  std::uint32_t drive(std::uint32_t at, double turn, double length_m) {
    const Node from = nodes_[at];
    const Pose2 end = along_arc(from.pose_in_map, turn, length_m);
    if (!std::isfinite(heuristic_m(end))) return kNoParent;
    const bool turns_back = from.parent != kNoParent && (from.length_m < 0.0) != (length_m < 0.0);
    const bool steers = from.parent != kNoParent && from.turn != turn;
    const double cost_m = from.cost_m + (steers ? prices_.steer_radii * steering_.turning_radius_m : 0.0) +
                          std::abs(length_m) * (length_m < 0.0 ? prices_.reverse_factor : 1.0) +
                          (turns_back ? prices_.turn_back_radii * steering_.turning_radius_m : 0.0);
    const auto [known, is_new] = best_.try_emplace(key(end), std::numeric_limits<double>::infinity());
    if (cost_m >= known->second || !is_arc_free(from.pose_in_map, turn, length_m)) return kNoParent;
    known->second = cost_m;
    nodes_.push_back({end, cost_m, at, turn, length_m});
    return static_cast<std::uint32_t>(nodes_.size() - 1);
  }

  /// Ends the plan with a Dubins path from this node to the goal, when one is free.
  bool shoot(std::uint32_t at, PlannedPath& plan) {
    std::vector<DubinsPath> shots;
    const int headings = steering_.goal_yaw_rad ? 1 : 16;
    for (int i = 0; i < headings; ++i) {
      const double yaw_rad = steering_.goal_yaw_rad.value_or(2.0 * geometry::kPi * i / headings);
      shots.push_back(shortest_dubins(nodes_[at].pose_in_map, {goal_in_map_.x, goal_in_map_.y, geometry::wrap(yaw_rad)},
                                      steering_.turning_radius_m));
    }
    std::sort(shots.begin(), shots.end(),
              [](const DubinsPath& a, const DubinsPath& b) { return a.length_m < b.length_m; });
    for (const DubinsPath& shot : shots) {
      if (!std::isfinite(shot.length_m) || !is_shot_free(shot)) continue;
      write(at, shot, plan);
      return true;
    }
    return false;
  }

  bool is_shot_free(const DubinsPath& shot) const {
    Pose2 from = shot.from_in_map;
    for (const DubinsPath::Piece& piece : shot.pieces) {
      if (!is_arc_free(from, piece.turn, piece.length_m)) return false;
      from = along_arc(from, piece.turn, piece.length_m);
    }
    return true;
  }

  int samples(double length_m) const {
    return std::max(1, static_cast<int>(std::ceil(std::abs(length_m) / sample_m_)));
  }

  bool is_arc_free(const Pose2& from, double turn, double length_m) const {
    Pose2 before = from;
    const int n = samples(length_m);
    const double piece_m = std::abs(length_m) / n * arc_radii_;  // what the disc moves that moves most
    for (int i = 1; i <= n; ++i) {
      if (const int passed = i - 1 + static_cast<int>(std::clamp(room_m(before) / piece_m, 0.0, n - i + 1.0));
          passed >= i) {
        before = along_arc(from, turn, length_m * passed / n);
        i = passed;
        continue;
      }
      const Pose2 here = along_arc(from, turn, length_m * i / n);
      if (!is_in_map(drivable_->geometry(), here.position()) ||
          !drivable_->is_line_free(before.position(), here.position()))
        return false;
      for (const double ahead_m : steering_.discs_ahead_m) {
        if (!beside_chords_->is_line_free(geometry::to_map(before, {ahead_m, 0.0}),
                                          geometry::to_map(here, {ahead_m, 0.0})))
          return false;
      }
      before = here;
    }
    return true;
  }

  /// How far every disc may move from here, wherever to: clearance changes no faster than one moves.
  double room_m(const Pose2& pose) const {
    double least_m = clearance_->clearance_m(pose.position());
    for (const double ahead_m : steering_.discs_ahead_m)
      least_m = std::min(least_m, clearance_->clearance_m(geometry::to_map(pose, {ahead_m, 0.0})));
    return least_m - radius_m_;
  }

  void write(std::uint32_t at, const DubinsPath& shot, PlannedPath& plan) const {
    std::vector<std::uint32_t> chain;
    for (std::uint32_t i = at; nodes_[i].parent != kNoParent; i = nodes_[i].parent) chain.push_back(i);
    append(nodes_.front().pose_in_map, plan);
    for (auto i = chain.rbegin(); i != chain.rend(); ++i) {
      append_arc(nodes_[nodes_[*i].parent].pose_in_map, nodes_[*i].turn, nodes_[*i].length_m, plan);
    }
    Pose2 from = shot.from_in_map;
    for (const DubinsPath::Piece& piece : shot.pieces) {
      if (piece.length_m > 1e-9) append_arc(from, piece.turn, piece.length_m, plan);
      from = along_arc(from, piece.turn, piece.length_m);
    }
    if (plan.waypoints_in_map.size() < 2) append(from, plan);
    plan.waypoints_in_map.back() = goal_in_map_;  // but for rounding it is there
  }

  void append_arc(const Pose2& from, double turn, double length_m, PlannedPath& plan) const {
    for (int i = 1, n = samples(length_m); i <= n; ++i) append(along_arc(from, turn, length_m * i / n), plan);
  }
  static void append(const Pose2& pose, PlannedPath& plan) {
    plan.waypoints_in_map.push_back(pose.position());
    plan.headings_rad.push_back(pose.yaw);
  }

  double heuristic_m(const Pose2& pose) const {
    if (!is_in_map(drivable_->geometry(), pose.position())) return std::numeric_limits<double>::infinity();
    return static_cast<double>(to_goal_m_[drivable_->geometry().index(drivable_->geometry().cell_at(pose.position()))]);
  }

  /// Cell of place and heading.
  std::uint64_t key(const Pose2& pose) const {
    const Point2 d = pose.position() - drivable_->geometry().origin_in_map;
    const auto x = static_cast<std::uint64_t>(d.x / lattice_m_);
    const auto y = static_cast<std::uint64_t>(d.y / lattice_m_);
    const auto heading =
        static_cast<std::uint64_t>((pose.yaw + geometry::kPi) / (2.0 * geometry::kPi) * kHeadings) % kHeadings;
    return (x << 40U) | (y << 12U) | heading;
  }

  std::unique_ptr<Planner> on_the_spot_{theta().make()};
  const Drivable* drivable_{nullptr};  // of the search under way
  std::optional<Drivable> beside_chords_;
  const grid::ClearanceField* clearance_{nullptr};
  double radius_m_{0.0};   // that a disc ahead must keep
  double arc_radii_{1.0};  // of the circle on which the farthest disc turns, in turning radii
  Prices prices_;
  Steering steering_;
  Point2 goal_in_map_;
  double lattice_m_{0.0}, step_m_{0.0}, sample_m_{0.0};
  std::vector<float> to_goal_m_;
  std::vector<Node> nodes_;
  std::unordered_map<std::uint64_t, double> best_;  // least cost of each cell of place and heading
};

}  // namespace

Variant hybrid() {
  return {"hybrid",
          "hybrid A* with a turning radius and headings at start and goal; without one as theta",
          false,
          [](Parameters& parameters) -> std::unique_ptr<Planner> {
            const Prices prices{
                parameters.number("reverse_factor", 2.0, 1.0, 100.0, "a metre backwards costs as many forwards"),
                parameters.number("steer_radii", 0.25, 0.0, 100.0, "turning radii that steering otherwise costs"),
                parameters.number("turn_back_radii", 1.0, 0.0, 100.0,
                                  "turning radii that changing between forwards and backwards costs")};
            return std::make_unique<Hybrid>(prices);
          },
          true,
          true};
}

}  // namespace aisle::global_planner
