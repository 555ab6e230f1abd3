#include "services/local-planner/core/printed/printed_planner.hpp"

#include <cmath>
#include <utility>

#include "services/local-planner/core/printed/path_following.hpp"
#include "services/local-planner/core/target.hpp"
#include "services/local-planner/core/turning.hpp"

namespace aisle::local_planner {
namespace {

constexpr double kFacesRad = from_degrees(1.0);  // YU eq. 12: the vehicle faces the first node

/// Movers as the papers see them: discs that keep their velocity, without margins, and without the reach of somebody
/// who may set off.
Surroundings as_the_papers_see(Surroundings around) {
  for (Mover& mover : around.movers) {
    mover.margin_m = mover.growth_mps = 0.0;
    mover.may_walk = mover.has_walked = false;
  }
  return around;
}

}  // namespace

DwaSettings printed_window(const DwaSettings& ours, const Variant& variant) {
  DwaSettings window = ours;
  window.horizon_s = window.heading_s = variant.paper.horizon_s;
  window.step_s = window.window_s = variant.printed.interval_s;
  window.linear_step_mps = variant.printed.linear_step_mps;
  window.angular_step_radps = variant.printed.angular_step_radps;
  window.wall_margin_m = window.peer_margin_m = 0.0;
  window.braking_share = 1.0;
  window.change_worth = 0.0;
  return window;
}

PrintedPlanner::PrintedPlanner(const Settings& settings, const Variant& variant)
    : dwa_(printed_window(settings.dwa, variant)),
      variant_(variant),
      guard_(settings),
      follower_(settings),
      observer_(settings.surroundings) {}

Output PrintedPlanner::step(const Inputs& inputs, time::Stamp now) {
  static const Vehicle kUnknown;
  const Vehicle& vehicle = inputs.vehicle ? *inputs.vehicle : kUnknown;
  const auto late_s = guard_.begin(inputs.map_revision, now);
  if (late_s) follower_.restart(inputs.state);
  const Moment moment{inputs, vehicle, vehicle.discs(), follower_.observe(vehicle, inputs.state, now), now};

  Output out = decide(moment);
  out.twist = follower_.follow(out.twist, vehicle.limits);
  if (inputs.state.seen()) out.intent.push_back({0.0, moment.motion.base_now});
  if (!way_.empty() && !has_arrived_) out.distance_left_m = way_.left_m();
  if (late_s) out.events.insert(out.events.begin(), {"late by " + std::to_string(*late_s) + " s"});
  return out;
}

Output PrintedPlanner::decide(const Moment& moment) {
  Output out;
  if (const auto stopped = guard_.judge(moment.inputs, has_arrived_, moment.now)) {
    out.phase = stopped->phase, out.reason = stopped->reason, out.detail = stopped->detail;
    next_choice_ = {};
    return out;
  }

  adopt_plan(moment);
  const Plan& plan = *moment.inputs.plan;
  has_arrived_ =
      has_arrived_ || geometry::distance(moment.here(), plan.goal_in_map.position()) <= plan.position_tolerance_m;
  if (has_arrived_) {
    out.phase = Phase::kArrived;
    return out;
  }

  way_.progress(moment.here());
  if (still_turns_to_first_node(moment)) {
    out.phase = Phase::kTurning;
    out.twist = turn_by(target_at(way_.current().points()[1], moment.motion).error_rad, moment.vehicle.limits);
    return out;
  }

  if (moment.now >= next_choice_) {
    const Surroundings around = as_the_papers_see(observer_.observe(moment.inputs, moment.here(), moment.now));
    last_ = {};
    wanted_ = choose_twist(moment, around, last_);
    next_choice_ = moment.now + time::from_seconds(dwa_.window_s);
  }
  out = last_;
  out.twist = wanted_;
  return out;
}

/// The plan's nodes are the path, unchanged; the same nodes again are the same path.
void PrintedPlanner::adopt_plan(const Moment& moment) {
  const Plan& plan = *moment.inputs.plan;
  const bool is_other_goal = plan.goal_id != goal_id_;
  if (!is_other_goal && plan.waypoints_in_map == waypoints_) return;
  if (is_other_goal) has_arrived_ = has_faced_first_node_ = false;
  goal_id_ = plan.goal_id;
  waypoints_ = plan.waypoints_in_map;
  way_.adopt(Lane(Route(waypoints_)), moment.here(), false);
  next_node_ = 1;
  next_choice_ = {};
}

/// YU eq. 12, with atan2: "pre-rotate to an appropriate angle".
bool PrintedPlanner::still_turns_to_first_node(const Moment& moment) {
  const Route& path = way_.current();
  const bool has_first_node = path.points().size() > 1;
  if (!variant_.printed.faces_first_node || !has_first_node || !moment.vehicle.turns_on_the_spot())
    has_faced_first_node_ = true;
  if (has_faced_first_node_) return false;
  const double error_rad = target_at(path.points()[1], moment.motion).error_rad;
  has_faced_first_node_ = std::abs(error_rad) < kFacesRad;
  return !has_faced_first_node_;
}

geometry::Twist2 PrintedPlanner::choose_twist(const Moment& moment, const Surroundings& around, Output& out) {
  const kinematics::Limits& limits = moment.vehicle.limits;
  const Scene scene{*moment.inputs.clearance,
                    moment.motion.base_then,
                    follower_.in_force(),
                    moment.discs.radius_m,
                    limits,
                    limits.max_speed_mps,
                    around.movers,
                    around.peer_motions,
                    follower_.steering_rad(),
                    moment.discs.ahead_m};
  const Room room = moment.room(around, 0.0, 0.0);
  const double s_m = way_.s_near_m(scene.base_in_map.position());
  const PrintedTarget target =
      variant_.printed.target_rule({way_.current(), s_m, next_node_, scene, room, variant_.printed});
  next_node_ = target.next_node;

  out.phase = Phase::kDriving;
  if (target.follows_path) return follow_path(scene.base_in_map, target.target_in_map, limits);

  if (variant_.has_rolling_window) {
    out.phase = Phase::kAvoiding;
    out.sub_target_in_map = target.target_in_map;
  }
  const Choice choice = choose(scene, aim_at(target, moment), variant_, dwa_);
  return choice.found ? choice.twist : follower_.braking(limits);
}

Aim PrintedPlanner::aim_at(const PrintedTarget& target, const Moment& moment) const {
  Aim aim;
  aim.target_in_map = target.target_in_map;
  aim.sub_target_in_map = target.sub_target_in_map;
  aim.wall_cap_m = variant_.printed.clearance_cap_m;
  aim.mover_cap_m = variant_.printed.mover_cap_m;
  aim.radius_m = moment.vehicle.reach_m();
  aim.step_s = dwa_.step_s;
  if (variant_.asks_for(path_distance_critic))
    aim.path_in_map = points_ahead(way_.current(), way_.s_near_m(moment.motion.base_then.position()),
                                   moment.vehicle.limits.max_speed_mps * dwa_.horizon_s);
  return aim;
}

}  // namespace aisle::local_planner
