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
  kOffPath,
  kUnreachable,
  kCancelled,
  kLate,
  kAuthority,
  kNoGrant,
  kPerson
};

/// A predicted pose of a vehicle's frame, `offset_s` seconds after the stamp of the status that lists
/// it.
struct IntentPoint {
  double offset_s{0.0};
  geometry::Pose2 base_in_map;
};

/// A pose on the way that the vehicle may still drive, and the step that it lies in.
struct HeldPose {
  geometry::Pose2 base_in_map;
  std::uint64_t step{0};
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

  // Of a plan with steps. Steps count from the vehicle's registration, see Grant.
  double progress_m{0.0};            // along the plan's waypoints, 0 to 1e9
  std::uint64_t step_done{0};        // steps behind it: the number of the step that it is on, or stands before
  std::uint64_t limit_step{0};       // it stops before this step at the latest
  double limit_m{0.0};               // the same along the plan's waypoints, 0 to 1e9
  std::uint64_t grant_number{0};     // that it obeys; 0: none
  std::uint32_t traffic_epoch{0};    // of the planner that it obeys; 0: none
  std::uint64_t heard_beat{0};       // newest TrafficStatus::beat of that planner
  double stray_m{0.0};               // farthest that its outline is off its outline on the way, 0 to 1e6
  bool wants_room{false};            // something is in the way that its tube is too narrow to pass
  std::vector<HeldPose> held;        // from where it is to its limit, at most 32; steps do not fall
  std::uint64_t traffic_boot_id{0};  // of the planner that it obeys; 0: none
  std::uint64_t grant_boot_id{0};    // of the planner that gave that grant: numbers of one do not count for another
};

/// "driving"
const char* name(Phase phase);

/// "no goal"
const char* name(Reason reason);

}  // namespace aisle::fleet
