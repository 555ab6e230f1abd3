#pragma once
#include <cmath>

namespace aisle::geometry {

inline constexpr double kPi = 3.14159265358979323846;

/// Metres, in the frame that the variable's name says (`goal_in_map`, `hit_in_base`).
struct Point2 {
  double x{0.0};
  double y{0.0};
};

inline Point2 operator+(Point2 a, Point2 b) { return {a.x + b.x, a.y + b.y}; }
inline Point2 operator-(Point2 a, Point2 b) { return {a.x - b.x, a.y - b.y}; }
inline Point2 operator*(double k, Point2 a) { return {k * a.x, k * a.y}; }
inline bool operator==(Point2 a, Point2 b) { return a.x == b.x && a.y == b.y; }
inline bool operator!=(Point2 a, Point2 b) { return !(a == b); }
inline double dot(Point2 a, Point2 b) { return a.x * b.x + a.y * b.y; }
inline double cross(Point2 a, Point2 b) { return a.x * b.y - a.y * b.x; }
inline double norm(Point2 a) { return std::hypot(a.x, a.y); }
inline double distance(Point2 a, Point2 b) { return norm(a - b); }
inline double bearing(Point2 from, Point2 to) { return std::atan2(to.y - from.y, to.x - from.x); }

/// Position in metres and heading in radians, (-pi, pi], counter-clockwise from the frame's x axis.
struct Pose2 {
  double x{0.0};
  double y{0.0};
  double yaw{0.0};
  Point2 position() const { return {x, y}; }
};

/// Speed in the vehicle's own frame; sideways_mps is 0 but for omnidirectional vehicles.
struct Twist2 {
  double linear_mps{0.0};
  double angular_radps{0.0};
  double sideways_mps{0.0};
};

/// The same angle in (-pi, pi].
inline double wrap(double angle_rad) {
  const double wrapped = std::remainder(angle_rad, 2.0 * kPi);
  return wrapped <= -kPi ? wrapped + 2.0 * kPi : wrapped;
}

/// A point given in the frame of `frame_in_map`, in map.
inline Point2 to_map(const Pose2& frame_in_map, Point2 in_frame) {
  const double c = std::cos(frame_in_map.yaw);
  const double s = std::sin(frame_in_map.yaw);
  return {frame_in_map.x + c * in_frame.x - s * in_frame.y, frame_in_map.y + s * in_frame.x + c * in_frame.y};
}

/// A point given in map, in the frame of `frame_in_map`.
inline Point2 from_map(const Pose2& frame_in_map, Point2 in_map) {
  const double c = std::cos(frame_in_map.yaw);
  const double s = std::sin(frame_in_map.yaw);
  const Point2 d = in_map - frame_in_map.position();
  return {c * d.x + s * d.y, -s * d.x + c * d.y};
}

inline bool is_finite(Point2 p) { return std::isfinite(p.x) && std::isfinite(p.y); }
inline bool is_finite(const Pose2& p) { return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.yaw); }

/// Least distance from `p` to the segment from `a` to `b`.
inline double distance_to_segment(Point2 p, Point2 a, Point2 b) {
  const Point2 ab = b - a;
  const double length2 = dot(ab, ab);
  const double t = length2 > 0.0 ? std::fmin(1.0, std::fmax(0.0, dot(p - a, ab) / length2)) : 0.0;
  return distance(p, a + t * ab);
}

}  // namespace aisle::geometry
