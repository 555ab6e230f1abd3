#pragma once
#include <array>

#include "common/geometry/pose.hpp"

namespace aisle::global_planner {

/// The shortest way forwards between two poses with arcs no tighter than a radius and straights (Dubins 1957; the six
/// words after Shkel, Lumelsky 2001).
struct DubinsPath {
  struct Piece {
    double turn{0.0};  // 1/m: 1/radius to the left, -1/radius to the right, 0 straight
    double length_m{0.0};
  };
  geometry::Pose2 from_in_map;
  std::array<Piece, 3> pieces;
  double length_m{0.0};

  geometry::Pose2 pose_at(double along_m) const;
};

/// @pre radius_m > 0, finite poses
DubinsPath shortest_dubins(const geometry::Pose2& from_in_map, const geometry::Pose2& to_in_map, double radius_m);

/// The pose after `length_m` (negative: backwards) on an arc that turns by `turn` 1/m.
geometry::Pose2 along_arc(const geometry::Pose2& from_in_map, double turn, double length_m);

}  // namespace aisle::global_planner
