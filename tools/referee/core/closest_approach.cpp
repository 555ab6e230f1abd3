#include "tools/referee/core/closest_approach.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace aisle::referee {
namespace {

using geometry::Point2;
using geometry::Pose2;

/// A turn is cut into steps of at most this angle, each with a fixed heading.
constexpr double kTurnStep_rad = 0.02;

/// Corners of a convex outline, counter-clockwise; a disc has the one corner in its centre.
struct Outline {
  std::array<Point2, 16> corners;
  std::size_t count{0};

  void add(Point2 p) { corners[count++] = p; }
};

/// Around the shape's pose, turned by `yaw_rad`; without its radius.
Outline outline_of(const Shape& shape, double yaw_rad) {
  Outline outline;
  if (shape.is_disc()) {
    outline.add({0.0, 0.0});
    return outline;
  }

  const Pose2 turned{0.0, 0.0, yaw_rad};
  const double l = 0.5 * shape.length_m;
  const double w = 0.5 * shape.width_m;

  for (const Point2 corner : {Point2{l, w}, Point2{-l, w}, Point2{-l, -w}, Point2{l, -w}}) {
    outline.add(geometry::to_map(turned, corner));
  }

  return outline;
}

/// Convex hull (monotone chain: Andrew 1979) of the points, in place.
void keep_hull(Outline& o) {
  if (o.count < 3) return;

  std::sort(o.corners.begin(), o.corners.begin() + static_cast<std::ptrdiff_t>(o.count),
            [](Point2 a, Point2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });

  std::array<Point2, 32> hull;
  std::size_t size = 0;

  const auto push = [&](Point2 p, std::size_t floor) {
    while (size >= floor + 2 && geometry::cross(hull[size - 1] - hull[size - 2], p - hull[size - 2]) <= 0.0) --size;
    hull[size++] = p;
  };

  for (std::size_t i = 0; i < o.count; ++i) push(o.corners[i], 0);

  const std::size_t upper = size - 1;
  for (std::size_t i = o.count - 1; i-- > 0;) push(o.corners[i], upper);
  o.count = std::min(size - 1, o.corners.size());
  std::copy_n(hull.begin(), o.count, o.corners.begin());
}

/// All differences a - b of the outlines' points: the place of b's pose relative to a's where the two overlap.
Outline minkowski_difference(const Outline& a, const Outline& b) {
  Outline sum;
  for (std::size_t i = 0; i < a.count; ++i) {
    for (std::size_t j = 0; j < b.count; ++j) sum.add(a.corners[i] - b.corners[j]);
  }

  keep_hull(sum);
  return sum;
}

/// Where the point of the segment nearest to `p` lies: 0 at `from`, 1 at `to`.
double share_nearest(Point2 p, Point2 from, Point2 to) {
  const Point2 way = to - from;
  const double length2 = geometry::dot(way, way);
  return length2 > 0.0 ? std::clamp(geometry::dot(p - from, way) / length2, 0.0, 1.0) : 0.0;
}

/// Left of, or on, every edge.
bool contains(const Outline& o, Point2 p) {
  if (o.count < 3) return false;

  for (std::size_t i = 0; i < o.count; ++i) {
    const Point2 a = o.corners[i];
    const Point2 b = o.corners[(i + 1) % o.count];
    if (geometry::cross(b - a, p - a) < 0.0) return false;
  }

  return true;
}

/// Keeps the smaller distance in `best`.
void consider(Approach& best, double distance_m, double at) {
  if (distance_m < best.clearance_m) best = {distance_m, at};
}

/// Where the segments from..to and a..b cross, as a share of from..to; less than 0 when they do not.
double share_crossing(Point2 from, Point2 to, Point2 a, Point2 b) {
  const Point2 way = to - from;
  const Point2 edge = b - a;

  const double area = geometry::cross(way, edge);
  if (area == 0.0) return -1.0;

  const double along_way = geometry::cross(a - from, edge) / area;
  const double along_edge = geometry::cross(a - from, way) / area;

  return along_way >= 0.0 && along_way <= 1.0 && along_edge >= 0.0 && along_edge <= 1.0 ? along_way : -1.0;
}

/// Distance from the segment from..to to the convex outline, 0 when it enters it.
Approach distance_of_segment(Point2 from, Point2 to, const Outline& outline) {
  if (contains(outline, from)) return {0.0, 0.0};

  Approach best{1e18, 0.0};
  for (std::size_t i = 0; i < outline.count; ++i) {
    const Point2 a = outline.corners[i];
    const Point2 b = outline.corners[(i + 1) % outline.count];
    const double t = share_nearest(a, from, to);

    consider(best, geometry::distance(a, from + t * (to - from)), t);

    if (outline.count == 1) break;

    consider(best, geometry::distance_to_segment(from, a, b), 0.0);
    consider(best, geometry::distance_to_segment(to, a, b), 1.0);

    const double crossing = share_crossing(from, to, a, b);
    if (crossing >= 0.0) consider(best, 0.0, crossing);
  }

  return best;
}

/// The pose at a share of the interval, 0 to 1.
Pose2 between(const Motion& m, double share) {
  return {m.begin.x + share * (m.end.x - m.begin.x), m.begin.y + share * (m.end.y - m.begin.y),
          m.begin.yaw + share * geometry::wrap(m.end.yaw - m.begin.yaw)};
}

/// Radians that the body turns during the interval; a disc's heading does not matter.
double turn_of(const Motion& m) { return m.shape.is_disc() ? 0.0 : std::fabs(geometry::wrap(m.end.yaw - m.begin.yaw)); }

/// During shares low..high, with both headings held at their middle, less what the corners move by the turn.
Approach approach_with_fixed_headings(const Motion& a, const Motion& b, double low, double high) {
  const double middle = 0.5 * (low + high);
  const Outline difference =
      minkowski_difference(outline_of(a.shape, between(a, middle).yaw), outline_of(b.shape, between(b, middle).yaw));
  Approach best = distance_of_segment(between(b, low).position() - between(a, low).position(),
                                      between(b, high).position() - between(a, high).position(), difference);
  const double half_turn = 0.5 * (high - low);
  const double swing_m = half_turn * (turn_of(a) * 0.5 * std::hypot(a.shape.length_m, a.shape.width_m) +
                                      turn_of(b) * 0.5 * std::hypot(b.shape.length_m, b.shape.width_m));

  best.clearance_m -= a.shape.radius_m + b.shape.radius_m + swing_m;
  best.at = low + best.at * (high - low);

  return best;
}

}  // namespace

/// Steps of the turn, each with fixed headings; the least counts.
Approach closest_approach(const Motion& a, const Motion& b) {
  const int steps = std::max(1, static_cast<int>(std::ceil(std::max(turn_of(a), turn_of(b)) / kTurnStep_rad)));
  Approach best{1e18, 0.0};

  for (int i = 0; i < steps; ++i) {
    const Approach part =
        approach_with_fixed_headings(a, b, static_cast<double>(i) / steps, static_cast<double>(i + 1) / steps);
    consider(best, part.clearance_m, part.at);
  }

  return best;
}

}  // namespace aisle::referee
