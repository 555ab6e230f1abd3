#pragma once

#include <cstddef>
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::local_planner {

/// Between the points of lanes, detours and ways back.
inline constexpr double kRouteStepM = 0.2;

/// A polyline in map that is driven along, addressed by its arc length s in metres from its first point.
class Route {
 public:
  Route() = default;

  /// Points closer than 1 cm to the one before are dropped.
  explicit Route(const std::vector<geometry::Point2>& points_in_map);

  /// Without any point.
  bool empty() const { return points_.empty(); }
  double length_m() const { return empty() ? 0.0 : along_m_.back(); }
  const std::vector<geometry::Point2>& points() const { return points_; }

  /// Arc length of point `i`.
  double along_m(std::size_t i) const { return along_m_[i]; }

  /// Index of the last point that is not beyond `s`; 0 before the first.
  std::size_t point_before(double s_m) const;

  /// s outside [0, length] is taken as the nearer end. @pre not empty
  geometry::Point2 at(double s_m) const;

  /// Direction of the route there, in map, rad. @pre not empty; 0 for a single point
  double heading_at(double s_m) const;

  /// The s in [from, to] whose point is nearest to `p`. @pre not empty
  double project(geometry::Point2 p, double from_s_m, double to_s_m) const;

  /// The points from one s to another, both included. @pre not empty
  std::vector<geometry::Point2> part(double from_s_m, double to_s_m) const;

  /// The part from `s` on, with `head` before it.
  Route spliced(const std::vector<geometry::Point2>& head, double s_m) const;

 private:
  /// Index of the segment that holds `s`.
  std::size_t segment_at(double s_m) const;

  std::vector<geometry::Point2> points_;
  std::vector<double> along_m_;
  std::vector<double> heading_rad_;  // of each segment
};

/// Points every `step_m` along a polyline, ends included.
std::vector<geometry::Point2> resample(const std::vector<geometry::Point2>& points, double step_m);

}  // namespace aisle::local_planner
