#pragma once
#include <optional>
#include <string>

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

}  // namespace aisle::local_planner
