#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::fleet {

/// What a vehicle is doing on its way to its goal.
enum class Phase { kWaiting, kTurning, kDriving, kAvoiding, kBlocked, kArrived, kFailed, kHeld };

/// Why it is in that phase.
enum class Reason {
  kNone,
  kNoGoal,
  kNoMap,
  kNoPlan,
  kNoState,
  kNoTracker,
  kStaleState,
  kStaleTracker,
  kPlanOutdated,
  kObstacle,
  kVehicle,
  kYielding,
  kOffPath,
  kUnreachable,
  kCancelled,
  kLate,
  kAuthority
};

/// A predicted pose of a vehicle's frame, `offset_s` seconds after the stamp of the status that lists
/// it.
struct IntentPoint {
  double offset_s{0.0};
  geometry::Pose2 base_in_map;
};

/// What a vehicle's local planner says of its way, 10 times a second.
struct NavigationStatus {
  std::string agv_id;
  std::string goal_id;  // empty: no goal
  std::uint64_t plan_id{0};
  std::uint64_t map_revision{0};
  Phase phase{Phase::kWaiting};
  Reason reason{Reason::kNone};
  std::string detail;  // for people, at most 256 characters
  double distance_left_m{0.0};
  double time_left_s{0.0};
  geometry::Point2 blocked_at_in_map;  // where the way is blocked, in Phase::kBlocked
  double blocked_radius_m{0.0};        // 0 to 100; 0: unknown
  double control_ms{0.0};              // computing time of the newest cycle
  std::vector<IntentPoint> intent;     // the way that it claims, from its stamp on, at most 64; offsets do not fall
};

/// "driving"
const char* name(Phase phase);

/// "no goal"
const char* name(Reason reason);

}  // namespace aisle::fleet
