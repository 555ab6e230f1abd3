#pragma once

#include <optional>
#include <string>

#include "services/local-planner/core/detours.hpp"
#include "services/local-planner/core/inputs.hpp"
#include "services/local-planner/core/speed_choice.hpp"

namespace aisle::local_planner {

/// A vehicle that drives by the dynamic window.
struct Driving {
  const Scene& scene;
  const SpeedChoice& speed;
  bool backs_off{false};    // along a way back
  bool leaves_lane{false};  // on a detour or a way back
};

/// Its status: driving, or avoiding while it leaves its lane or something is near; the recovery or what is avoided in
/// the detail; the wanted twist.
Output told_driving(const Driving& driving);

/// The status of one that turns on the spot.
Output told_turning(const geometry::Twist2& wanted);

/// The status of one that has left its path for good: it stops and asks for another plan from where it is.
Output told_off_path(geometry::Point2 here_in_map);

/// Into the status of one that has left its tube, and comes back slowly.
void tell_stray(geometry::Point2 here_in_map, Output& out);

/// For what road a vehicle waits, in words: "agv-3, agv-7: goal taken by agv-7".
std::string told_waiting(const std::optional<Grant>& grant);

/// A vehicle that stands while it is under way.
struct Stop {
  bool is_at_limit{false};  // at the end of what is granted
  const std::optional<Grant>& grant;
  const std::optional<Blocked>& blocked;
  const Choice& choice;
  double stuck_s{0.0};          // how long it has stood with a reason to move
  double blocked_after_s{3.0};  // then it is told where the way is obstructed, for the planners of ways
  double radius_m{0.35};
};

/// Why it stands, into phase, reason, detail and the blocked place of `out`. Says nothing of a vehicle that has just
/// stopped, but where its road ends.
void tell_why_it_stands(const Stop& stop, Output& out);

/// What the vehicle avoids, in words; empty: nothing that is met.
std::string told_avoidance(const Scene& scene);

}  // namespace aisle::local_planner
