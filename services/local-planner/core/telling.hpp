#pragma once
#include <optional>
#include <string>
#include <vector>

#include "services/local-planner/core/inputs.hpp"
#include "services/local-planner/core/recovery.hpp"
#include "services/local-planner/core/right_of_way/traffic.hpp"
#include "services/local-planner/core/way.hpp"

namespace aisle::local_planner {

/// The way is obstructed and no detour was found.
struct Blocked {
  Obstructed where;
  std::string vehicle_id;  // of what stands there; empty: not a vehicle
};

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

/// The way that it claims: points from `way.s_m()` to `end_m`, with the time when it is there at the profile's speeds,
/// in s from now.
struct Claim {
  std::vector<IntentPoint> points;  // at most 62
  double time_left_s{0.0};          // to the way's end, beyond the claim too
};
/// @param end_m of the current way, not claimed beyond; more than 24 m ahead is not claimed either
Claim claim_of(const Way& way, double end_m);

}  // namespace aisle::local_planner
