#include "common/geometry/separation.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace aisle::geometry {
namespace {

using Corners = std::array<Point2, 4>;

/// Front left, rear left, rear right, front right; in map.
Corners corners_of(const Body& box) {
  const double l = 0.5 * box.length_m;
  const double w = 0.5 * box.width_m;
  return {to_map(box.base_in_map, {l, w}), to_map(box.base_in_map, {-l, w}), to_map(box.base_in_map, {-l, -w}),
          to_map(box.base_in_map, {l, -w})};
}

/// Metres from the point to the rectangle's edge; negative within: minus the way to the nearest edge.
double signed_distance_m(const Body& box, Point2 in_map) {
  const Point2 local = from_map(box.base_in_map, in_map);
  const double dx = std::abs(local.x) - 0.5 * box.length_m;
  const double dy = std::abs(local.y) - 0.5 * box.width_m;
  if (dx <= 0.0 && dy <= 0.0) return std::max(dx, dy);
  return std::hypot(std::max(0.0, dx), std::max(0.0, dy));
}

/// How far the other outline is from the box along each of the box's own axes; the greater of the two,
/// in metres. Negative where their shadows overlap on both axes.
double gap_on_axes_of_m(const Body& box, const Corners& other) {
  double gap_m = -1e18;
  for (const bool along : {true, false}) {
    double low = 1e18;
    double high = -1e18;

    for (const Point2 corner : other) {
      const Point2 local = from_map(box.base_in_map, corner);
      const double value = along ? local.x : local.y;
      low = std::min(low, value);
      high = std::max(high, value);
    }

    const double half = 0.5 * (along ? box.length_m : box.width_m);
    gap_m = std::max({gap_m, low - half, -half - high});
  }

  return gap_m;
}

/// Separating axes: two convex outlines overlap exactly when their shadows overlap on the axes of both;
/// then the least overlap is the depth. Where they are apart, one of the eight corners is nearest to
/// the other outline.
double between_boxes_m(const Body& a, const Body& b) {
  const Corners of_a = corners_of(a);
  const Corners of_b = corners_of(b);

  const double gap_m = std::max(gap_on_axes_of_m(a, of_b), gap_on_axes_of_m(b, of_a));
  if (gap_m <= 0.0) return gap_m;

  double least_m = 1e18;  // of two convex outlines that are apart, a corner of one is nearest to the other
  for (const Point2 corner : of_b) least_m = std::min(least_m, signed_distance_m(a, corner));
  for (const Point2 corner : of_a) least_m = std::min(least_m, signed_distance_m(b, corner));

  return least_m;
}

}  // namespace

/// A disc is its centre with a margin of its radius.
double separation_m(const Body& a, const Body& b) {
  const bool a_is_disc = a.shape == Body::Shape::kDisc;
  const bool b_is_disc = b.shape == Body::Shape::kDisc;
  if (a_is_disc && b_is_disc)
    return distance(a.base_in_map.position(), b.base_in_map.position()) - a.radius_m - b.radius_m;
  if (a_is_disc) return signed_distance_m(b, a.base_in_map.position()) - a.radius_m;
  if (b_is_disc) return signed_distance_m(a, b.base_in_map.position()) - b.radius_m;

  return between_boxes_m(a, b);
}

}  // namespace aisle::geometry
