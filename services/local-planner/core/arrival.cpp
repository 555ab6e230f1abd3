#include "services/local-planner/core/arrival.hpp"

#include <cmath>

#include "services/local-planner/core/turning.hpp"

namespace aisle::local_planner {
namespace {

constexpr double kNearEnoughS = 3.0;      // within the tolerance, while something is in the way of the goal's middle
constexpr double kAbreastM = 0.02;        // so little ahead or behind the goal is abreast
constexpr double kMiddleShare = 0.3;      // of the tolerance: so near is the goal's middle
constexpr double kPushedAwayShare = 2.0;  // of the tolerance: so far is no longer there
constexpr double kYawShare = 0.5;         // of the heading's tolerance: a smaller error need not be turned away
constexpr double kNoCommandMps = 1e-3;    // a smaller command is none

}  // namespace

void Arrival::begin(time::Stamp now) {
  has_arrived_ = false;
  near_since_ = now;
}

std::optional<AtGoal> Arrival::look(const Moment& moment, const geometry::Twist2& in_force) {
  if (!is_there(moment)) return std::nullopt;

  const Plan& plan = *moment.inputs.plan;

  const double error_rad = geometry::wrap(plan.goal_in_map.yaw - moment.motion.base_then.yaw);
  const bool heading_matters = moment.vehicle.turns_on_the_spot() && plan.yaw_tolerance_rad > 0.0;
  const bool stands = moment.motion.stands();

  if (!has_arrived_ && heading_matters && std::abs(error_rad) > kYawShare * plan.yaw_tolerance_rad)
    return AtGoal{Phase::kTurning, stands ? turn_by(error_rad, moment.vehicle.limits) : geometry::Twist2{}};

  // It has arrived once it stands and is told to stand.
  if (stands && std::abs(in_force.linear_mps) < kNoCommandMps) has_arrived_ = true;
  return AtGoal{has_arrived_ ? Phase::kArrived : Phase::kDriving, {}};
}

/// Is it within the goal's tolerance, and would driving on bring it no nearer? It is abreast of the goal or beyond, at
/// its middle, or has been near for long.
bool Arrival::is_there(const Moment& moment) {
  const Plan& plan = *moment.inputs.plan;
  const double distance_m = geometry::distance(moment.here(), plan.goal_in_map.position());

  // Once there, it stays there until it is pushed away.
  if (has_arrived_ && distance_m > kPushedAwayShare * plan.position_tolerance_m) has_arrived_ = false;
  if (has_arrived_) return true;

  const bool is_near = distance_m <= plan.position_tolerance_m;
  if (!is_near) near_since_ = moment.now;
  const bool is_near_for_long = time::seconds(moment.now - near_since_) > kNearEnoughS;

  const double ahead_m = geometry::from_map(moment.motion.base_now, plan.goal_in_map.position()).x;
  const bool gets_no_nearer = std::abs(ahead_m) < kAbreastM || distance_m < kMiddleShare * plan.position_tolerance_m ||
                              ahead_m < 0.0 || is_near_for_long;

  return is_near && gets_no_nearer;
}

}  // namespace aisle::local_planner
