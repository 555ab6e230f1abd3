#pragma once

#include "common/geometry/pose.hpp"

namespace aisle::referee {

/// A rectangle around the pose (length along its heading), grown by radius_m on all sides. A disc has
/// length and width 0; a square map cell or a box has radius 0.
struct Shape {
  double radius_m{0.0};
  double length_m{0.0};
  double width_m{0.0};

  bool is_disc() const { return length_m == 0.0 && width_m == 0.0; }

  /// Of the circle around the pose that holds all of it.
  double reach_m() const { return radius_m + 0.5 * std::hypot(length_m, width_m); }
};

/// A body that moves in a straight line, at constant speed and turning rate, from `begin` to `end`, in
/// map.
struct Motion {
  Shape shape;
  geometry::Pose2 begin;
  geometry::Pose2 end;
};

/// The nearest moment of two bodies.
struct Approach {
  double clearance_m{0.0};  // between the outlines; 0 or less: they touched. Overlaps are at least as deep as it says
  double at{0.0};           // when, as a share of the interval, 0..1
};

/// Least clearance of two bodies during one interval.
///
/// Exact for discs and for rectangles that keep their headings: the path of one relative to the other
/// is a segment, and the distance from it to the Minkowski difference of the outlines has a closed
/// form. For a rectangle that turns, the result is too small by at most 1 % of its half diagonal, and
/// never too large.
Approach closest_approach(const Motion& a, const Motion& b);

}  // namespace aisle::referee
