#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/geometry/footprint.hpp"
#include "common/grid/clearance.hpp"
#include "common/kinematics/vehicle_model.hpp"
#include "common/time/stamp.hpp"
#include "services/obstacle-tracker/core/track.hpp"

namespace aisle::local_planner {

/// What the vehicle is doing; order and meaning of the IDL's NavigationPhase.
enum class Phase { kWaiting, kTurning, kDriving, kAvoiding, kBlocked, kArrived, kFailed, kHeld };

/// Why; order and meaning of the IDL's NavigationReason.
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

const char* name(Phase phase);
const char* name(Reason reason);

/// The vehicle that this planner drives.
struct Vehicle {
  std::string id;
  double radius_m{0.35};  // of the circle around its base that holds all of it
  kinematics::Limits limits;
  std::optional<geometry::Footprint> rectangle{};  // none: it is that circle

  geometry::CoveringDiscs discs() const {
    return geometry::covering_discs(rectangle ? *rectangle : geometry::disc(radius_m));
  }
  bool turns_on_the_spot() const { return limits.model != kinematics::Model::kTricycle; }
};

struct VehicleState {
  geometry::Pose2 base_in_map;
  geometry::Twist2 twist;
  double steering_rad{0.0};  // of a tricycle's wheel
};

/// Where a vehicle will be, `offset_s` after the moment that its list says.
struct IntentPoint {
  double offset_s{0.0};
  geometry::Pose2 base_in_map;
};

/// The newest plan for this vehicle.
struct Plan {
  enum class Outcome { kFound, kNotFound, kCancelled };
  std::uint64_t id{0};
  std::string goal_id;
  std::uint64_t map_revision{0};
  Outcome outcome{Outcome::kFound};
  std::string detail;  // why there is no path
  geometry::Pose2 goal_in_map;
  double position_tolerance_m{0.15};
  double yaw_tolerance_rad{0.0};                   // 0: any heading
  std::vector<geometry::Point2> waypoints_in_map;  // turning points; the last is the goal
};

/// Another vehicle of the fleet, with the moments at which its samples arrived here.
struct Peer {
  std::string id;
  double radius_m{0.35};
  kinematics::Limits limits;
  VehicleState state;
  time::Stamp state_arrived{};
  Phase phase{Phase::kWaiting};
  Reason reason{Reason::kNone};
  std::vector<IntentPoint> intent;  // the way that it claims; empty or one point: it stays
  time::Stamp intent_arrived{};
  std::optional<geometry::Footprint> rectangle{};  // none: a disc
};

struct SeenTrack {
  obstacle_tracker::Track track;
  time::Stamp arrived{};
};

/// Everything that one cycle looks at. Stamps are of the caller's clock, the one that `now` is taken from.
struct Inputs {
  const grid::ClearanceField* clearance{nullptr};  // of the newest complete map; null: none yet
  std::uint64_t map_revision{0};
  std::optional<Vehicle> vehicle;
  time::Latest<VehicleState> state;
  std::optional<Plan> plan;
  time::Stamp tracker_heard{};  // arrival of its newest status, whoever's scan it tells of; 0: never
  time::Stamp tracker_alive{};  // the newest that told of a new scan of this vehicle's own lidar; 0: never
  std::vector<SeenTrack> tracks;
  std::vector<Peer> peers;
  bool authority_lost{false};  // the vehicle obeys a higher epoch than ours
};

/// Something that happened in this cycle, for the log.
struct Event {
  std::string text;
};

struct Output {
  geometry::Twist2 twist;
  Phase phase{Phase::kWaiting};
  Reason reason{Reason::kNone};
  std::string detail;
  double distance_left_m{0.0};
  double time_left_s{0.0};
  geometry::Point2 blocked_at_in_map;  // in Phase::kBlocked
  double blocked_radius_m{0.0};
  std::vector<IntentPoint> intent;                      // from `now`; at most 64
  std::optional<geometry::Point2> sub_target_in_map{};  // aimed at instead of the path, to avoid a collision
  std::vector<Event> events;
};

/// The fixed order of the fleet: "agv-2" goes before "agv-10".
bool outranks(const std::string& a, const std::string& b);

}  // namespace aisle::local_planner
