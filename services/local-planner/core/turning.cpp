#include "services/local-planner/core/turning.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::local_planner {
namespace {

using geometry::Twist2;

constexpr double kTurnBeginRad = 0.9;
constexpr double kTurnBeginNearEndRad = 0.45;
constexpr double kTurnEndRad = 0.2;        // well below the begin, so that turning and driving do not alternate
constexpr double kNearEndM = 0.6;          // of the way's end
constexpr double kAtTargetM = 0.03;        // the direction to a target so near says nothing
constexpr double kNearlyStandsMps = 0.02;  // slower: it turns on the spot
constexpr double kBrakingShare = 0.5;      // of the turn acceleration, to end a turn with

}  // namespace

Twist2 turn_by(double error_rad, const kinematics::Limits& limits) {
  const double rate =
      std::min(limits.max_turn_radps,
               std::sqrt(2.0 * kBrakingShare * limits.max_turn_acceleration_radps2 * std::abs(error_rad)));
  return {0.0, std::copysign(rate, error_rad), 0.0};
}

bool TurnOnTheSpot::look(const TurnQuestion& question, const DwaSettings& settings) {
  const bool is_at_target = question.target.distance_m < kAtTargetM;

  // Hysteresis: begins at a large error, ends at a small one.
  const double begin_rad = question.left_m < kNearEndM ? kTurnBeginNearEndRad : kTurnBeginRad;
  if (std::abs(question.target.error_rad) > begin_rad && !is_at_target) turns_ = true;
  if (std::abs(question.target.error_rad) < kTurnEndRad || is_at_target) turns_ = false;

  if (question.stays_here || !question.vehicle.turns_on_the_spot()) turns_ = false;

  // A disc may always turn; whatever else turns on the spot looks where its corners go.
  if (turns_ && !question.vehicle.footprint.is_disc()) {
    const Twist2 turn = turn_by(question.target.error_rad, question.vehicle.limits);
    turns_ = obstruction(question.scene, turn, settings) == Obstruction::kNone;
  }

  return turns_;
}

Twist2 TurnOnTheSpot::twist(double error_rad, const Twist2& in_force, const kinematics::Limits& limits) {
  if (std::abs(in_force.linear_mps) < kNearlyStandsMps) return turn_by(error_rad, limits);
  return {0.0, in_force.angular_radps * 0.5, 0.0};
}

}  // namespace aisle::local_planner
