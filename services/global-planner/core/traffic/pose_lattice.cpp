#include "services/global-planner/core/traffic/pose_lattice.hpp"

#include <algorithm>
#include <cmath>

#include "common/grid/line_of_sight.hpp"

namespace aisle::global_planner::traffic {
namespace {

using geometry::Point2;
using geometry::Pose2;

constexpr double kLeastRadiusM = 1.5;
constexpr double kWiderM = 0.5;  // the second radius is greater by this
constexpr double kArcPieceRad = 0.2;

/// Cells of the lattice for a length that is a multiple of its pitch.
int steps(double m) { return static_cast<int>(std::lround(m / kPosePitchM)); }

PoseMove straight(const Kind& kind, int quarter, double length_m) {
  const double heading = heading_of(quarter);
  const Point2 end = length_m * Point2{std::round(std::cos(heading)), std::round(std::sin(heading))};

  PoseMove move;
  move.to = {steps(end.x), steps(end.y), quarter};
  move.path = {{0.0, 0.0}, end};
  move.headings_rad = {heading, heading};
  move.shape = swept_shape(kind, move.path, move.headings_rad);
  move.is_reverse = length_m < 0.0;
  return move;
}

/// A quarter circle ahead; `side` 1: to the left, -1: to the right.
PoseMove quarter_circle(const Kind& kind, int quarter, double radius_m, int side) {
  const double heading = heading_of(quarter);
  const Pose2 start{0.0, 0.0, heading};
  const Point2 centre = to_map(start, {0.0, side * radius_m});
  const int pieces = static_cast<int>(std::ceil(0.5 * geometry::kPi / kArcPieceRad));

  PoseMove move;
  for (int i = 0; i <= pieces; ++i) {
    const double turned = side * 0.5 * geometry::kPi * i / pieces;
    move.path.push_back(to_map(Pose2{centre.x, centre.y, heading + turned}, {0.0, -side * radius_m}));
    move.headings_rad.push_back(geometry::wrap(heading + turned));
  }

  const int to_quarter = (quarter + side + 4) % 4;
  move.to = {steps(move.path.back().x), steps(move.path.back().y), to_quarter};
  move.path.back() = {move.to.x * kPosePitchM, move.to.y * kPosePitchM};
  move.headings_rad.back() = heading_of(to_quarter);
  move.shape = swept_shape(kind, move.path, move.headings_rad);
  return move;
}

/// Tarjan's walk without recursion.
class StronglyConnected {
 public:
  explicit StronglyConnected(const std::vector<std::vector<std::uint32_t>>& next)
      : next_(next),
        order_(next.size(), 0),
        low_(next.size(), 0),
        is_open_(next.size(), false),
        part_(next.size(), 0) {}

  std::vector<std::uint32_t> parts() {
    for (std::uint32_t root = 0; root < next_.size(); ++root)
      if (order_[root] == 0) walk_from(root);
    return part_;
  }

 private:
  struct Level {
    std::uint32_t node;
    std::size_t next;
  };

  void walk_from(std::uint32_t root) {
    std::vector<Level> stack;
    enter(root, stack);

    while (!stack.empty()) {
      const std::uint32_t node = stack.back().node;
      if (stack.back().next < next_[node].size()) {
        const std::uint32_t to = next_[node][stack.back().next++];
        if (order_[to] == 0) {
          enter(to, stack);
        } else if (is_open_[to]) {
          low_[node] = std::min(low_[node], order_[to]);
        }
        continue;
      }

      stack.pop_back();
      if (!stack.empty()) low_[stack.back().node] = std::min(low_[stack.back().node], low_[node]);
      if (low_[node] == order_[node]) close_part(node);
    }
  }

  void enter(std::uint32_t node, std::vector<Level>& stack) {
    order_[node] = low_[node] = ++met_;
    is_open_[node] = true;
    open_.push_back(node);
    stack.push_back({node, 0});
  }

  void close_part(std::uint32_t first) {
    std::uint32_t node = 0;
    do {
      node = open_.back();
      open_.pop_back();
      is_open_[node] = false;
      part_[node] = parts_;
    } while (node != first);
    ++parts_;
  }

  const std::vector<std::vector<std::uint32_t>>& next_;
  std::vector<std::uint32_t> order_;  // from 1 on; 0: not met
  std::vector<std::uint32_t> low_;
  std::vector<bool> is_open_;
  std::vector<std::uint32_t> open_;
  std::vector<std::uint32_t> part_;
  std::uint32_t parts_{0};
  std::uint32_t met_{0};
};

}  // namespace

double heading_of(int quarter) { return geometry::wrap(0.5 * geometry::kPi * quarter); }

PoseLattice::PoseLattice(const Kind& kind) {
  const double radius_m = std::ceil(std::max(kLeastRadiusM, kind.turning_radius_m) / kPosePitchM - 1e-9) * kPosePitchM;

  for (int quarter = 0; quarter < 4; ++quarter) {
    auto& moves = moves_[static_cast<std::size_t>(quarter)];
    for (const double length_m : {0.5, 1.0}) moves.push_back(straight(kind, quarter, length_m));
    for (const double wider_m : {0.0, kWiderM})
      for (const int side : {1, -1}) moves.push_back(quarter_circle(kind, quarter, radius_m + wider_m, side));
    if (kind.limits.max_reverse_mps > 0.0) moves.push_back(straight(kind, quarter, -0.5));

    for (const PoseMove& move : moves) {
      const Box& box = move.shape.box();
      reach_m_ = std::max({reach_m_, -box.low_in_map.x, -box.low_in_map.y, box.high_in_map.x, box.high_in_map.y});
    }
  }
}

/// How: each capsule without the tube is a disc that drives a straight line.
bool is_floor_free(const grid::ClearanceField& clearance, const Kind& kind, const Shape& shape) {
  const double stands_out_m = geometry::covering_discs(kind.footprint).radius_m - 0.5 * kind.footprint.width_m;
  const double more_m =
      kind.footprint.is_disc() ? kind.wall_margin_m : std::max(0.0, kind.wall_margin_m - stands_out_m);

  const Box& box = shape.box();
  const Point2 middle = 0.5 * (box.low_in_map + box.high_in_map);
  if (clearance.clearance_m(middle) >= distance(middle, box.high_in_map) + more_m) return true;

  return std::all_of(shape.capsules().begin(), shape.capsules().end(), [&](const Capsule& c) {
    return is_line_free(clearance, c.from_in_map, c.to_in_map, c.radius_m - kind.tube_m + more_m);
  });
}

std::vector<std::uint32_t> strongly_connected_parts(const std::vector<std::vector<std::uint32_t>>& next) {
  return StronglyConnected(next).parts();
}

}  // namespace aisle::global_planner::traffic
