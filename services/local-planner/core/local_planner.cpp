#include "services/local-planner/core/local_planner.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/kinematics/tricycle.hpp"
#include "services/local-planner/core/right_of_way/claim.hpp"
#include "services/local-planner/core/right_of_way/local_search.hpp"
#include "services/local-planner/core/rolling_window.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;
using geometry::Pose2;
using geometry::Twist2;
using time::seconds;
using time::Stamp;

constexpr double kSearchPeriodS = 0.2;
constexpr double kLookForObstaclesM = 4.0;
constexpr double kTurnBeginRad = 0.9;
constexpr double kTurnEndRad = 0.2;
constexpr double kLostM = 0.6;
constexpr double kLostRad = 1.2;
constexpr double kWalksByM = 1.0;                  // between the outlines: so near are people whom it lets pass,
constexpr double kLetPassS = 10.0;                 // for so long; who is still there then does not walk by
constexpr double kCreepMps = kStandingMps - 1e-6;  // does not count as moving, and still gets on
constexpr double kBesidePersonM =
    0.25;  // so near to somebody who stood for long it creeps: they set off before it could stop
constexpr double kNearEnoughS = 3.0;  // within the goal's tolerance, while somebody is in the way of its middle
constexpr double kSubTargetM = 0.6;   // LI's look-ahead on the path

double bounded_by_braking(double distance_m, double braking_mps2) {
  return std::sqrt(2.0 * braking_mps2 * std::max(0.0, distance_m));
}

}  // namespace

/// Moments: `base_now` at now; the scene is dead_time later, when the next command acts.
struct LocalPlanner::Cycle {
  const Inputs& inputs;
  const Vehicle& vehicle;
  Stamp now;
  Output out;
  Pose2 base_now;
  Pose2 base_then;
  double measured_mps{0.0};
  Surroundings around;
  std::vector<Disc> standing;
  Advice advice;
  double stop_at_m{1e18};
  Point2 target;
  bool cautious{false};
  geometry::CoveringDiscs discs;

  Point2 here() const { return base_now.position(); }
  Room room(double wall_margin_m, double disc_margin_m) const {
    return {*inputs.clearance, standing, way_radius_m(), wall_margin_m, disc_margin_m};
  }
  /// What keeps the way from walls: all of the vehicle where it may turn anywhere; of a tricycle, whose plan knows
  /// headings, its width.
  double way_radius_m() const { return vehicle.turns_on_the_spot() ? vehicle.reach_m() : discs.radius_m; }
  /// Between the outlines, when the next command acts.
  double gap_then_m(const Mover& mover) const {
    double least = 1e18;
    for (const double ahead_m : discs.ahead_m)
      least = std::min(least, geometry::distance(geometry::to_map(base_then, {ahead_m, 0.0}), mover.position_in_map));
    return least - discs.radius_m - mover.radius_m;
  }
  bool stands() const { return std::abs(measured_mps) < kCreepMps - 1e-6; }
};

LocalPlanner::LocalPlanner(const Settings& settings, Variant variant)
    : settings_(settings), variant_(std::move(variant)), observer_(settings.surroundings) {}

Output LocalPlanner::step(const Inputs& inputs, Stamp now) {
  static const Vehicle kUnknown;
  const Motion* state = inputs.state.any();
  Cycle cycle{inputs, inputs.vehicle ? *inputs.vehicle : kUnknown, now, {}, {}, {}, 0.0, {}, {}, {}, 1e18, {}, false,
              {}};
  cycle.discs = cycle.vehicle.discs();
  if (inputs.map_revision != seen_revision_) seen_revision_ = inputs.map_revision, revision_changed_ = now;
  if (last_step_ != Stamp{} &&
      seconds(now - last_step_) > settings_.late_s) {  // the vehicle has braked by itself meanwhile
    late_ = now;
    last_command_ = state != nullptr ? state->twist : Twist2{};
    cycle.out.events.push_back({"late by " + std::to_string(seconds(now - last_step_)) + " s"});
  }
  if (state != nullptr) {
    const double age = std::clamp(seconds(now - inputs.state.arrived()), 0.0, settings_.stale_state_s);
    cycle.base_now = kinematics::advance(state->base_in_map, state->twist, age);
    cycle.base_then = kinematics::advance(cycle.base_now, last_command_, settings_.surroundings.dead_time_s);
    cycle.measured_mps = state->twist.linear_mps;
    // The command before is where the wheels are going, unless the vehicle does something else; an old state says
    // nothing of that.
    const double slack = 0.1 + 0.35 * cycle.vehicle.limits.max_acceleration_mps2;
    if (inputs.state.fresh(now, time::from_seconds(settings_.stale_state_s)))
      last_command_.linear_mps =
          std::clamp(last_command_.linear_mps, cycle.measured_mps - slack - 0.1, cycle.measured_mps + slack);
    // A wheel that stands is where it stands, whoever turned it; one that was told to move is where it was told to go.
    if (cycle.stands() && last_command_.linear_mps == 0.0) steering_rad_ = state->steering_rad;
    if (!cycle.vehicle.turns_on_the_spot())
      last_command_.angular_radps =
          kinematics::turn_rate_radps(cycle.vehicle.limits.axle, last_command_.linear_mps, steering_rad_);
  }
  if (const auto held = guard(inputs, now)) {
    hold(cycle, held->first, held->second);
  } else {
    cycle.cautious = inputs.plan->map_revision != inputs.map_revision;
    adopt_plan(inputs, cycle);
    if (!finish(cycle)) {
      cycle.around =
          observer_.observe(inputs, cycle.vehicle.id, settings_.dwa.step_s,
                            static_cast<int>(std::lround(settings_.dwa.horizon_s / settings_.dwa.step_s)), now);
      for (const Standing& standing : cycle.around.standing) cycle.standing.push_back(standing.disc);
      way_.progress(cycle.here());
      find_detour(cycle);
      advise_traffic(cycle);
      step_aside(cycle);
      recover(cycle);
      drive(cycle);
    }
  }
  describe(cycle);
  last_step_ = now;
  return cycle.out;
}

std::optional<std::pair<Phase, Reason>> LocalPlanner::guard(const Inputs& inputs, Stamp now) {
  using Held = std::pair<Phase, Reason>;
  if (!inputs.vehicle || !inputs.state.seen()) return Held{Phase::kWaiting, Reason::kNoState};
  if (inputs.authority_lost) return Held{Phase::kHeld, Reason::kAuthority};
  if (!inputs.state.fresh(now, time::from_seconds(settings_.stale_state_s)))
    return Held{Phase::kHeld, Reason::kStaleState};
  if (late_ != Stamp{} && seconds(now - late_) < settings_.late_hold_s) return Held{Phase::kHeld, Reason::kLate};
  if (inputs.clearance == nullptr) return Held{Phase::kWaiting, Reason::kNoMap};
  if (!inputs.plan) return Held{Phase::kWaiting, Reason::kNoGoal};
  if (inputs.plan->is_cancelled()) return Held{Phase::kHeld, Reason::kCancelled};
  if (inputs.tracker_alive == Stamp{}) return Held{Phase::kWaiting, Reason::kNoTracker};
  if (seconds(now - inputs.tracker_alive) > settings_.stale_tracker_s) return Held{Phase::kHeld, Reason::kStaleTracker};
  return guard_plan(inputs, now);
}

std::optional<std::pair<Phase, Reason>> LocalPlanner::guard_plan(const Inputs& inputs, Stamp now) {
  using Held = std::pair<Phase, Reason>;
  const Plan& plan = *inputs.plan;
  if (!plan.is_found() || plan.waypoints_in_map.empty()) return Held{Phase::kFailed, Reason::kUnreachable};
  if (plan.map_revision < inputs.map_revision && seconds(now - revision_changed_) > settings_.plan_update_s &&
      !arrived_)
    return Held{Phase::kHeld, Reason::kPlanOutdated};
  return std::nullopt;
}

void LocalPlanner::hold(Cycle& cycle, Phase phase, Reason reason) {
  cycle.out.phase = phase;
  cycle.out.reason = reason;
  if (reason == Reason::kUnreachable) cycle.out.detail = cycle.inputs.plan->detail;
  const bool about_tracker = reason == Reason::kNoTracker || reason == Reason::kStaleTracker;
  const bool tracker_lives = cycle.inputs.tracker_heard != Stamp{} &&
                             seconds(cycle.now - cycle.inputs.tracker_heard) <= settings_.stale_tracker_s;
  if (about_tracker && tracker_lives)
    cycle.out.detail = "the tracker works, but has no fresh scan of " + cycle.vehicle.id;
  moved_ = cycle.now;
  patience_.rest(cycle.now);
  turning_ = false;
  command(cycle, {});
}

void LocalPlanner::adopt_plan(const Inputs& inputs, Cycle& cycle) {
  const Plan& plan = *inputs.plan;
  const bool other_goal = plan.goal_id != goal_id_ ||
                          geometry::distance(plan.goal_in_map.position(), goal_in_map_.position()) > 1e-6 ||
                          plan.goal_in_map.yaw != goal_in_map_.yaw;
  if (other_goal) {
    arrived_ = false;
    near_since_ = cycle.now;
    way_.drop_aside();
  }
  // By what it says: ids begin again with each planner, and whoever takes over keeps the plans that it finds.
  const bool same_plan = !other_goal && plan.waypoints_in_map == plan_waypoints_ && !way_.empty();
  if (same_plan && plan.id == plan_id_ && lane_revision_ == inputs.map_revision) return;
  goal_id_ = plan.goal_id;
  goal_in_map_ = plan.goal_in_map;
  plan_id_ = plan.id;
  plan_waypoints_ = plan.waypoints_in_map;
  lane_revision_ = inputs.map_revision;
  const bool as_planned = !cycle.vehicle.turns_on_the_spot();  // its arcs are the tightest that it should drive
  Route lane = !variant_.knows_path ? Route(resample({cycle.here(), plan.waypoints_in_map.back()}, 0.2))
               : as_planned
                   ? Route(resample(plan.waypoints_in_map, 0.2))
                   : make_lane(plan.waypoints_in_map, *inputs.clearance, cycle.vehicle.reach_m(), settings_.lane);
  way_.adopt(std::move(lane), cycle.here(), same_plan);
  blocked_.reset();
  searched_ = {};
  moved_ = cycle.now;
  patience_.begin(cycle.now);
}

/// At the goal: turns to the goal's heading if that matters, and stays. Returns true when nothing is left to drive.
bool LocalPlanner::finish(Cycle& cycle) {
  const Plan& plan = *cycle.inputs.plan;
  const double distance = geometry::distance(cycle.here(), plan.goal_in_map.position());
  if (arrived_ && distance > 2.0 * plan.position_tolerance_m) arrived_ = false;  // pushed away
  if (!arrived_) {
    const bool near = distance <= plan.position_tolerance_m;
    if (!near) near_since_ = cycle.now;
    const bool long_enough = seconds(cycle.now - near_since_) > kNearEnoughS;
    const double ahead = geometry::from_map(cycle.base_now, plan.goal_in_map.position()).x;
    const bool no_nearer =
        std::abs(ahead) < 0.02 || distance < 0.3 * plan.position_tolerance_m || ahead < 0.0 || long_enough;
    if (!near || !no_nearer) return false;
  }
  way_.drop_aside();
  const double error = geometry::wrap(plan.goal_in_map.yaw - cycle.base_then.yaw);
  cycle.out.distance_left_m = 0.0;
  if (!arrived_ && cycle.vehicle.turns_on_the_spot() && plan.yaw_tolerance_rad > 0.0 &&
      std::abs(error) > 0.5 * plan.yaw_tolerance_rad) {
    cycle.out.phase = Phase::kTurning;
    if (cycle.stands())
      command(cycle, turn_of(cycle, error));
    else
      command(cycle, {});
    return true;
  }
  if (cycle.stands() && std::abs(last_command_.linear_mps) < 1e-3) arrived_ = true;
  cycle.out.phase = arrived_ ? Phase::kArrived : Phase::kDriving;
  moved_ = cycle.now;
  patience_.rest(cycle.now);
  command(cycle, {});
  return true;
}

/// Splices a way around what stands on the lane, or back to the lane when the vehicle is off it.
void LocalPlanner::find_detour(Cycle& cycle) {
  if (!variant_.knows_path || way_.is_aside() || seconds(cycle.now - searched_) < kSearchPeriodS) return;
  searched_ = cycle.now;
  const double s = way_.s_m();
  const Route& lane = way_.lane();
  const Room usual = cycle.room(settings_.lane.margin_m, 0.15);
  auto obstructed = first_obstructed(lane, s + 0.2, kLookForObstaclesM, cycle.room(0.0, 0.08), 0.0);
  const bool off_lane = geometry::distance(cycle.here(), lane.at(s)) > 0.9;
  if (!obstructed && !off_lane) {
    blocked_.reset();
    return;
  }
  const double rejoin = obstructed ? obstructed->end_m : std::min(lane.length_m(), s + 1.0);
  if (rejoin <= lane.length_m() && cycle.vehicle.turns_on_the_spot()) {
    const Point2 join = lane.at(std::min(lane.length_m(), rejoin + 0.3));
    const auto accepts = [&](Point2 p) { return geometry::distance(p, join) < 0.21; };
    auto points = search_way(usual, cycle.here(), join, 7.0, accepts);
    if (points.empty()) points = search_way(cycle.room(0.05, 0.10), cycle.here(), join, 7.0, accepts);
    if (!points.empty()) {
      cycle.out.events.push_back({obstructed ? "detour around an obstacle" : "back to the lane"});
      const double left_before_m = lane.length_m() - s;
      way_.detour(points, std::min(lane.length_m(), rejoin + 0.3));
      patience_.lengthen(lane.length_m() - way_.lane_s_m() - left_before_m);
      blocked_.reset();
      return;
    }
  }
  if (!obstructed) return;
  blocked_ = Blocked{*obstructed, {}};
  double nearest = 1e18;
  for (const Standing& standing : cycle.around.standing) {
    const double d = geometry::distance(standing.disc.position, obstructed->at_in_map) - standing.disc.radius_m;
    if (d < nearest) nearest = d, blocked_->vehicle_id = standing.vehicle_id;
  }
}

void LocalPlanner::advise_traffic(Cycle& cycle) {
  const kinematics::Limits& limits = cycle.vehicle.limits;
  way_.profile(*cycle.inputs.clearance, cycle.way_radius_m(),
               {limits.max_speed_mps, limits.max_turn_radps,
                std::min(settings_.comfort_mps2, limits.max_deceleration_mps2), 0.6, settings_.slows_on_the_way});
  const double speed = std::max(0.0, last_command_.linear_mps);
  const double stopping = kinematics::stopping_distance_m(speed, limits.max_deceleration_mps2) + speed * 0.15;
  cycle.advice = advise({cycle.vehicle.id, cycle.vehicle.reach_m(), way_.s_m(), speed, stopping, cycle.here(),
                         way_.current(), way_.profile_mps()},
                        cycle.around.peers, settings_.traffic);
  cycle.stop_at_m = cycle.advice.stop_at_m;
  if (blocked_ && !way_.is_aside()) cycle.stop_at_m = std::min(cycle.stop_at_m, blocked_->where.begin_m - 0.1);
}

/// Makes room for peers that go first and whose way runs through here.
void LocalPlanner::step_aside(Cycle& cycle) {
  if (way_.is_aside()) {
    const bool there = way_.left_m() < 0.12 && cycle.stands();
    if (there || seconds(cycle.now - stepped_aside_) > 20.0) {
      way_.come_back();
      searched_ = {};
      way_.progress(cycle.here());
      find_detour(cycle);
      advise_traffic(cycle);
    }
    return;
  }
  const double stuck_s = seconds(cycle.now - moved_);
  std::vector<std::string> for_whom;
  for (const std::string& id : cycle.advice.gives_way_to)
    for (const PeerView& peer : cycle.around.peers)
      if (peer.id == id && geometry::distance(peer.base_in_map.position(), cycle.here()) < 6.0) for_whom.push_back(id);
  if (for_whom.empty()) return;
  cycle.stop_at_m = std::min(cycle.stop_at_m, way_.s_m() + (stuck_s > 0.5 ? 0.0 : 1e9));
  if (stuck_s > 1.0 && seconds(cycle.now - stepped_aside_) > 2.0 && find_spot(cycle, for_whom))
    cycle.out.events.push_back({"steps aside for " + for_whom.front()});
}

/// The nearest place, by the way there, that no claim of `for_whom` comes near to. With nobody: any place a metre away.
bool LocalPlanner::find_spot(Cycle& cycle, const std::vector<std::string>& for_whom) {
  stepped_aside_ = cycle.now;
  if (!cycle.vehicle.turns_on_the_spot()) return false;
  std::vector<Disc> discs = cycle.standing;
  for (const PeerView& peer : cycle.around.peers) discs.push_back({peer.base_in_map.position(), peer.radius_m});
  const Room room{*cycle.inputs.clearance, discs, cycle.vehicle.reach_m(), 0.06, 0.10};
  const Point2 here = cycle.here();
  const auto accepts = [&](Point2 p) {
    if (for_whom.empty() && geometry::distance(p, here) < 0.7) return false;
    for (const PeerView& peer : cycle.around.peers) {
      const bool asked = std::find(for_whom.begin(), for_whom.end(), peer.id) != for_whom.end();
      if (!asked && !outranks(peer.id, cycle.vehicle.id)) continue;
      if (!peer.has_goal && !asked) continue;
      const double least = cycle.vehicle.reach_m() + peer.radius_m + settings_.traffic.margin_m + 0.05;
      if (is_claimed(peer.claim, p, least)) return false;
    }
    return true;
  };
  const auto points = search_way(room, here, way_.lane().at(way_.lane_s_m() + 1.0), 8.0, accepts);
  if (points.size() < 2) return false;
  way_.step_aside(points);
  backs_off_ = false;
  advise_traffic(cycle);
  return true;
}

/// Backs off, once trying has gone on for long enough.
void LocalPlanner::recover(Cycle& cycle) {
  const bool waits = (!cycle.advice.yields_to.empty() && !cycle.advice.follows) || lets_pass_;
  const bool is_closed = blocked_ && blocked_->vehicle_id.empty();
  const double left_m = way_.lane().length_m() - way_.lane_s_m();
  if (patience_.look({left_m, waits, way_.is_aside(), is_closed, cycle.vehicle.limits}, cycle.now) != Grade::kBackOff)
    return;
  std::vector<std::string> stuck_with;
  for (const PeerView& peer : cycle.around.peers)
    if (peer.has_goal && geometry::distance(peer.base_in_map.position(), cycle.here()) < 2.5)
      stuck_with.push_back(peer.id);
  if (!find_spot(cycle, stuck_with) && !stuck_with.empty()) find_spot(cycle, {});
  backs_off_ = way_.is_aside();
  if (way_.is_aside()) cycle.out.events.push_back({"backs off to try again"});
}

Point2 LocalPlanner::visible_target(const Cycle& cycle) const {
  const Route& route = way_.current();
  if (!variant_.knows_path && !way_.is_aside()) return route.points().back();
  const double s = way_.s_m();
  const double wanted = std::clamp(0.6 + 0.9 * last_command_.linear_mps, 0.7, 1.8);
  const Room room = cycle.room(0.02, 0.02);
  double ahead = std::min(wanted, route.length_m() - s);
  while (ahead > 0.35 && !room.is_line_free(cycle.here(), route.at(s + ahead))) ahead -= 0.2;
  return route.at(s + std::max(ahead, 0.2));
}

double LocalPlanner::speed_cap(const Cycle& cycle) const {
  const Route& route = way_.current();
  const double s =
      way_.is_aside() ? way_.s_m() : route.project(cycle.base_then.position(), way_.s_m(), way_.s_m() + 0.5);
  double cap = std::max(0.1, way_.speed_at(s));
  if (cycle.stop_at_m < 1e17)
    cap = std::min(cap, bounded_by_braking(cycle.stop_at_m - s - 0.02, settings_.comfort_mps2));
  const double error =
      std::abs(geometry::wrap(geometry::bearing(cycle.base_then.position(), cycle.target) - cycle.base_then.yaw));
  if (error > 0.35) cap = std::min(cap, std::max(0.2, cycle.vehicle.limits.max_speed_mps * std::cos(error) * 0.8));
  if (cycle.cautious) cap = std::min(cap, settings_.cautious_mps);
  for (const Mover& mover : cycle.around.movers) {
    if (!mover.may_walk && mover.has_walked) {
      cap = std::min(cap, kCreepMps + std::max(0.0, cycle.gap_then_m(mover) - kBesidePersonM));
    }
    if (!mover.may_walk) continue;
    double gap = 1e9;
    for (const double t : {0.0, 0.5, 1.0})
      gap = std::min(gap,
                     geometry::distance(cycle.base_then.position(), mover.position_in_map + t * mover.velocity_in_map));
    cap = std::min(cap, 0.25 + 0.5 * std::max(0.0, gap - cycle.vehicle.reach_m() - mover.radius_m - 0.2));
  }
  return cap;
}

/// Of the way from `s_m` to the horizon, between its walls and the vehicle on it; at most `most_m`.
double LocalPlanner::least_spare_m(const Cycle& cycle, double s_m, double most_m) const {
  const Route& route = way_.current();
  const double end_m =
      std::min(route.length_m(), s_m + std::max(1.0, last_command_.linear_mps * settings_.dwa.horizon_s));
  double least_m = most_m;
  for (double s = s_m; s <= end_m + 1e-9; s += 0.1)
    least_m = std::min(least_m, cycle.inputs.clearance->clearance_m(route.at(s)) - cycle.discs.radius_m);
  return least_m;
}

Aim LocalPlanner::aim(const Cycle& cycle) const {
  Aim out;
  out.target_in_map = cycle.target;
  const Route& route = way_.current();
  const double nearest = route.project(cycle.base_then.position(), way_.s_m(), way_.s_m() + 0.5);
  out.sub_target_in_map = route.at(nearest + kSubTargetM);
  out.radius_m = cycle.vehicle.reach_m();
  out.step_s = settings_.dwa.step_s;
  if (variant_.knows_path) {
    const double to_target_m = geometry::distance(cycle.base_then.position(), cycle.target);
    out.walls_s = to_target_m / std::max(kStandingMps, last_command_.linear_mps) + settings_.dwa.window_s;
    out.wall_cap_m = std::max(settings_.dwa.wall_margin_m, least_spare_m(cycle, nearest, out.wall_cap_m));
  }
  if (!variant_.asks_for(path_distance_critic)) return out;
  const double end = std::min(route.length_m(), nearest + cycle.vehicle.limits.max_speed_mps * settings_.dwa.horizon_s);
  for (double s = nearest; s <= end + 1e-9; s += 0.2) out.path_in_map.push_back(route.at(s));
  return out;
}

void LocalPlanner::drive(Cycle& cycle) {
  cycle.target = visible_target(cycle);
  if (variant_.has_rolling_window) leave_path_for_sub_target(cycle);
  const double error =
      geometry::wrap(geometry::bearing(cycle.base_then.position(), cycle.target) - cycle.base_then.yaw);
  const bool near_target = geometry::distance(cycle.base_then.position(), cycle.target) < 0.03;
  const bool near_end = way_.left_m() < 0.6;
  if (std::abs(error) > (near_end ? 0.45 : kTurnBeginRad) && !near_target) turning_ = true;
  if (std::abs(error) < kTurnEndRad || near_target) turning_ = false;
  const bool waits_before_it =
      blocked_ && !way_.is_aside() && cycle.stands() && way_.s_m() > blocked_->where.begin_m - 0.2;
  if (waits_before_it || !cycle.vehicle.turns_on_the_spot()) turning_ = false;
  cycle.out.phase = way_.is_on_detour() || way_.is_aside() ? Phase::kAvoiding : Phase::kDriving;
  const Scene scene = scene_of(cycle);
  // A disc may always turn; whatever else turns on the spot looks where its corners go.
  if (turning_ && !cycle.vehicle.footprint.is_disc() &&
      obstruction(scene, turn_of(cycle, error), settings_.dwa) != Obstruction::kNone)
    turning_ = false;
  if (is_lost(cycle)) {
    cycle.out.phase = Phase::kBlocked;
    cycle.out.reason = Reason::kOffPath;
    cycle.out.detail = "cannot get back to the plan without turning on the spot";
    cycle.out.blocked_at_in_map = cycle.here();
    command(cycle, {});
    return;
  }
  if (turning_) {
    cycle.out.phase = Phase::kTurning;
    if (std::abs(last_command_.linear_mps) < 0.02)
      command(cycle, turn_of(cycle, error));
    else
      command(cycle, {0.0, last_command_.angular_radps * 0.5, 0.0});
    moved_ = cycle.now;
    return;
  }
  const Aim aim = this->aim(cycle);
  WayOut way_out{Grade::kNone, choose(scene, aim, variant_, settings_.dwa)};
  if (scene.speed_cap_mps > 2.0 * kStandingMps && !waits_before_it && is_refused(way_out.choice)) {
    const bool may_turn = cycle.vehicle.turns_on_the_spot() && cycle.vehicle.footprint.is_disc();
    way_out =
        local_planner::way_out({scene, aim, way_out.choice, cycle.stands(), may_turn, error}, variant_, settings_.dwa);
  }
  const Choice& choice = way_out.choice;
  const bool refused_by_people = way_out.grade != Grade::kNone &&
                                 choice.rejected[static_cast<int>(Obstruction::kMover)] > 0 && somebody_walks_by(cycle);
  lets_pass_ = refused_by_people && seconds(cycle.now - moved_) < kLetPassS;
  if (waits_before_it)
    command(cycle, {});
  else if (way_out.turn_rad)
    command(cycle, turn_of(cycle, *way_out.turn_rad));
  else if (choice.found)
    command(cycle, choice.twist);
  else
    brake(cycle);
  if (choice.mover_gap_m < 0.4 && cycle.out.phase == Phase::kDriving) cycle.out.phase = Phase::kAvoiding;
  if (!cycle.stands()) moved_ = cycle.now;
  const Grade grade = way_.is_aside() && backs_off_ ? Grade::kBackOff : way_out.grade;
  if (grade != Grade::kNone)
    cycle.out.detail = told(grade);
  else if (cycle.out.phase == Phase::kAvoiding)
    cycle.out.detail = told_avoidance(scene);
  if (cycle.stands())
    tell_why_it_stands({cycle.advice, blocked_, choice, seconds(cycle.now - moved_), settings_.blocked_after_s,
                        cycle.vehicle.reach_m()},
                       cycle.out);
}

/// Where the path's target would be driven at into a collision: aims at the sub-target instead. Not while others are
/// let past, nor with a vehicle that cannot turn back to its path on the spot.
void LocalPlanner::leave_path_for_sub_target(Cycle& cycle) const {
  if (way_.is_aside() || !cycle.vehicle.turns_on_the_spot()) return;
  const Room room = cycle.room(0.02, 0.02);
  const Scene scene = scene_of(cycle);
  cycle.out.sub_target_in_map = avoid({scene, room, way_.current(), way_.s_m()}, cycle.target);
  if (cycle.out.sub_target_in_map) cycle.target = *cycle.out.sub_target_in_map;
}

Scene LocalPlanner::scene_of(const Cycle& cycle) const {
  return {*cycle.inputs.clearance, cycle.base_then,    last_command_,       cycle.discs.radius_m,
          cycle.vehicle.limits,    speed_cap(cycle),   cycle.around.movers, cycle.around.peer_motions,
          steering_rad_,           cycle.discs.ahead_m};
}

/// Near enough to be who refuses what moves.
bool LocalPlanner::somebody_walks_by(const Cycle& cycle) {
  const auto& movers = cycle.around.movers;
  return std::any_of(movers.begin(), movers.end(), [&](const Mover& mover) {
    return mover.velocity_in_map != Point2{} && cycle.gap_then_m(mover) < kWalksByM;
  });
}

/// Along the arc that is being driven.
void LocalPlanner::brake(Cycle& cycle) {
  const double v = last_command_.linear_mps;
  const double next = std::max(0.0, v - cycle.vehicle.limits.max_deceleration_mps2 * settings_.control_period_s);
  command(cycle, {0.0, v > 0.01 ? last_command_.angular_radps * next / v : 0.0, 0.0});
}

/// A vehicle that cannot turn on the spot has left its plan: it is far beside it, looks elsewhere, or is past its end.
bool LocalPlanner::is_lost(const Cycle& cycle) const {
  if (cycle.vehicle.turns_on_the_spot() || !variant_.knows_path) return false;
  const Route& lane = way_.lane();
  const double s = way_.lane_s_m();
  const double turned = std::abs(geometry::wrap(lane.heading_at(s) - cycle.base_now.yaw));
  const bool past_the_end =
      lane.length_m() - s < 0.05 && geometry::from_map(cycle.base_now, lane.points().back()).x < 0.0;
  return geometry::distance(cycle.here(), lane.at(s)) > kLostM || turned > kLostRad || past_the_end;
}

Twist2 LocalPlanner::turn_of(const Cycle& cycle, double error_rad) const {
  const kinematics::Limits& limits = cycle.vehicle.limits;
  const double rate =
      std::min(limits.max_turn_radps, std::sqrt(2.0 * 0.5 * limits.max_turn_acceleration_radps2 * std::abs(error_rad)));
  return {0.0, std::copysign(rate, error_rad), 0.0};
}

void LocalPlanner::command(Cycle& cycle, const Twist2& wanted) {
  const kinematics::DriveState next =
      kinematics::follow({last_command_, steering_rad_}, wanted, cycle.vehicle.limits, settings_.control_period_s);
  last_command_ = next.twist;
  steering_rad_ = next.steering_rad;
  cycle.out.twist = last_command_;
}

/// Distance and time left, and the way that the vehicle claims.
void LocalPlanner::describe(Cycle& cycle) {
  Output& out = cycle.out;
  if (!cycle.inputs.state.seen()) return;
  out.intent.push_back({0.0, cycle.base_now});
  const bool moves =
      out.phase == Phase::kTurning || out.phase == Phase::kDriving || out.phase == Phase::kAvoiding ||
      out.phase == Phase::kBlocked ||
      (out.phase == Phase::kWaiting && (out.reason == Reason::kYielding || out.reason == Reason::kVehicle));
  if (!moves || way_.empty() || arrived_) return;
  out.distance_left_m = way_.lane().length_m() - way_.lane_s_m();
  double end_m = cycle.advice.follows ? 1e18 : cycle.advice.stop_at_m;
  if (blocked_ && !way_.is_aside() && blocked_->vehicle_id.empty()) end_m = std::min(end_m, blocked_->where.begin_m);
  const Claim claim = claim_of(way_, end_m);
  out.intent.insert(out.intent.end(), claim.points.begin(), claim.points.end());
  out.time_left_s = claim.time_left_s;
}

}  // namespace aisle::local_planner
