#pragma once

#include <algorithm>
#include <cmath>

#include "common/geometry/pose.hpp"

namespace aisle::geometry {

/// The outline of a thing that stands or moves on the floor: a disc around its pose, or a rectangle
/// whose middle is its pose (length along its heading, width across). The lengths of the other shape
/// are ignored.
struct Body {
  enum class Shape { kDisc, kRectangle };

  Shape shape{Shape::kDisc};
  Pose2 base_in_map;
  double radius_m{0.0};  // of the disc
  double length_m{0.0};  // of the rectangle
  double width_m{0.0};
};

/// Radius of the circle around its middle that holds all of it, in metres.
inline double reach_m(const Body& body) {
  return body.shape == Body::Shape::kDisc ? body.radius_m : 0.5 * std::hypot(body.length_m, body.width_m);
}

/// Metres from the point to the outline; 0 on it. Within a disc negative (minus the way out), within a
/// rectangle 0.
inline double distance_m(const Body& body, Point2 in_map) {
  if (body.shape == Body::Shape::kDisc) return distance(body.base_in_map.position(), in_map) - body.radius_m;

  const Point2 local = from_map(body.base_in_map, in_map);
  const double dx = std::max(0.0, std::abs(local.x) - 0.5 * body.length_m);
  const double dy = std::max(0.0, std::abs(local.y) - 0.5 * body.width_m);

  return std::hypot(dx, dy);
}

/// Distance in metres along the ray from `from_in_map` in direction `angle_rad` (radians, in map) to
/// the outline; 0 from within; `max_m` when it does not meet the outline before.
///
/// How, for a disc: the point at distance s along the ray is on the circle where s^2 - 2 s (d . c) +
/// |c|^2 - r^2 = 0, with c from the ray's start to the centre and d the direction; the lesser solution
/// is the hit. For a rectangle: slabs (Kay, Kajiya 1986), the ray lies within the rectangle where it
/// lies between both pairs of parallel sides.
inline double ray_hit_m(const Body& body, Point2 from_in_map, double angle_rad, double max_m) {
  if (body.shape == Body::Shape::kDisc) {
    const Point2 to_center = body.base_in_map.position() - from_in_map;
    const Point2 direction{std::cos(angle_rad), std::sin(angle_rad)};
    const double outside = dot(to_center, to_center) - body.radius_m * body.radius_m;
    if (outside <= 0.0) return 0.0;

    const double along = dot(to_center, direction);
    const double root = along * along - outside;

    return along > 0.0 && root >= 0.0 ? std::min(max_m, along - std::sqrt(root)) : max_m;
  }

  const Point2 start = from_map(body.base_in_map, from_in_map);
  const double local_angle = angle_rad - body.base_in_map.yaw;
  const Point2 direction{std::cos(local_angle), std::sin(local_angle)};
  double enters = 0.0;
  double leaves = max_m;

  const auto clip = [&](double begin, double change, double half) {
    if (std::abs(change) < 1e-12) {
      if (std::abs(begin) > half) leaves = -1.0;
      return;
    }

    const double a = (-half - begin) / change;
    const double b = (half - begin) / change;

    enters = std::max(enters, std::min(a, b));
    leaves = std::min(leaves, std::max(a, b));
  };

  clip(start.x, direction.x, 0.5 * body.length_m);
  clip(start.y, direction.y, 0.5 * body.width_m);

  return enters <= leaves ? enters : max_m;
}

}  // namespace aisle::geometry
