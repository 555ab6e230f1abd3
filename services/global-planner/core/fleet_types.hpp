#pragma once
// What comes into the fleet planner and what goes out, in its own types. Everything in map, metres, radians.
#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::global_planner {

struct FleetSettings {
  double margin_m{0.10};       // kept free beside the vehicle's radius
  double tight_range_m{1.5};   // around a start or goal too near to something for the margin
  double replan_s{1.0};        // least time between two plans for one vehicle and goal, doubled while they do not help
  double longest_wait_s{8.0};  // between attempts that do not help
  double report_life_s{10.0};  // a reported block is forgotten this long after the last report
  double state_life_s{1.0};    // a vehicle silent for longer is not planned for, and is an obstacle to others
  double parked_after_s{2.0};  // a vehicle that has nothing to do and stands this long is an obstacle to others
  double look_ahead_m{15.0};   // obstacles farther along a plan do not change it yet
  double preferred_clearance_m{
      0.0};  // for the planner `clear`: nearer to obstacles a metre costs more; 0: twice radius and margin
  bool to_nearest{false};  // where the map leaves no way to a goal, plan to the nearest point that can be reached

  template <class Reader>
  void describe(Reader& r) {
    r.field("margin_m", margin_m, 0.0, 2.0)
        .field("tight_range_m", tight_range_m, 0.0, 10.0)
        .field("replan_s", replan_s, 0.5, 60.0)
        .field("longest_wait_s", longest_wait_s, 0.5, 600.0)
        .field("report_life_s", report_life_s, 0.0, 600.0)
        .field("state_life_s", state_life_s, 0.1, 60.0)
        .field("parked_after_s", parked_after_s, 0.0, 600.0)
        .field("look_ahead_m", look_ahead_m, 1.0, 1000.0)
        .field("preferred_clearance_m", preferred_clearance_m, 0.0, 10.0)
        .field("to_nearest", to_nearest);
  }
};

/// What a vehicle needs of the floor.
struct VehicleShape {
  double radius_m{0.35};  // of the disc around its base that keeps clear of walls
  double reach_m{0.35};   // of the circle around its base that holds all of it: where it stands, others go round that
  double turning_radius_m{0.0};         // of the tightest arc that plans have; 0: it turns on the spot
  std::vector<double> discs_ahead_m{};  // of one that does not: centres of the discs of radius_m that cover it
};

struct Goal {
  std::string id;
  geometry::Pose2 pose_in_map;
  double position_tolerance_m{0.1};
  double yaw_tolerance_rad{0.0};  // 0: any heading
  bool is_cancelled{false};
};
inline bool operator==(const Goal& a, const Goal& b) {
  return a.id == b.id && a.pose_in_map.x == b.pose_in_map.x && a.pose_in_map.y == b.pose_in_map.y &&
         a.pose_in_map.yaw == b.pose_in_map.yaw && a.position_tolerance_m == b.position_tolerance_m &&
         a.yaw_tolerance_rad == b.yaw_tolerance_rad && a.is_cancelled == b.is_cancelled;
}
inline bool operator!=(const Goal& a, const Goal& b) { return !(a == b); }

/// What a local planner says of its vehicle, as far as planning cares.
struct Navigation {
  enum class Activity {
    kUnderway,
    kBlocked,
    kArrived,
    kStopped
  };                                                           // kStopped: failed or held, it will not move by itself
  enum class Cause { kObstacle, kVehicle, kOffPath, kOther };  // of kBlocked
  std::string goal_id;
  std::uint64_t plan_id{0};
  Activity activity{Activity::kUnderway};
  Cause cause{Cause::kOther};
  geometry::Point2 blocked_at_in_map;
  double blocked_radius_m{0.0};  // 0: unknown
};

enum class FleetOutcome { kFound, kNoPath, kStartBlocked, kGoalBlocked, kOutOfMap, kOutOfTime, kCancelled };
enum class Trigger { kNewGoal, kMapChanged, kTrack, kVehicleBlocked, kTakeover };

/// What is published for one vehicle.
struct FleetPlan {
  std::string agv_id;
  std::uint64_t plan_id{0};  // counts from 1 within one life of the planner
  Goal goal;
  std::string map_id;
  std::uint64_t map_revision{0};  // newest revision that this plan was checked against
  FleetOutcome outcome{FleetOutcome::kFound};
  Trigger trigger{Trigger::kNewGoal};
  std::string detail;         // what is wrong and where; at most 256 characters
  bool is_to_nearest{false};  // the goal cannot be reached: the path ends at the nearest point that can
  std::vector<geometry::Point2> waypoints_in_map;  // empty unless found
  double length_m{0.0};
};

const char* name(FleetOutcome outcome);
const char* name(Trigger trigger);

}  // namespace aisle::global_planner
