#pragma once

#include "services/local-planner/core/moment.hpp"
#include "services/local-planner/core/rollout.hpp"
#include "services/local-planner/core/target.hpp"

namespace aisle::local_planner {

/// The twist of a turn on the spot by `error_rad` to the left: as fast as half the turn acceleration can brake in what
/// is left, v = sqrt(2 a |error|), and no faster than the limit.
geometry::Twist2 turn_by(double error_rad, const kinematics::Limits& limits);

/// What a cycle's decision to turn looks at.
struct TurnQuestion {
  const Scene& scene;
  const Vehicle& vehicle;
  const Target& target;
  double left_m{0.0};      // of the way
  bool stays_here{false};  // it waits before what obstructs its way
};

/// Does the vehicle turn on the spot, to face its target? Begins at a large error and ends at a small one:
///
///   drives ── error > 0.9 rad (0.45 near the way's end) ──► turns
///          ◄── error < 0.2 rad, at the target, told to stay, or a corner would touch something ──
///
/// A vehicle that cannot turn on the spot never does.
class TurnOnTheSpot {
 public:
  /// Is it to turn in this cycle? Begins and ends turns.
  bool look(const TurnQuestion& question, const DwaSettings& settings);

  /// It is held, or drives: a turn has ended.
  void end() { turns_ = false; }

  /// The twist while it turns: first the vehicle comes to a stand, and turns on at half the rate meanwhile.
  static geometry::Twist2 twist(double error_rad, const geometry::Twist2& in_force, const kinematics::Limits& limits);

 private:
  bool turns_{false};
};

}  // namespace aisle::local_planner
