#include "services/local-planner/core/local_planner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "services/local-planner/core/intent.hpp"
#include "services/local-planner/core/speed_choice.hpp"
#include "services/local-planner/core/speed_policy.hpp"
#include "services/local-planner/core/telling.hpp"

namespace aisle::local_planner {
namespace {

constexpr double kWaitsBeforeM = 0.2;  // so near before an obstacle that closes its way the vehicle stays
constexpr double kAtLimitM = 0.1;      // so near before its limit it is there
constexpr double kStandsAtLimitMps = 0.005;
constexpr double kBlockedInTubeS = 2.0;  // what stands in a tube for so long closes it
constexpr double kComesBackMps = 0.2;    // into its tube
constexpr double kWalkersWithinM = 8.0;  // farther away nobody is met within the dynamic window's horizon

/// Does the vehicle stand before what obstructs its way, and wait there for it to go?
bool stays_before(const Blocked* by, const OnWay& on_way) {
  return by != nullptr && on_way.moment.motion.stands() && on_way.way.s_m() > by->where.begin_m - kWaitsBeforeM;
}

/// Is a vehicle of this status under way?
bool is_under_way(const Output& out) {
  const bool waits_on_it = out.phase == Phase::kWaiting && out.reason == Reason::kNoGrant;
  return waits_on_it || out.phase == Phase::kTurning || out.phase == Phase::kDriving || out.phase == Phase::kAvoiding ||
         out.phase == Phase::kBlocked;
}

/// Where the vehicle is and will be, up to `end_m` of its way; and how much is left of its lane, in metres and seconds.
void tell_intent(const Moment& moment, const Way& way, double end_m, bool drives, Output& out) {
  if (!moment.inputs.state.seen()) return;
  out.intent.push_back({0.0, moment.motion.base_now});
  if (!drives) return;

  const Intent intent = intent_of(way, end_m);

  out.intent.insert(out.intent.end(), intent.points.begin(), intent.points.end());
  out.distance_left_m = way.lane().length_m() - way.lane_s_m();
  out.time_left_s = intent.time_left_s;
}

}  // namespace

/// What a cycle has decided, before the vehicle's limits.
struct LocalPlanner::Decision {
  Output out;  // its twist is wanted, and may be more than the vehicle can do
  double stop_at_m{std::numeric_limits<double>::infinity()};  // of the current way
};

LocalPlanner::LocalPlanner(const Settings& settings, Variant variant)
    : settings_(settings),
      dwa_in_tube_(settings.dwa),
      variant_(std::move(variant)),
      guard_(settings),
      follower_(settings),
      way_keeper_(settings, variant_.knows_path),
      observer_(settings.surroundings),
      road_(settings.lane, settings.comfort_mps2),
      avoidance_(settings, variant_.knows_path) {
  dwa_in_tube_.horizon_s = std::min(dwa_in_tube_.horizon_s, dwa_in_tube_.heading_s);
}

Output LocalPlanner::step(const Inputs& inputs, time::Stamp now) {
  // A cycle: what is the vehicle doing, what should it do, what can it do of that.
  static const Vehicle kUnknown;
  const Vehicle& vehicle = inputs.vehicle ? *inputs.vehicle : kUnknown;

  const auto late_s = guard_.begin(inputs.map_revision, now);
  if (late_s) follower_.restart(inputs.state);

  const Moment moment{inputs, vehicle, vehicle.discs(), follower_.observe(vehicle, inputs.state, now), now};

  if (inputs.vehicle && inputs.state.seen()) road_.follow(moment, follower_.in_force().linear_mps);

  Decision decision = decide(moment);
  Output& out = decision.out;
  out.twist = follower_.follow(out.twist, vehicle.limits);

  const bool drives = is_under_way(out) && !way_.empty() && !arrival_.has_arrived();
  tell_intent(moment, way_, decision.stop_at_m, drives, out);
  tell_road(moment, out);
  if (late_s) out.events.insert(out.events.begin(), {"late by " + std::to_string(*late_s) + " s"});

  return out;
}

LocalPlanner::Decision LocalPlanner::decide(const Moment& moment) {
  const auto stopped = guard_.judge(moment.inputs, arrival_.has_arrived(), moment.now);
  if (stopped) return hold(*stopped, moment.now);

  adopt_plan(moment);
  const auto at_goal = arrival_.look(moment, follower_.in_force());
  if (at_goal) return stay(*at_goal, moment.now);

  const Surroundings around = observer_.observe(moment.inputs, moment.here(), moment.now);

  // On the way no farther than to the next turn that must be driven to first.
  const bool is_in_tube = road_.tube_m() > 0.0;
  const double gate_m = is_in_tube && std::isfinite(road_.gate_m()) ? way_.lane_m(road_.gate_m())
                                                                    : std::numeric_limits<double>::infinity();
  if (is_in_tube)
    way_.progress_at(moment.here(), way_.lane_m(road_.progress_m()), gate_m, way_.lane_m(road_.least_m()));
  else
    way_.progress(moment.here());

  const Ruling ruling = avoidance_.rule(moment, around, {std::min(stop_at_m(), gate_m), is_in_tube}, way_, stuck_);
  if (!is_in_tube) return drive({moment, way_, around, follower_.in_force()}, ruling);

  const Tube tube = tube_along(way_.lane(), way_.lane_s_m(), stop_at_m(), road_.tube_m());
  return drive({moment, way_, around, follower_.in_force(), &tube, gate_m}, ruling);
}

/// Where it stands, once all steps are done: where the way turns back at the limit, the leg behind lies ahead of it.
double LocalPlanner::stop_at_m() const {
  const double along_plan_m = road_.stop_at_m();
  if (!std::isfinite(along_plan_m)) return along_plan_m;

  const double limit_m = way_.lane_m(along_plan_m);
  const bool stands_at_limit =
      road_.tube_m() > 0.0 && road_.is_driven() && std::abs(follower_.in_force().linear_mps) < kStandsAtLimitMps;
  return stands_at_limit ? std::min(limit_m, way_.lane_s_m()) : limit_m;
}

/// The vehicle may not drive: it brakes, and says why.
LocalPlanner::Decision LocalPlanner::hold(const Stopped& stopped, time::Stamp now) {
  stuck_.rest(now);
  turn_.end();

  Decision decision;
  decision.out.phase = stopped.phase;
  decision.out.reason = stopped.reason;
  decision.out.detail = stopped.detail;

  return decision;
}

void LocalPlanner::adopt_plan(const Moment& moment) {
  const Adoption adoption = way_keeper_.adopt(moment, road_, way_);
  if (adoption.is_other_goal) arrival_.begin(moment.now);
  if (!adoption.has_new_lane) return;

  avoidance_.begin();
  stuck_.begin(moment.now);
}

/// At the goal: nothing is left to drive.
LocalPlanner::Decision LocalPlanner::stay(const AtGoal& at_goal, time::Stamp now) {
  way_.come_back();
  if (at_goal.phase != Phase::kTurning) stuck_.rest(now);

  Decision decision;
  decision.out.phase = at_goal.phase;
  decision.out.twist = at_goal.wanted;

  return decision;
}

/// Under way: to the target in sight, or beside it where driving on would end in a collision.
LocalPlanner::Decision LocalPlanner::drive(const OnWay& on_way, const Ruling& ruling) {
  const OwnMotion& motion = on_way.moment.motion;

  // The target in sight, or the one beside it.
  Target target = target_at(target_in_sight(on_way, variant_.knows_path), motion);
  std::optional<geometry::Point2> sub_target;

  if (variant_.has_rolling_window)
    sub_target = sub_target_beside(on_way, scene_towards(target, on_way, ruling), target.in_map);
  if (sub_target) target = target_at(*sub_target, motion);

  Decision decision{drive_to(target, on_way, ruling), ruling.stop_at_m};
  decision.out.sub_target_in_map = sub_target;
  decision.out.events = ruling.events;

  return decision;
}

/// Turns on the spot where the target is far off the heading, else drives by the dynamic window.
Output LocalPlanner::drive_to(const Target& target, const OnWay& on_way, const Ruling& ruling) {
  const Moment& moment = on_way.moment;
  const kinematics::Limits& limits = moment.vehicle.limits;

  // Turn, or give up a path that cannot be reached.
  const Scene scene = scene_towards(target, on_way, ruling);
  const bool stays_here = stays_before(avoidance_.blocking(way_), on_way);
  const bool turns = turn_.look({scene, moment.vehicle, target, way_.left_m(), stays_here}, settings_.dwa);
  if (variant_.knows_path && is_off_path(moment, way_)) return told_off_path(moment.here());

  if (turns) {
    stuck_.move(moment.now);
    return told_turning(TurnOnTheSpot::twist(target.error_rad, on_way.in_force, limits));
  }

  // The dynamic window.
  const Aim aim = aim_at(target.in_map, on_way, variant_, settings_.dwa);
  const SpeedSearch search{moment, scene, aim, target.error_rad, stays_here, follower_.braking(limits)};
  const SpeedChoice speed = choose_speed(search, variant_, looks_short(on_way) ? dwa_in_tube_ : settings_.dwa);

  stuck_.notice_people(speed.is_refused_by_people, moment.now);
  if (!moment.motion.stands()) stuck_.move(moment.now);

  // What it tells.
  Output out = told_driving({scene, speed, way_.backs_off(), way_.is_on_detour() || way_.backs_off()});
  const bool is_at_limit = way_.lane_s_m() > stop_at_m() - kAtLimitM;
  if (is_at_limit && !avoidance_.blocked()) stuck_.rest(moment.now);
  if (moment.motion.stands())
    tell_why_it_stands({is_at_limit, moment.inputs.grant, avoidance_.blocked(), speed.choice,
                        stuck_.stood_s(moment.now), blocked_after_s(), moment.vehicle.reach_m()},
                       out);
  if (strays(on_way)) tell_stray(moment.here(), out);

  return out;
}

/// In a tube what stands there is told sooner: others wait for what is granted beyond it.
double LocalPlanner::blocked_after_s() const {
  return road_.tube_m() > 0.0 ? std::min(kBlockedInTubeS, settings_.blocked_after_s) : settings_.blocked_after_s;
}

bool LocalPlanner::looks_short(const OnWay& on_way) const {
  const auto walks_near = [&](const Mover& mover) {
    return mover.velocity_in_map != geometry::Point2{} && on_way.moment.gap_then_m(mover) < kWalkersWithinM;
  };
  const auto& movers = on_way.around.movers;
  return on_way.tube != nullptr && std::none_of(movers.begin(), movers.end(), walks_near);
}

bool LocalPlanner::strays(const OnWay& on_way) const {
  return on_way.tube != nullptr && stray_m(on_way.moment) > on_way.tube->half_width_m;
}

double LocalPlanner::stray_m(const Moment& moment) const {
  if (!road_.has_steps()) return 0.0;

  const bool has_lane = road_.tube_m() > 0.0 && !way_.empty();
  const Route& path = has_lane ? way_.lane() : road_.way();
  const double s_m = has_lane ? way_.lane_s_m() : road_.progress_m();
  const Tube tube = tube_along(path, s_m, path.length_m(), road_.tube_m());
  return off_path_m(tube.path_in_map, moment.motion.base_now, moment.discs.ahead_m, moment.vehicle.turns_on_the_spot());
}

void LocalPlanner::tell_road(const Moment& moment, Output& out) const {
  if (!moment.inputs.state.seen()) return;
  out.road = road_.report(moment);
  out.road.stray_m = stray_m(moment);
  out.road.wants_room = road_.tube_m() > 0.0 && avoidance_.blocked().has_value();
}

Scene LocalPlanner::scene_towards(const Target& target, const OnWay& on_way, const Ruling& ruling) const {
  const Moment& moment = on_way.moment;
  double cap_mps =
      speed_cap_mps({moment, way_, on_way.around, target.in_map, ruling.stop_at_m, on_way.tube != nullptr}, settings_);
  if (strays(on_way)) cap_mps = std::min(cap_mps, kComesBackMps);

  return {*moment.inputs.clearance,
          moment.motion.base_then,
          on_way.in_force,
          moment.discs.radius_m,
          moment.vehicle.limits,
          cap_mps,
          on_way.around.movers,
          on_way.around.peer_motions,
          follower_.steering_rad(),
          moment.discs.ahead_m,
          on_way.tube};
}

}  // namespace aisle::local_planner
