#pragma once

#include <array>

#include "common/geometry/pose.hpp"

namespace aisle::global_planner {

/// The shortest way forwards between two poses with arcs no tighter than a radius, and straights (Dubins, "On curves of
/// minimal length with a constraint on average curvature", 1957): one of six words of three pieces, LSL, RSR, LSR, RSL,
/// RLR, LRL (Shkel, Lumelsky, "Classification of the Dubins set", 2001).
struct DubinsPath {
  /// An arc or a straight.
  struct Piece {
    double turn{0.0};  // 1/m: 1/radius to the left, -1/radius to the right, 0 straight
    double length_m{0.0};
  };

  geometry::Pose2 from_in_map;
  std::array<Piece, 3> pieces;
  double length_m{0.0};

  /// The pose in map after `along_m`; before the start it is the start, beyond the end the end.
  geometry::Pose2 pose_at(double along_m) const;
};

/// The shortest of the six words between two poses in map. @pre radius_m > 0, finite poses
DubinsPath shortest_dubins(const geometry::Pose2& from_in_map, const geometry::Pose2& to_in_map, double radius_m);

/// The pose after `length_m` (negative: backwards) on an arc that turns by `turn` 1/m; 0: straight on.
geometry::Pose2 along_arc(const geometry::Pose2& from_in_map, double turn, double length_m);

}  // namespace aisle::global_planner
