#pragma once

#include "services/local-planner/core/critic.hpp"
#include "services/local-planner/core/dwa.hpp"
#include "services/local-planner/core/moment.hpp"
#include "services/local-planner/core/recovery.hpp"

namespace aisle::local_planner {

/// A cycle in which the vehicle drives by the dynamic window.
struct SpeedSearch {
  const Moment& moment;
  const Scene& scene;
  const Aim& aim;
  double error_rad{0.0};     // from the heading to the target, to the left
  bool stays_here{false};    // it waits before what obstructs its way
  geometry::Twist2 braking;  // where no speed is admissible
};

/// What came of it.
struct SpeedChoice {
  geometry::Twist2 wanted;
  Grade grade{Grade::kNone};  // of the recovery, where every speed that moves was refused
  Choice choice;
  bool is_refused_by_people{false};  // passing by: there is more room in a moment
};

/// The dynamic window's best speed. Where it refuses all that moves, though the vehicle might: what gets it over that
/// (`way_out`). Where nothing does: it brakes.
SpeedChoice choose_speed(const SpeedSearch& search, const Variant& variant, const DwaSettings& settings);

}  // namespace aisle::local_planner
