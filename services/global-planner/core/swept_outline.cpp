#include "services/global-planner/core/swept_outline.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry/separation.hpp"

namespace aisle::global_planner {
namespace {

using geometry::Body;
using geometry::Footprint;
using geometry::Point2;
using geometry::Pose2;

constexpr double kRounding_m = 1e-5;  // of clearances kept as float
constexpr double kTouching_m = 1e-9;
constexpr double kLongestPiece_cells = 16.0;

/// The first square that is not free, among those within `reach_m` of the segment, for which `is_met` holds.
template <class IsMet>
std::optional<grid::Cell> find_square(const grid::ClearanceField& field, Point2 a, Point2 b, double reach_m,
                                      const IsMet& is_met) {
  const grid::Geometry& g = field.geometry();
  const auto index = [&](double value, double origin) {
    return static_cast<int>(std::floor((value - origin) / g.resolution_m));
  };

  // One square farther on each side: what touches counts. Beyond the border one ring of squares is enough.
  const int low_x = std::max(-1, index(std::min(a.x, b.x) - reach_m, g.origin_in_map.x) - 1);
  const int low_y = std::max(-1, index(std::min(a.y, b.y) - reach_m, g.origin_in_map.y) - 1);
  const int high_x = std::min(g.width, index(std::max(a.x, b.x) + reach_m, g.origin_in_map.x) + 1);
  const int high_y = std::min(g.height, index(std::max(a.y, b.y) + reach_m, g.origin_in_map.y) + 1);

  for (int y = low_y; y <= high_y; ++y) {
    for (int x = low_x; x <= high_x; ++x) {
      const grid::Cell cell{x, y};

      // Not free (outside the grid the clearance is 0), and near enough to be asked.
      if (field.clearance_m(cell) > 0.0) continue;
      const Point2 center = g.center_in_map(cell);
      if (geometry::distance_to_segment(center, a, b) > reach_m + g.resolution_m) continue;

      const Body square{Body::Shape::kRectangle, {center.x, center.y, 0.0}, 0.0, g.resolution_m, g.resolution_m};
      if (is_met(square)) return cell;
    }
  }

  return {};
}

/// The pose after this part (0 to 1) of the way.
Pose2 between(const Pose2& from, const Pose2& to, double part) {
  return {from.x + part * (to.x - from.x), from.y + part * (to.y - from.y),
          from.yaw + part * geometry::wrap(to.yaw - from.yaw)};
}

/// A bound on how far any point of the outline moves.
double moved_m(const Footprint& footprint, const Pose2& from, const Pose2& to) {
  return geometry::distance(from.position(), to.position()) +
         geometry::reach_m(footprint) * std::abs(geometry::wrap(to.yaw - from.yaw));
}

/// Where the outline overlaps the square on the way, found by halving it: the middle overlaps, or is farther from the
/// square than the outline moves in half of the way, or both halves are looked at, the first one first.
std::optional<Pose2> overlap(const Footprint& footprint, const Pose2& from, const Pose2& to, const Body& square) {
  const Pose2 middle = between(from, to, 0.5);
  const double gap_m = geometry::separation_m(geometry::body_of(footprint, middle), square);
  if (gap_m < -kRounding_m) return middle;
  if (gap_m - 0.5 * moved_m(footprint, from, to) >= -kRounding_m) return {};

  if (const auto before = overlap(footprint, from, middle, square)) return before;

  return overlap(footprint, middle, to, square);
}

/// Does the vehicle drive along its own axis, ahead or back?
bool is_straight(const Pose2& from, const Pose2& to) {
  const Point2 sideways = geometry::from_map(from, to.position());
  return std::abs(geometry::wrap(to.yaw - from.yaw)) < 1e-12 && std::abs(sideways.y) < 1e-9;
}

/// All that a rectangle covers on a straight way along its axis: a longer rectangle.
Body drawn_out(const Footprint& footprint, const Pose2& from, const Pose2& to) {
  Body body = geometry::body_of(footprint, between(from, to, 0.5));

  body.length_m += geometry::distance(from.position(), to.position());
  return body;
}

}  // namespace

// The line is cut into pieces, so that the squares around each are few.
std::optional<grid::Cell> square_near_line(const grid::ClearanceField& field, Point2 from, Point2 to, double radius_m) {
  const double nearest_m = std::max(kTouching_m, radius_m - kRounding_m);
  const double length_m = geometry::distance(from, to);
  const int pieces = 1 + static_cast<int>(length_m / (kLongestPiece_cells * field.geometry().resolution_m));

  for (int i = 0; i < pieces; ++i) {
    const Point2 a = from + (static_cast<double>(i) / pieces) * (to - from);
    const Point2 b = from + (static_cast<double>(i + 1) / pieces) * (to - from);
    const Point2 middle = 0.5 * (a + b);
    const Body line{
        Body::Shape::kRectangle, {middle.x, middle.y, geometry::bearing(from, to)}, 0.0, length_m / pieces, 0.0};

    const auto square = find_square(field, a, b, radius_m,
                                    [&](const Body& other) { return geometry::separation_m(line, other) < nearest_m; });

    if (square) return square;
  }

  return {};
}

std::optional<Touch> touched_on_way(const grid::ClearanceField& field, const Footprint& footprint, const Pose2& from,
                                    const Pose2& to) {
  const double reach_m = geometry::reach_m(footprint);
  const double longest_m = std::max(reach_m, kLongestPiece_cells * field.geometry().resolution_m);
  const bool is_drawn_out = is_straight(from, to);
  const int pieces = 1 + static_cast<int>(moved_m(footprint, from, to) / longest_m);

  for (int i = 0; i < pieces; ++i) {
    const Pose2 a = between(from, to, static_cast<double>(i) / pieces);
    const Pose2 b = between(from, to, static_cast<double>(i + 1) / pieces);

    Pose2 there = b;
    const auto square = find_square(field, a.position(), b.position(), reach_m, [&](const Body& other) {
      if (is_drawn_out) return geometry::separation_m(drawn_out(footprint, a, b), other) < -kRounding_m;
      const std::optional<Pose2> pose = overlap(footprint, a, b, other);
      if (pose) there = *pose;

      return pose.has_value();
    });

    if (square) return Touch{*square, there};
  }

  return {};
}

}  // namespace aisle::global_planner
