#include "common/kinematics/omnidirectional.hpp"

#include <algorithm>

#include "common/kinematics/axis.hpp"

namespace aisle::kinematics {
namespace {

using geometry::Point2;

/// The velocity, shortened to `most` where it is faster; its direction stays.
Point2 within(Point2 velocity, double most) {
  const double speed = geometry::norm(velocity);
  return speed > most ? (most / speed) * velocity : velocity;
}

}  // namespace

/// The velocity moves on a straight line towards the target by at most rate dt: v' = v + within(target
/// - v, rate dt).
geometry::Twist2 limit_change_omnidirectional(const geometry::Twist2& current, const geometry::Twist2& wanted,
                                              const Limits& limits, double dt_s) {
  const Point2 now{current.linear_mps, current.sideways_mps};
  const Point2 target =
      within({std::max(wanted.linear_mps, -limits.max_reverse_mps), wanted.sideways_mps}, limits.max_speed_mps);
  const double rate_mps2 =
      geometry::norm(target) < geometry::norm(now) ? limits.max_deceleration_mps2 : limits.max_acceleration_mps2;
  const Point2 next = now + within(target - now, rate_mps2 * dt_s);
  const double angular = std::clamp(wanted.angular_radps, -limits.max_turn_radps, limits.max_turn_radps);

  return {next.x,
          approach(current.angular_radps, angular, limits.max_turn_acceleration_radps2,
                   limits.max_turn_acceleration_radps2, dt_s),
          next.y};
}

}  // namespace aisle::kinematics
