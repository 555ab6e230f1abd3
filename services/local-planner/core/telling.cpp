#include "services/local-planner/core/telling.hpp"

#include "services/local-planner/core/rolling_window.hpp"

namespace aisle::local_planner {
namespace {

constexpr double kAvoidsWithinM = 0.4;  // it avoids what is nearer than this to its trajectory
constexpr double kAvoidsInTubeM = 0.1;  // in a tube there is no more room to make
constexpr double kJustStoppedS = 0.5;   // standing for less says nothing yet

}  // namespace

Output told_driving(const Driving& driving) {
  Output out;
  out.twist = driving.speed.wanted;

  const double near_m = driving.scene.tube != nullptr ? kAvoidsInTubeM : kAvoidsWithinM;
  const bool is_near = driving.speed.choice.mover_gap_m < near_m;
  out.phase = driving.leaves_lane || is_near ? Phase::kAvoiding : Phase::kDriving;

  const Grade grade = driving.backs_off ? Grade::kBackOff : driving.speed.grade;
  if (grade != Grade::kNone)
    out.detail = told(grade);
  else if (out.phase == Phase::kAvoiding)
    out.detail = told_avoidance(driving.scene);

  return out;
}

Output told_turning(const geometry::Twist2& wanted) {
  Output out;
  out.phase = Phase::kTurning;
  out.twist = wanted;

  return out;
}

Output told_off_path(geometry::Point2 here_in_map) {
  Output out;
  out.phase = Phase::kBlocked;
  out.reason = Reason::kOffPath;
  out.detail = "cannot get back to the plan without turning on the spot";
  out.blocked_at_in_map = here_in_map;

  return out;
}

void tell_stray(geometry::Point2 here_in_map, Output& out) {
  out.phase = Phase::kBlocked;
  out.reason = Reason::kOffPath;
  out.detail = "comes back to its path";
  out.blocked_at_in_map = here_in_map;
}

std::string told_waiting(const std::optional<Grant>& grant) {
  if (!grant) return "nothing is granted yet";

  std::string text;
  for (const std::string& agv_id : grant->waits_for) text += (text.empty() ? "" : ", ") + agv_id;
  if (grant->reason.empty()) return text.empty() ? "the granted road ends here" : "for " + text;
  return text.empty() ? grant->reason : "for " + text + ": " + grant->reason;
}

// What is granted, while nothing stands in the way; then what stands there, once it has for long; then what the
// dynamic window refused.
void tell_why_it_stands(const Stop& stop, Output& out) {
  if (stop.is_at_limit && !stop.blocked) {
    out.phase = Phase::kWaiting;
    out.reason = Reason::kNoGrant;
    out.detail = told_waiting(stop.grant);
  } else if (stop.stuck_s > stop.blocked_after_s && stop.blocked) {
    const std::string& by = stop.blocked->vehicle_id;
    out.phase = Phase::kBlocked;
    out.reason = by.empty() ? Reason::kObstacle : Reason::kVehicle;
    out.detail = by.empty() ? "no way around" : "no way around " + by;
    out.blocked_at_in_map = stop.blocked->thing ? stop.blocked->thing->position : stop.blocked->where.at_in_map;
    out.blocked_radius_m = stop.blocked->thing ? stop.blocked->thing->radius_m : stop.radius_m;
  } else if (stop.stuck_s > kJustStoppedS) {
    const bool mover = stop.choice.rejected_by(Obstruction::kMover) > 0;
    const bool peer = stop.choice.rejected_by(Obstruction::kPeer) > 0;
    out.reason = peer ? Reason::kVehicle : mover ? Reason::kObstacle : Reason::kNone;
  }
}

std::string told_avoidance(const Scene& scene) {
  const Meeting meeting = predict_meeting(scene, kWindowM, kMeetingS);

  return meeting.encounter == Encounter::kNone ? "" : std::string("avoids what is ") + name(meeting.encounter);
}

}  // namespace aisle::local_planner
