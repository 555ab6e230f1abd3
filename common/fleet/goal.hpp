#pragma once

#include <string>

#include "common/geometry/pose.hpp"

namespace aisle::fleet {

/// Where a vehicle shall go. A cancelled goal: the vehicle brakes and holds where it is.
struct Goal {
  std::string agv_id;
  std::string id;                    // "agv-1/2"; the same id: the same goal, given again
  geometry::Pose2 pose_in_map;       // of the vehicle's frame
  double position_tolerance_m{0.1};  // 0 to 100
  double yaw_tolerance_rad{0.0};     // 0 to 7; 0: any heading
  bool is_cancelled{false};
};

inline bool operator==(const Goal& a, const Goal& b) {
  return a.agv_id == b.agv_id && a.id == b.id && a.pose_in_map.x == b.pose_in_map.x &&
         a.pose_in_map.y == b.pose_in_map.y && a.pose_in_map.yaw == b.pose_in_map.yaw &&
         a.position_tolerance_m == b.position_tolerance_m && a.yaw_tolerance_rad == b.yaw_tolerance_rad &&
         a.is_cancelled == b.is_cancelled;
}

inline bool operator!=(const Goal& a, const Goal& b) { return !(a == b); }

}  // namespace aisle::fleet
