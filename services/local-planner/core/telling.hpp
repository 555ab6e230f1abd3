#pragma once

#include <optional>
#include <string>

#include "services/local-planner/core/inputs.hpp"
#include "services/local-planner/core/right_of_way/detours.hpp"
#include "services/local-planner/core/right_of_way/traffic.hpp"
#include "services/local-planner/core/speed_choice.hpp"

namespace aisle::local_planner {

/// A vehicle that drives by the dynamic window.
struct Driving {
  const Scene& scene;
  const SpeedChoice& speed;
  bool backs_off{false};    // along a way aside
  bool leaves_lane{false};  // on a detour or a way aside
};

/// Its status: driving, or avoiding while it leaves its lane or something is near; the recovery or what is avoided in
/// the detail; the wanted twist.
Output told_driving(const Driving& driving);

/// The status of one that turns on the spot.
Output told_turning(const geometry::Twist2& wanted);

/// The status of one that has left its path for good: it stops and asks for another plan from where it is.
Output told_off_path(geometry::Point2 here_in_map);

/// A vehicle that stands while it is under way.
struct Stop {
  const Advice& advice;
  const std::optional<Blocked>& blocked;
  const Choice& choice;
  double stuck_s{0.0};          // how long it has stood with a reason to move
  double blocked_after_s{3.0};  // then it is told where the way is obstructed, for the planners of ways
  double radius_m{0.35};
};

/// Why it stands, into phase, reason, detail and the blocked place of `out`. Says nothing of a vehicle that has just
/// stopped.
void tell_why_it_stands(const Stop& stop, Output& out);

/// What the vehicle avoids, in words; empty: nothing that is met.
std::string told_avoidance(const Scene& scene);

}  // namespace aisle::local_planner
