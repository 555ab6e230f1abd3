#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/fleet/grant.hpp"
#include "common/fleet/navigation.hpp"
#include "common/fleet/plan.hpp"
#include "common/fleet/track.hpp"
#include "common/fleet/vehicle.hpp"
#include "common/fleet/vehicle_state.hpp"
#include "common/fleet/zone.hpp"
#include "common/geometry/footprint.hpp"
#include "common/grid/clearance.hpp"
#include "common/kinematics/vehicle_model.hpp"
#include "common/time/stamp.hpp"

namespace aisle::local_planner {

using fleet::Grant;
using fleet::HeldPose;
using fleet::IntentPoint;
using fleet::Motion;
using fleet::Phase;
using fleet::Plan;
using fleet::Reason;
using fleet::Track;
using fleet::Vehicle;

/// Another vehicle of the fleet: it must not be hit.
struct Peer {
  std::string id;
  double radius_m{0.35};
  kinematics::Limits limits;
  Motion state;

  time::Stamp state_arrived{};
  std::optional<geometry::Footprint> rectangle{};  // none: a disc
};

/// A track, and when it arrived here.
struct SeenTrack {
  Track track;
  time::Stamp arrived{};
};

/// Everything that one cycle looks at. Stamps are of the caller's clock, the one that `now` is taken from.
struct Inputs {
  const grid::ClearanceField* clearance{nullptr};  // of the newest complete map; null: none yet
  std::uint64_t map_revision{0};
  std::optional<Vehicle> vehicle;

  time::Latest<Motion> state;
  std::optional<Plan> plan;
  std::optional<Grant> grant;   // the newest for `plan`; none: there was none yet
  time::Stamp tracker_heard{};  // arrival of its newest status, whoever's scan it tells of; 0: never
  time::Stamp tracker_alive{};  // the newest that told of a new scan of this vehicle's own lidar; 0: never
  std::vector<SeenTrack> tracks;
  std::vector<Peer> peers;           // all that were heard; those near here are looked at
  bool authority_lost{false};        // the vehicle obeys a higher epoch than ours
  bool is_held_by_person{false};     // the vehicle does not move, whatever it is told
  std::vector<fleet::Zone> zones{};  // of the map; the floor of those that keep out is occupied in `clearance`
};

/// Something that happened in this cycle, for the log.
struct Event {
  std::string text;
};

/// What the leader of the traffic is told of a vehicle's way along the steps of its plan. Numbers of steps are
/// absolute.
struct RoadReport {
  double progress_m{0.0};         // along the plan
  std::uint64_t step_done{0};     // steps below it are behind the vehicle
  double limit_m{0.0};            // along the plan: it stops there
  std::uint64_t limit_step{0};    // steps below it may be driven
  std::uint64_t grant_number{0};  // of the grant that is obeyed; 0: none yet
  double stray_m{0.0};            // of the outline, off its path
  bool wants_room{false};         // something stands in the tube
  std::vector<HeldPose> held;     // from where it is to its limit, at most 32; steps do not fall
};

/// What one cycle comes to: the command, and the vehicle's status.
struct Output {
  geometry::Twist2 twist;
  Phase phase{Phase::kWaiting};
  Reason reason{Reason::kNone};
  std::string detail;
  double distance_left_m{0.0};
  double time_left_s{0.0};

  geometry::Point2 blocked_at_in_map;  // in Phase::kBlocked
  double blocked_radius_m{0.0};
  std::vector<IntentPoint> intent;                      // from `now`, for people; at most 8
  std::optional<geometry::Point2> sub_target_in_map{};  // aimed at instead of the path, to avoid a collision
  std::vector<Event> events;
  RoadReport road{};
};

}  // namespace aisle::local_planner
