#pragma once

#include <cstddef>
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::global_planner {

/// How far a vehicle has come along its path: the nearest point of the path, which never goes back and never jumps far
/// ahead, as a path may come close to itself.
class PathProgress {
 public:
  PathProgress() = default;
  explicit PathProgress(std::vector<geometry::Point2> path_in_map);

  /// Follows the vehicle to its new place; looks at most 3 m along the path, from the point reached so far.
  void advance(geometry::Point2 base_in_map);

  /// From the point reached to the end, both included; empty for an empty path.
  std::vector<geometry::Point2> remaining() const;

  /// Metres from the vehicle's last position to the point reached.
  double off_path_m() const { return off_path_m_; }

 private:
  std::vector<geometry::Point2> path_;  // in map
  std::size_t segment_{0};              // from path_[segment_] to the next point: where reached_ lies
  geometry::Point2 reached_;
  double off_path_m_{0.0};
};

}  // namespace aisle::global_planner
