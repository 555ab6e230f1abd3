#include "services/global-planner/core/fleet_planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/kinematics/vehicle_model.hpp"
#include "services/global-planner/core/drivable.hpp"
#include "services/global-planner/core/nearest_reachable.hpp"
#include "services/global-planner/core/passes/passes.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

using geometry::Point2;
using time::from_seconds;
using time::Stamp;

constexpr std::size_t kLongestDetail = 256;   // as in the IDL
constexpr double kChecked_cells = 0.12;       // a plan is checked for so much less: see ClearanceField between cells
constexpr double kSmallest_m = 0.05;          // a disc smaller than this is not worth a detour
constexpr double kStandsBeside_m = 0.12;      // off its place a vehicle may stand: the widest tube of the traffic
constexpr double kLongestWayOut_m = 10.0;     // of a keep-out zone
constexpr std::size_t kMost = 1024;           // vehicles
constexpr std::size_t kMostWaypoints = 4096;  // as in the IDL

std::string shortened(std::string text) {
  return text.size() <= kLongestDetail ? text : text.substr(0, kLongestDetail);
}

/// Is the goal that the vehicle says to have reached this one?
bool is_arrived(const std::optional<NavigationStatus>& navigation, const std::optional<Goal>& goal) {
  return navigation && goal && navigation->phase == Phase::kArrived && navigation->goal_id == goal->id;
}

/// As it goes out on the wire.
PlanOutcome outcome_of(Outcome searched) {
  switch (searched) {
    case Outcome::kFound:
      return PlanOutcome::kFound;
    case Outcome::kNoPath:
      return PlanOutcome::kNoPath;
    case Outcome::kStartBlocked:
      return PlanOutcome::kStartBlocked;
    case Outcome::kGoalBlocked:
      return PlanOutcome::kGoalBlocked;
    case Outcome::kOutOfMap:
      return PlanOutcome::kOutOfMap;
    case Outcome::kOutOfTime:
      return PlanOutcome::kOutOfTime;
  }

  return PlanOutcome::kNoPath;
}

}  // namespace

VehicleShape shape_of(const geometry::Footprint& footprint, const kinematics::Limits& limits) {
  constexpr double kWider = 2.0;  // than the tightest arc, so that the vehicle can correct what it drives
  const double reach_m = geometry::reach_m(footprint);
  const double turning_radius_m = kinematics::least_turning_radius_m(limits);
  if (!(turning_radius_m > 0.0)) return {reach_m, reach_m, 0.0, {}};

  const geometry::CoveringDiscs discs = geometry::covering_discs(footprint);

  return {discs.radius_m, reach_m, kWider * turning_radius_m, discs.ahead_m};
}

FleetPlanner::FleetPlanner(const FleetSettings& settings, std::unique_ptr<Planner> planner)
    : settings_(settings), planner_(std::move(planner)) {}

void FleetPlanner::set_map(const std::string& map_id, std::uint64_t revision, const grid::OccupancyGrid& grid,
                           grid::Cell low, grid::Cell high) {
  const bool is_same_place = map_revision_ > 0 && map_id == map_id_ && grid.geometry() == clearance_.geometry();

  grid_ = &grid;
  map_id_ = map_id;
  map_revision_ = revision;

  if (is_same_place) {
    clearance_.update(*grid_, low, high);
  } else {
    rebuild_clearance();
  }
}

void FleetPlanner::rebuild_clearance() { clearance_ = grid::ClearanceField(*grid_, reach_m_); }

void FleetPlanner::set_zones(const std::vector<fleet::Zone>& zones) {
  if (zones == zones_) return;

  zones_ = zones;
  for (auto& [id, v] : vehicles_) v.is_doubted = v.plan.has_value();
}

const fleet::Zone* FleetPlanner::zone_at_goal(const VehicleEntry& v) const {
  const Point2 goal = v.goal->pose_in_map.position();
  const auto refuses = [&](const fleet::Zone& zone) {
    const double reach_m = zone.kind == fleet::Zone::Kind::kKeepOut      ? *v.radius_m
                           : zone.kind == fleet::Zone::Kind::kNoStopping ? v.shape.reach_m + kStandsBeside_m
                                                                         : 0.0;
    return reach_m > 0.0 && fleet::distance_m(zone, goal, goal) < reach_m;
  };

  const auto found = std::find_if(zones_.begin(), zones_.end(), refuses);
  return found == zones_.end() ? nullptr : &*found;
}

void FleetPlanner::set_vehicle(const std::string& agv_id, const VehicleShape& shape) {
  VehicleEntry* v = vehicle(agv_id);
  if (v == nullptr) return;

  v->radius_m = shape.radius_m;
  v->shape = shape;
  if (shape.turning_radius_m > 0.0 && !steered_) steered_ = find_variant("hybrid")->make();
  const double needed_m = std::max({shape.radius_m + settings_.margin_m + 0.5, settings_.preferred_clearance_m,
                                    shape.radius_m + settings_.safe_distance_m});
  if (needed_m <= reach_m_) return;

  reach_m_ = needed_m;
  if (map_revision_ > 0) rebuild_clearance();
}

void FleetPlanner::set_pose(const std::string& agv_id, const geometry::Pose2& base_in_map, Stamp now) {
  if (VehicleEntry* const v = vehicle(agv_id)) v->pose.set(base_in_map, now);
}

void FleetPlanner::set_goal(const Goal& goal) {
  if (goal.is_cancelled && vehicles_.count(goal.agv_id) == 0) return;  // there is nothing to cancel

  VehicleEntry* const known = vehicle(goal.agv_id);
  if (known == nullptr) return;
  VehicleEntry& v = *known;
  if (v.goal && *v.goal == goal) return;

  v.goal = goal;
  v.next_attempt = Stamp{};
  v.wait_s = 0.0;
}

void FleetPlanner::set_navigation(const NavigationStatus& navigation) {
  if (VehicleEntry* const v = vehicle(navigation.agv_id)) v->navigation = navigation;
}

void FleetPlanner::take_over() {
  for (auto& [id, v] : vehicles_) {
    v.is_taken_over = v.goal.has_value();
    v.plan.reset();
  }
}

void FleetPlanner::hear_plan(const std::string& agv_id, const std::string& goal_id) {
  if (VehicleEntry* const v = vehicle(agv_id)) v->led_goal = goal_id;
}

void FleetPlanner::plan_again(const std::string& agv_id) {
  const auto known = vehicles_.find(agv_id);
  if (known != vehicles_.end()) known->second.plan.reset();
}

const Plan* FleetPlanner::plan_of(const std::string& agv_id) const {
  const auto known = vehicles_.find(agv_id);
  return known != vehicles_.end() && known->second.plan ? &*known->second.plan : nullptr;
}

FleetPlanner::VehicleEntry* FleetPlanner::vehicle(const std::string& agv_id) {
  const auto known = vehicles_.find(agv_id);
  if (known != vehicles_.end()) return &known->second;
  if (vehicles_.size() >= kMost) return nullptr;

  VehicleEntry& v = vehicles_[agv_id];
  v.id = agv_id;

  return &v;
}

std::optional<Plan> FleetPlanner::step(Stamp now, const OutOfTime& out_of_time) {
  // Vehicles take turns, from the one after the last that was attended to; one that needs a search ends the step.
  auto turn = vehicles_.upper_bound(last_attended_);
  for (std::size_t i = 0; i < vehicles_.size(); ++i, ++turn) {
    if (turn == vehicles_.end()) turn = vehicles_.begin();

    const std::uint64_t before = searches_;
    std::optional<Plan> plan = attend(turn->second, now, out_of_time);
    if (!plan && searches_ == before) continue;

    last_attended_ = turn->first;
    return plan;
  }

  return {};
}

std::optional<Plan> FleetPlanner::attend(VehicleEntry& v, Stamp now, const OutOfTime& out_of_time) {
  if (!v.goal) return {};
  if (v.goal->is_cancelled) return cancel(v);

  const geometry::Pose2* pose = v.pose.fresh(now, from_seconds(settings_.state_life_s));
  if (map_revision_ == 0 || !v.radius_m || pose == nullptr) return {};
  if (!v.plan && is_arrived(v.navigation, v.goal)) return {};  // reached in a former life of this planner

  if (!v.plan || v.planned_for != *v.goal) {
    const bool is_led = v.is_taken_over || v.led_goal == v.goal->id;
    return publish(v, plan_anew(v, is_led ? PlanTrigger::kTakeover : PlanTrigger::kNewGoal, out_of_time), now);
  }

  v.progress.advance(pose->position());
  const bool is_of_this_map = v.plan->map_revision == map_revision_ && v.plan->map_id == map_id_;
  if (!is_of_this_map || v.is_doubted) return check_map(v, now, out_of_time);

  if (v.plan->is_found() || is_arrived(v.navigation, v.goal)) return {};
  return retry(v, now, out_of_time);
}

std::optional<Plan> FleetPlanner::cancel(VehicleEntry& v) {
  if (v.plan && v.planned_for == *v.goal) return {};

  Plan plan = blank_plan(v);
  plan.outcome = PlanOutcome::kCancelled;
  plan.detail = fmt::format("goal {} was cancelled", v.goal->id);

  return publish(v, std::move(plan), Stamp{});
}

std::optional<Plan> FleetPlanner::check_map(VehicleEntry& v, Stamp now, const OutOfTime& out_of_time) {
  const bool is_led_on = v.plan->outcome == PlanOutcome::kFound && !v.leads_to_nearest && zone_at_goal(v) == nullptr;
  const bool is_kept = is_arrived(v.navigation, v.goal) || (is_led_on && is_rest_free(v));
  v.is_doubted = false;
  if (!is_kept) return publish(v, plan_anew(v, PlanTrigger::kMapChanged, out_of_time), now);

  v.plan->map_id = map_id_;
  v.plan->map_revision = map_revision_;

  return v.plan;
}

std::optional<Plan> FleetPlanner::retry(VehicleEntry& v, Stamp now, const OutOfTime& out_of_time) {
  if (now < v.next_attempt) return {};
  Plan plan = plan_anew(v, v.plan->trigger, out_of_time);
  if (plan.outcome != v.plan->outcome) return publish(v, std::move(plan), now);

  put_off(v, now);

  return {};
}

/// A plan for the vehicle's goal, checked against the newest map, without a way yet.
Plan FleetPlanner::blank_plan(const VehicleEntry& v) const {
  Plan plan;
  plan.agv_id = v.id;
  plan.goal_id = v.goal->id;
  plan.goal_in_map = v.goal->pose_in_map;
  plan.position_tolerance_m = v.goal->position_tolerance_m;
  plan.yaw_tolerance_rad = v.goal->yaw_tolerance_rad;

  plan.map_id = map_id_;
  plan.map_revision = map_revision_;

  return plan;
}

Plan FleetPlanner::plan_anew(const VehicleEntry& v, PlanTrigger trigger, const OutOfTime& out_of_time) {
  Plan plan = blank_plan(v);
  plan.trigger = trigger;

  const Point2 goal = v.goal->pose_in_map.position();
  const fleet::Zone* zone = zone_at_goal(v);
  const bool is_closed_floor = zone == nullptr || zone->kind == fleet::Zone::Kind::kKeepOut;

  PlannedPath found;
  if (zone != nullptr) {
    found.outcome = Outcome::kGoalBlocked;
    plan.detail = fmt::format("the goal ({:.2f}, {:.2f}) lies in or too near to the {} zone {}", goal.x, goal.y,
                              name(zone->kind), zone->id);
  } else {
    found = search(v, v.pose.any()->position(), goal, out_of_time);
    if (found.outcome == Outcome::kStartBlocked) found = search_out_of_zone(v, out_of_time);
    if (found.outcome != Outcome::kFound) plan.detail = shortened(why(v, found.outcome, out_of_time));
  }

  if (settings_.to_nearest && is_closed_floor &&
      (found.outcome == Outcome::kNoPath || found.outcome == Outcome::kGoalBlocked)) {
    PlannedPath nearest = search_nearest(v, out_of_time);

    if (nearest.outcome == Outcome::kFound) {
      found = std::move(nearest);
      const Point2 end = found.waypoints_in_map.back();
      plan.goal_in_map = {end.x, end.y, plan.goal_in_map.yaw};
    }
  }

  plan.outcome = outcome_of(found.outcome);
  plan.waypoints_in_map = std::move(found.waypoints_in_map);
  plan.length_m = found.length_m;

  return plan;
}

std::optional<Plan> FleetPlanner::publish(VehicleEntry& v, Plan plan, Stamp now) {
  plan.id = next_plan_id_++;

  v.planned_for = *v.goal;
  v.leads_to_nearest = plan.goal_in_map.position() != v.goal->pose_in_map.position();
  v.progress = PathProgress(plan.waypoints_in_map);

  v.is_taken_over = false;
  v.led_goal.clear();
  v.wait_s = 0.0;
  v.next_attempt = now + from_seconds(settings_.replan_s);

  events_.push_back(plan.outcome == PlanOutcome::kFound
                        ? fmt::format("{}: plan {} to {} ({}): {:.2f} m, {} points{}{}", v.id, plan.id, plan.goal_id,
                                      name(plan.trigger), plan.length_m, plan.waypoints_in_map.size(),
                                      plan.detail.empty() ? "" : ", ", plan.detail)
                        : fmt::format("{}: plan {} to {} ({}): {}: {}", v.id, plan.id, plan.goal_id, name(plan.trigger),
                                      name(plan.outcome), plan.detail));
  v.plan = std::move(plan);

  return v.plan;
}

void FleetPlanner::put_off(VehicleEntry& v, Stamp now) {
  v.wait_s = std::clamp(2.0 * v.wait_s, settings_.replan_s, std::max(settings_.replan_s, settings_.longest_wait_s));
  v.next_attempt = now + from_seconds(v.wait_s);
}

Problem FleetPlanner::problem_of(const VehicleEntry& v, Point2 start_in_map, Point2 goal_in_map) const {
  Problem problem{clearance_,  start_in_map,           goal_in_map, *v.radius_m + settings_.margin_m,
                  *v.radius_m, settings_.tight_range_m};
  problem.preferred_clearance_m = settings_.preferred_clearance_m;
  problem.safe_distance_m = *v.radius_m + settings_.safe_distance_m;
  if (!is_steered(v)) return problem;
  problem.steering = {v.shape.turning_radius_m, v.pose.any()->yaw, {}, false, v.shape.discs_ahead_m};
  if (v.goal->yaw_tolerance_rad > 0.0) problem.steering.goal_yaw_rad = v.goal->pose_in_map.yaw;

  return problem;
}

PlannedPath FleetPlanner::search(const VehicleEntry& v, Point2 start_in_map, Point2 goal_in_map,
                                 const OutOfTime& out_of_time) {
  ++searches_;
  const Problem problem = problem_of(v, start_in_map, goal_in_map);
  const bool steers = is_steered(v);
  if (!steers && is_known_unreachable(problem)) return {};
  PlannedPath plan = (steers ? *steered_ : *planner_).plan(problem, out_of_time);
  if (plan.outcome != Outcome::kFound) return plan;
  passes::collinear(Drivable(problem), plan.waypoints_in_map);
  if (plan.waypoints_in_map.size() > kMostWaypoints)
    passes::greedy_line_of_sight(Drivable(problem), plan.waypoints_in_map);
  if (plan.waypoints_in_map.size() > kMostWaypoints) return {};

  return plan;
}

/// What stands near an end is made smaller, so that the ends stay free: the traffic says whether they may be entered.
std::vector<Point2> FleetPlanner::own_way(const std::string& agv_id, Point2 from_in_map, Point2 to_in_map,
                                          const std::vector<Disc>& standing, const OutOfTime& out_of_time,
                                          const std::vector<std::vector<Point2>>& closed) {
  const auto known = vehicles_.find(agv_id);
  if (known == vehicles_.end() || !known->second.radius_m || !known->second.goal || map_revision_ == 0) return {};
  const VehicleEntry& v = known->second;

  const double slack_m = 1.5 * clearance_.geometry().resolution_m;  // stamping a disc into cells makes it larger
  std::vector<Disc> discs;
  for (Disc disc : standing) {
    const double nearest_end_m = std::min(geometry::distance(from_in_map, disc.center_in_map),
                                          geometry::distance(to_in_map, disc.center_in_map));
    disc.radius_m = std::min(disc.radius_m, nearest_end_m - *v.radius_m - slack_m);
    if (disc.radius_m >= kSmallest_m && is_in_map(clearance_.geometry(), disc.center_in_map)) discs.push_back(disc);
  }

  const StampedDiscs stamped(*grid_, clearance_, discs, closed);
  return search(v, from_in_map, to_in_map, out_of_time).waypoints_in_map;
}

/// The parts of the map are only made to explain the first goal without a way after an edit; for the next ones they
/// spare the search.
bool FleetPlanner::is_known_unreachable(const Problem& problem) const {
  const grid::Geometry& geometry = clearance_.geometry();
  if (!is_in_map(geometry, problem.start_in_map) || !is_in_map(geometry, problem.goal_in_map)) return false;
  return parts_.is_made_for(Drivable(problem)) &&
         parts_.are_apart(geometry.cell_at(problem.start_in_map), geometry.cell_at(problem.goal_in_map));
}

/// How: all cells around are looked at for the nearest in which the vehicle has its whole radius and margin.
PlannedPath FleetPlanner::search_out_of_zone(const VehicleEntry& v, const OutOfTime& out_of_time) {
  PlannedPath blocked;
  blocked.outcome = Outcome::kStartBlocked;
  const Point2 start = v.pose.any()->position();
  const bool is_in_zone = std::any_of(zones_.begin(), zones_.end(), [&](const fleet::Zone& zone) {
    return zone.kind == fleet::Zone::Kind::kKeepOut && fleet::distance_m(zone, start, start) < *v.radius_m;
  });
  if (!is_in_zone) return blocked;

  const grid::Geometry& geometry = clearance_.geometry();
  const double need_m = *v.radius_m + settings_.margin_m + geometry.resolution_m;
  const grid::Cell middle = geometry.cell_at(start);
  const int range = static_cast<int>(kLongestWayOut_m / geometry.resolution_m);
  std::optional<Point2> nearest;

  for (int y = std::max(0, middle.y - range); y <= std::min(middle.y + range, geometry.height - 1); ++y) {
    for (int x = std::max(0, middle.x - range); x <= std::min(middle.x + range, geometry.width - 1); ++x) {
      const Point2 centre = geometry.center_in_map({x, y});
      const bool is_nearer = !nearest || geometry::distance(start, centre) < geometry::distance(start, *nearest);
      if (is_nearer && clearance_.clearance_m(grid::Cell{x, y}) >= need_m) nearest = centre;
    }
  }
  if (!nearest) return blocked;

  PlannedPath found = search(v, *nearest, v.goal->pose_in_map.position(), out_of_time);
  if (found.outcome != Outcome::kFound) return found;
  found.waypoints_in_map.insert(found.waypoints_in_map.begin(), start);
  found.length_m += geometry::distance(start, *nearest);
  found.headings_rad.clear();

  return found;
}

PlannedPath FleetPlanner::search_nearest(const VehicleEntry& v, const OutOfTime& out_of_time) {
  const Problem problem = problem_of(v, v.pose.any()->position(), v.goal->pose_in_map.position());
  const std::optional<Point2> point = nearest_reachable(problem, parts_, out_of_time);
  if (!point) return {};

  return planner_->plan(problem_of(v, problem.start_in_map, *point), out_of_time);
}

bool FleetPlanner::is_rest_free(const VehicleEntry& v) const {
  const std::vector<Point2> rest = v.progress.remaining();
  if (rest.empty()) return false;
  Problem problem = problem_of(v, v.plan->waypoints_in_map.front(), v.plan->waypoints_in_map.back());
  problem.radius_m -= kChecked_cells * clearance_.geometry().resolution_m;
  problem.least_radius_m -= kChecked_cells * clearance_.geometry().resolution_m;
  if (!is_in_map(clearance_.geometry(), problem.start_in_map) || !is_in_map(clearance_.geometry(), problem.goal_in_map))
    return false;
  const Drivable drivable(problem);
  for (std::size_t i = 1; i < rest.size(); ++i) {
    if (!drivable.is_line_free(rest[i - 1], rest[i])) return false;
  }

  return drivable.is_free(rest.back());
}

std::string FleetPlanner::why(const VehicleEntry& v, Outcome outcome, const OutOfTime& out_of_time) {
  const Point2 start = v.pose.any()->position();
  const Point2 goal = v.goal->pose_in_map.position();

  const grid::Geometry& geometry = clearance_.geometry();
  const auto nearest = [&] {
    const std::optional<Point2> point = nearest_reachable(problem_of(v, start, goal), parts_, out_of_time);
    return point ? fmt::format("; the nearest reachable point is ({:.2f}, {:.2f}), {:.2f} m from the goal", point->x,
                               point->y, geometry::distance(*point, goal))
                 : std::string{};
  };

  switch (outcome) {
    case Outcome::kStartBlocked:
      return fmt::format("the vehicle at ({:.2f}, {:.2f}) has {:.2f} m of clearance in the map, its radius is {:.2f} m",
                         start.x, start.y, clearance_.clearance_m(start), *v.radius_m);
    case Outcome::kGoalBlocked:
      return fmt::format("the goal ({:.2f}, {:.2f}) has {:.2f} m of clearance, the vehicle's radius is {:.2f} m{}",
                         goal.x, goal.y, clearance_.clearance_m(goal), *v.radius_m, nearest());
    case Outcome::kOutOfMap:
      return fmt::format("{} ({:.2f}, {:.2f}) is outside the map, x {:.2f} to {:.2f}, y {:.2f} to {:.2f}",
                         is_in_map(geometry, goal) ? "the vehicle" : "the goal",
                         is_in_map(geometry, goal) ? start.x : goal.x, is_in_map(geometry, goal) ? start.y : goal.y,
                         geometry.origin_in_map.x, geometry.origin_in_map.x + geometry.width * geometry.resolution_m,
                         geometry.origin_in_map.y, geometry.origin_in_map.y + geometry.height * geometry.resolution_m);

    case Outcome::kOutOfTime:
      return fmt::format("the search from ({:.2f}, {:.2f}) to ({:.2f}, {:.2f}) took too long", start.x, start.y, goal.x,
                         goal.y);
    case Outcome::kNoPath:
    case Outcome::kFound:
      break;
  }

  return fmt::format("no way from ({:.2f}, {:.2f}) to ({:.2f}, {:.2f}) that is {:.2f} m wide{}", start.x, start.y,
                     goal.x, goal.y, 2.0 * (*v.radius_m + settings_.margin_m), nearest());
}

std::vector<std::string> FleetPlanner::take_events() { return std::exchange(events_, {}); }

std::string FleetPlanner::waits_for(Stamp now) const {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
  if (map_revision_ == 0) add("map_info and map_tile");

  for (const auto& [id, v] : vehicles_) {
    if (!v.goal || v.goal->is_cancelled) continue;
    if (!v.radius_m) add("vehicle_info of " + id);
    if (v.pose.fresh(now, from_seconds(settings_.state_life_s)) == nullptr) add("vehicle_state of " + id);
  }

  return shortened(text);
}

}  // namespace aisle::global_planner
