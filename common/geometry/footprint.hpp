#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "common/geometry/body.hpp"

namespace aisle::geometry {

/// A vehicle's outline in its own frame: a disc around its origin, or a rectangle (length along its heading) whose
/// middle lies `ahead_m` before the origin: a forklift's frame is in its fixed axle, and the forks reach beyond it.
struct Footprint {
  Body::Shape shape{Body::Shape::kDisc};
  double radius_m{0.35};  // of the disc
  double length_m{0.0};   // of the rectangle
  double width_m{0.0};
  double ahead_m{0.0};  // from the origin to the rectangle's middle; negative: behind

  /// The other shape is the rectangle.
  bool is_disc() const { return shape == Body::Shape::kDisc; }
};

/// A disc around the frame's origin. @pre radius_m >= 0
inline Footprint disc(double radius_m) { return {Body::Shape::kDisc, radius_m, 0.0, 0.0, 0.0}; }

/// A rectangle along the frame's x axis. @pre lengths >= 0; `ahead_m` may be negative
inline Footprint rectangle(double length_m, double width_m, double ahead_m = 0.0) {
  return {Body::Shape::kRectangle, 0.0, length_m, width_m, ahead_m};
}

/// As samples and files say it: a length of 0 is a disc.
inline Footprint footprint_of(double radius_m, double length_m, double width_m, double ahead_m) {
  return length_m > 0.0 ? rectangle(length_m, width_m, ahead_m) : disc(radius_m);
}

/// Radius of the circle around the frame's origin that holds all of it.
inline double reach_m(const Footprint& footprint) {
  if (footprint.is_disc()) return footprint.radius_m;
  return std::hypot(0.5 * footprint.length_m + std::abs(footprint.ahead_m), 0.5 * footprint.width_m);
}

/// The outline in map of a vehicle whose frame stands at `base_in_map`.
inline Body body_of(const Footprint& footprint, const Pose2& base_in_map) {
  const Point2 middle = to_map(base_in_map, {footprint.ahead_m, 0.0});
  return {footprint.shape, footprint.is_disc() ? base_in_map : Pose2{middle.x, middle.y, base_in_map.yaw},
          footprint.radius_m, footprint.length_m, footprint.width_m};
}

/// Equal discs along the vehicle's axis that together hold the footprint.
struct CoveringDiscs {
  double radius_m{0.35};
  std::vector<double> ahead_m{0.0};  // of their centres, from the frame's origin
};

/// One disc for a disc; for a rectangle three to five, the more the longer it is. Each covers its equal share of the
/// length, corners included, so they stand out to the sides by hypot(length / 2 n, width / 2) - width / 2 (Ziegler,
/// Stiller 2010): 5 cm at 2.4 x 1.1 m.
inline CoveringDiscs covering_discs(const Footprint& footprint) {
  if (footprint.is_disc()) return {footprint.radius_m, {0.0}};

  const double ratio = footprint.length_m / std::max(1e-3, footprint.width_m);
  const int count = std::clamp(static_cast<int>(std::ceil(2.0 * ratio)), 3, 5);
  CoveringDiscs out{std::hypot(0.5 * footprint.length_m / count, 0.5 * footprint.width_m), {}};

  for (int i = 0; i < count; ++i)
    out.ahead_m.push_back(footprint.ahead_m + footprint.length_m * ((i + 0.5) / count - 0.5));

  return out;
}

}  // namespace aisle::geometry
