#include "services/local-planner/core/printed/path_following.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::local_planner {
namespace {

constexpr double kHereM = 1e-3;    // the direction to a point so near says nothing
constexpr double kCreepMps = 0.1;  // towards a point behind
constexpr double kStraightPerM = 1e-9;

}  // namespace

geometry::Twist2 follow_path(const geometry::Pose2& base_in_map, geometry::Point2 ahead_in_map,
                             const kinematics::Limits& limits) {
  const geometry::Point2 ahead = geometry::from_map(base_in_map, ahead_in_map);
  const double distance2 = geometry::dot(ahead, ahead);
  if (distance2 < kHereM * kHereM) return {};
  if (ahead.x < 0.0)
    return {std::min(kCreepMps, limits.max_speed_mps), std::copysign(limits.max_turn_radps, ahead.y), 0.0};

  const double curvature_per_m = 2.0 * ahead.y / distance2;
  const double fastest_mps = std::abs(curvature_per_m) > kStraightPerM
                                 ? std::min(limits.max_speed_mps, limits.max_turn_radps / std::abs(curvature_per_m))
                                 : limits.max_speed_mps;
  return {fastest_mps, fastest_mps * curvature_per_m, 0.0};
}

}  // namespace aisle::local_planner
