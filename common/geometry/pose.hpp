#pragma once

#include <cmath>

namespace aisle::geometry {

inline constexpr double kPi = 3.14159265358979323846;

/// A point or a vector of the plane: metres (or metres a second), in the frame that the variable's name
/// says (`goal_in_map`, `hit_in_base`). Frames are right-handed: x ahead or to the right, y to the left
/// or upwards.
struct Point2 {
  double x{0.0};
  double y{0.0};
};

inline Point2 operator+(Point2 a, Point2 b) { return {a.x + b.x, a.y + b.y}; }
inline Point2 operator-(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }
inline Point2 operator*(double k, Point2 a) { return {k * a.x, k * a.y}; }
inline bool operator==(Point2 a, Point2 b) { return a.x == b.x && a.y == b.y; }
inline bool operator!=(Point2 a, Point2 b) { return !(a == b); }

/// |a| |b| cos(angle from a to b): how far `b` goes along `a`, times |a|.
inline double dot(Point2 a, Point2 b) { return a.x * b.x + a.y * b.y; }

/// |a| |b| sin(angle from a to b): positive where `b` points to the left of `a`.
inline double cross(Point2 a, Point2 b) { return a.x * b.y - a.y * b.x; }

/// Length of a vector, >= 0.
inline double norm(Point2 a) { return std::hypot(a.x, a.y); }
inline double distance(Point2 a, Point2 b) { return norm(a - b); }

/// Direction from one point to the other: radians in [-pi, pi], counter-clockwise from the x axis of
/// the frame of both; 0 for equal points.
inline double bearing(Point2 from, Point2 to) { return std::atan2(to.y - from.y, to.x - from.x); }

/// Position in metres and heading in radians, (-pi, pi], counter-clockwise from the frame's x axis. As
/// a frame: its origin and the direction of its x axis.
struct Pose2 {
  double x{0.0};
  double y{0.0};
  double yaw{0.0};

  /// The pose without its heading.
  Point2 position() const { return {x, y}; }
};

/// Velocity of a vehicle in its own frame: ahead (negative: backwards), turning counter-clockwise, and
/// to the left. sideways_mps is 0 but for omnidirectional vehicles.
struct Twist2 {
  double linear_mps{0.0};
  double angular_radps{0.0};
  double sideways_mps{0.0};
};

/// The same angle in (-pi, pi].
///
/// How: std::remainder gives [-pi, pi] without a loop, whatever the number of turns; of its two ends
/// only pi is kept.
inline double wrap(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * kPi);
  return wrapped <= -kPi ? wrapped + 2.0 * kPi : wrapped;
}

/// A point given in the frame of `frame_in_map`, in map: turned by the frame's yaw, then moved to its
/// origin.
///
///     x' = x_f + x cos(yaw) - y sin(yaw)
///     y' = y_f + x sin(yaw) + y cos(yaw)
inline Point2 to_map(const Pose2& frame_in_map, Point2 in_frame) {
  const double c = std::cos(frame_in_map.yaw);
  const double s = std::sin(frame_in_map.yaw);
  return {frame_in_map.x + c * in_frame.x - s * in_frame.y, frame_in_map.y + s * in_frame.x + c * in_frame.y};
}

/// A point given in map, in the frame of `frame_in_map`: the inverse of to_map, so moved first and then
/// turned back.
inline Point2 from_map(const Pose2& frame_in_map, Point2 in_map) {
  const double c = std::cos(frame_in_map.yaw);
  const double s = std::sin(frame_in_map.yaw);
  const Point2 d = in_map - frame_in_map.position();
  return {c * d.x + s * d.y, -s * d.x + c * d.y};
}

/// No NaN and no infinity among the numbers.
inline bool is_finite(Point2 p) { return std::isfinite(p.x) && std::isfinite(p.y); }
inline bool is_finite(const Pose2& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.yaw); }

/// Least distance in metres from `p` to the segment from `a` to `b`; to `a` where both are the same
/// point.
///
/// How: t is where the foot of `p` lies on the line through `a` and `b`, 0 at `a` and 1 at `b`; beyond
/// the ends the nearest end counts.
///
///     t = ((p - a) . (b - a)) / |b - a|^2
inline double distance_to_segment(Point2 p, Point2 a, Point2 b) {
  const Point2 ab = b - a;
  const double length2 = dot(ab, ab);
  const double t = length2 > 0.0 ? std::fmin(1.0, std::fmax(0.0, dot(p - a, ab) / length2)) : 0.0;
  return distance(p, a + t * ab);
}

}  // namespace aisle::geometry
