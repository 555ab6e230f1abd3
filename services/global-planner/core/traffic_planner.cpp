#include "services/global-planner/core/traffic_planner.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/fleet/any_vehicle.hpp"
#include "common/grid/polygon_cells.hpp"
#include "services/global-planner/core/traffic/zone_rules.hpp"

namespace aisle::global_planner {
namespace {

using geometry::Point2;
using time::from_seconds;
using time::Stamp;

constexpr double kTubeM = 0.10;         // of a vehicle that turns on the spot
constexpr double kTubeSteeredM = 0.12;  // of one that does not: its far corner swings
constexpr double kHearAllS = 3.0;       // after it began to lead, it plans nothing for so long until all were heard
constexpr double kGatherS = 0.2;        // and for so long after each new vehicle, until it has planned once
constexpr double kSilentS = 2.0;
constexpr std::size_t kMostVehicles = 1000;
constexpr double kMovesMps = 0.02;
constexpr double kSameDiscM = 0.1;  // a track that moved or grew less is where it was

traffic::Kind kind_of(const fleet::Vehicle& vehicle, const FleetSettings& settings) {
  traffic::Kind kind;
  kind.footprint = vehicle.footprint;
  kind.limits = vehicle.limits;
  kind.limits.max_reverse_mps = 0.0;  // local planners drive no plan backwards
  kind.turning_radius_m = shape_of(vehicle.footprint, vehicle.limits).turning_radius_m;
  kind.tube_m = kind.turns_on_the_spot() ? kTubeM : kTubeSteeredM;
  kind.wall_margin_m = settings.margin_m;

  return kind;
}

traffic::Shape shape_of(const Disc& disc) {
  return traffic::Shape({traffic::Capsule{disc.center_in_map, disc.center_in_map, disc.radius_m}});
}

double speed_mps(const fleet::VehicleState& state) {
  return std::hypot(state.motion.twist.linear_mps, state.motion.twist.sideways_mps);
}

std::string track_name(std::uint64_t track_id) { return "track " + std::to_string(track_id); }

/// Numbers that a vehicle can have come to, and a road of a length that it can have been granted: what a vehicle says
/// it holds is held, step by step.
bool is_credible(const NavigationStatus& says) {
  constexpr std::uint64_t kHighest = std::uint64_t{1} << 53;
  constexpr std::uint64_t kMostSteps = 4096;  // of a plan, as in the IDL
  constexpr double kLongestLegM = 200.0;

  const std::uint64_t highest = std::max({says.step_done, says.limit_step, says.grant_number, says.plan_id});
  if (highest > kHighest || says.limit_step > says.step_done + kMostSteps) return false;

  for (std::size_t i = 1; i < says.held.size(); ++i) {
    const Point2 from = says.held[i - 1].base_in_map.position(), to = says.held[i].base_in_map.position();
    if (geometry::distance(from, to) > kLongestLegM) return false;
  }

  return true;
}

bool has_keep_out(const std::vector<fleet::Zone>& zones) {
  return std::any_of(zones.begin(), zones.end(),
                     [](const fleet::Zone& zone) { return zone.kind == fleet::Zone::Kind::kKeepOut; });
}

/// Does the vehicle obey the planner that leads with this claim?
bool obeys(const NavigationStatus& says, const fleet::Claim& claim) {
  return fleet::Claim{says.traffic_epoch, says.traffic_boot_id} == claim;
}

double length_m(const std::vector<Point2>& way) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) sum_m += geometry::distance(way[i - 1], way[i]);
  return sum_m;
}

}  // namespace

TrafficPlanner::TrafficPlanner(const FleetSettings& settings, std::unique_ptr<Planner> planner)
    : settings_(settings), goals_(settings, std::move(planner)), coordinator_(new_coordinator()) {}

std::unique_ptr<traffic::Coordinator> TrafficPlanner::new_coordinator() {
  auto coordinator = std::make_unique<traffic::Coordinator>(
      traffic::Coordinator::Settings{}, [this](const std::string& agv_id, Point2 from_in_map, Point2 to_in_map) {
        return own_way(agv_id, from_in_map, to_in_map);
      });

  coordinator->set_bare_map(has_keep_out(zones_) ? map_ : nullptr);
  coordinator->set_zones(zones_, 0.0);
  if (map_revision_ > 0) coordinator->set_map(goals_.clearance(), {0, 0}, map_high_);
  for (const auto& [agv_id, entry] : vehicles_) coordinator->set_vehicle(agv_id, entry.kind);
  for (const std::string& agv_id : expected_) coordinator->expect(agv_id);
  for (const auto& [id, standing] : standing_) coordinator->set_standing(track_name(id), shape_of(standing.disc), 0.0);

  return coordinator;
}

void TrafficPlanner::set_map(const std::string& map_id, std::uint64_t revision, const grid::OccupancyGrid& grid,
                             grid::Cell low, grid::Cell high) {
  const bool is_first = map_revision_ == 0 || map_id != map_id_;

  map_ = &grid;
  map_id_ = map_id;
  map_revision_ = revision;
  map_high_ = {grid.geometry().width - 1, grid.geometry().height - 1};
  use_map(is_first ? grid::Cell{0, 0} : low, is_first ? map_high_ : high);
}

void TrafficPlanner::use_map(grid::Cell low, grid::Cell high) {
  const bool is_whole = !has_keep_out(zones_);
  if (!is_whole) {
    floor_ = *map_;
    for (const fleet::Zone& zone : zones_)
      if (zone.kind == fleet::Zone::Kind::kKeepOut)
        for (const grid::Cell cell : grid::cells_touching(map_->geometry(), fleet::corners_of(zone)))
          floor_.set(cell, grid::Occupancy::kOccupied);
  }

  goals_.set_map(map_id_, map_revision_, is_whole ? *map_ : floor_, low, high);
  if (settings_.as_printed) return;

  coordinator_->set_bare_map(is_whole ? nullptr : map_);
  coordinator_->set_map(goals_.clearance(), low, high);
}

void TrafficPlanner::set_zones(const std::vector<fleet::Zone>& zones, Stamp now) {
  if (zones == zones_) return;

  // Of floor that is closed, or open again, the cells.
  std::vector<grid::Cell> changed;
  const auto note_changed = [&](const std::vector<fleet::Zone>& some, const std::vector<fleet::Zone>& others) {
    for (const fleet::Zone& zone : some) {
      const bool is_kept = std::find(others.begin(), others.end(), zone) != others.end();
      if (zone.kind != fleet::Zone::Kind::kKeepOut || is_kept || map_ == nullptr) continue;
      const std::vector<grid::Cell> cells = grid::cells_touching(map_->geometry(), fleet::corners_of(zone));
      changed.insert(changed.end(), cells.begin(), cells.end());
    }
  };
  note_changed(zones_, zones);
  note_changed(zones, zones_);

  zones_ = zones;
  goals_.set_zones(zones_);
  if (!changed.empty()) {
    grid::Cell low = changed.front(), high = changed.front();
    for (const grid::Cell cell : changed) {
      low = {std::min(low.x, cell.x), std::min(low.y, cell.y)};
      high = {std::max(high.x, cell.x), std::max(high.y, cell.y)};
    }
    use_map(low, high);
  }
  if (!settings_.as_printed) coordinator_->set_zones(zones_, time::seconds(now));
  events_.push_back(fmt::format("the map has {} zones", zones_.size()));
}

void TrafficPlanner::set_vehicle(const fleet::Vehicle& vehicle) {
  goals_.set_vehicle(vehicle.id, shape_of(vehicle.footprint, vehicle.limits));

  if (vehicles_.count(vehicle.id) == 0 && expected_.count(vehicle.id) == 0 && !has_room_for(vehicle.id)) return;

  expected_.erase(vehicle.id);
  given_up_.erase(vehicle.id);
  Entry& entry = vehicles_[vehicle.id];
  entry.kind = kind_of(vehicle, settings_);
  if (!entry.is_signed_off) coordinator_->set_vehicle(vehicle.id, entry.kind);
}

bool TrafficPlanner::has_room_for(const std::string& agv_id) {
  if (vehicles_.size() + expected_.size() < kMostVehicles) return true;

  if (!std::exchange(has_refused_vehicle_, true))
    events_.push_back(fmt::format("{} is refused: {} vehicles are the most", agv_id, kMostVehicles));
  return false;
}

void TrafficPlanner::set_state(const fleet::VehicleState& state, Stamp now) {
  goals_.set_pose(state.agv_id, state.motion.base_in_map, now);

  const auto known = vehicles_.find(state.agv_id);
  if (known == vehicles_.end()) {
    given_up_.erase(state.agv_id);  // it speaks
    return expect(state.agv_id);
  }

  known->second.state.set(state, now);
}

void TrafficPlanner::set_goal(const Goal& goal) {
  goals_.set_goal(goal);

  const auto known = vehicles_.find(goal.agv_id);
  if (known != vehicles_.end() && !goal.is_cancelled && goal.id == known->second.reached_goal &&
      known->second.navigation->goal_id != goal.id) {
    known->second.reached_goal.clear();
    goals_.plan_again(goal.agv_id);
  }

  // Later, a goal for a vehicle that is not there holds up nobody.
  if (!began_ && !goal.is_cancelled && goal.agv_id != fleet::kAnyVehicle) expect(goal.agv_id);
}

void TrafficPlanner::hear_plan(const std::string& agv_id, const std::string& goal_id) {
  goals_.hear_plan(agv_id, goal_id);
  expect(agv_id);
}

void TrafficPlanner::expect(const std::string& agv_id) {
  if (vehicles_.count(agv_id) > 0 || expected_.count(agv_id) > 0 || given_up_.count(agv_id) > 0) return;
  if (!has_room_for(agv_id)) return;

  expected_.insert(agv_id);
  coordinator_->expect(agv_id);
}

void TrafficPlanner::set_navigation(const NavigationStatus& navigation, std::uint64_t boot_id, Stamp now) {
  goals_.set_navigation(navigation);

  const auto known = vehicles_.find(navigation.agv_id);
  if (known == vehicles_.end() || settings_.as_printed) return;

  Entry& entry = known->second;
  entry.navigation = navigation;
  entry.navigation_arrived = now;
  entry.boot_id = boot_id;
  if (std::exchange(entry.is_signed_off, false)) coordinator_->set_vehicle(navigation.agv_id, entry.kind);
  tell_coordinator(entry, navigation.agv_id, now);

  const bool is_there = navigation.phase == Phase::kArrived && navigation.goal_id == entry.planned_goal;
  if (is_there && !entry.planned_goal.empty()) {
    entry.reached_goal = std::exchange(entry.planned_goal, {});
    coordinator_->set_goal(navigation.agv_id, "", std::nullopt, time::seconds(now));
  }
}

/// A status without a pose, or with one that is long gone, says nothing of where the vehicle is; of a vehicle that has
/// not heard of this leader yet it does not say all that the vehicle may come to drive.
void TrafficPlanner::tell_coordinator(Entry& entry, const std::string& agv_id, Stamp now) {
  const fleet::VehicleState* state = entry.state.fresh(now, from_seconds(settings_.state_life_s));
  if (state == nullptr || !entry.navigation || !obeys(*entry.navigation, claim_)) return;
  if (!is_credible(*entry.navigation)) {
    if (!std::exchange(entry.is_incredible, true))
      events_.push_back(agv_id + ": its status tells of more steps or road than a plan can have: not believed");
    return;
  }

  entry.is_incredible = false;
  entry.is_heard = true;
  coordinator_->hear(report_of(agv_id, entry), time::seconds(now));
}

traffic::Report TrafficPlanner::report_of(const std::string& agv_id, const Entry& entry) const {
  const fleet::VehicleState& state = *entry.state.any();
  traffic::Report report;
  report.agv_id = agv_id;
  report.base_in_map = state.motion.base_in_map;
  report.speed_mps = speed_mps(state);
  report.is_held = state.hold == fleet::Hold::kPerson;
  if (!entry.navigation || !is_credible(*entry.navigation)) return report;

  const NavigationStatus& says = *entry.navigation;
  report.boot_id = entry.boot_id;
  report.plan_id = says.plan_id;
  report.step_done = says.step_done;
  report.limit_step = says.limit_step;
  report.grant_number = says.grant_number;
  report.is_others_grant = says.grant_number > 0 && says.grant_boot_id != claim_.boot_id;
  report.stray_m = says.stray_m;

  report.is_blocked = says.phase == Phase::kBlocked && says.reason == Reason::kObstacle;
  report.blocked_at_in_map = says.blocked_at_in_map;
  report.blocked_radius_m = says.blocked_radius_m;
  for (const fleet::HeldPose& held : says.held) report.held.push_back({held.base_in_map, held.step});

  return report;
}

std::optional<geometry::Pose2> TrafficPlanner::last_pose(const Entry& entry) {
  if (!entry.state.seen()) return std::nullopt;
  return entry.state.any()->motion.base_in_map;
}

void TrafficPlanner::sign_off(const fleet::SignOff& sign_off, Stamp now) {
  const std::string& agv_id = sign_off.agv_id;
  const auto known = vehicles_.find(agv_id);
  if (known == vehicles_.end()) {
    if (expected_.erase(agv_id) > 0) given_up_.insert(agv_id);
    return coordinator_->sign_off(agv_id, std::nullopt, std::nullopt, time::seconds(now));
  }

  Entry& entry = known->second;
  const bool is_heard = entry.navigation && now - entry.navigation_arrived <= from_seconds(kSilentS);
  const fleet::VehicleState* state = entry.state.fresh(now, from_seconds(settings_.state_life_s));
  const bool moves = state != nullptr && speed_mps(*state) > kMovesMps;
  const bool says_nothing_new =
      entry.is_signed_off && (!sign_off.place_in_map || sign_off.place_in_map == entry.signed_off_at_in_map);
  if (is_heard || moves || says_nothing_new) return;

  entry.is_signed_off = true;
  entry.is_heard = true;
  entry.signed_off_at_in_map = sign_off.place_in_map;
  tell_sign_off(agv_id, entry, now);
}

void TrafficPlanner::tell_sign_off(const std::string& agv_id, const Entry& entry, Stamp now) {
  std::optional<traffic::Report> last_word;
  if (entry.state.seen()) last_word = report_of(agv_id, entry);
  coordinator_->sign_off(agv_id, entry.signed_off_at_in_map, last_word, time::seconds(now));
}

bool TrafficPlanner::are_all_heard() const {
  return expected_.empty() &&
         std::all_of(vehicles_.begin(), vehicles_.end(), [](const auto& vehicle) { return vehicle.second.is_heard; });
}

bool TrafficPlanner::is_gathering(Stamp now) {
  if (has_gathered_) return false;

  if (vehicles_.size() != std::exchange(gathered_, vehicles_.size())) gathered_last_ = now;
  has_gathered_ = now - gathered_last_ >= from_seconds(kGatherS);
  return !has_gathered_;
}

void TrafficPlanner::set_static_track(std::uint64_t track_id, const Disc& disc, Stamp now) {
  constexpr std::size_t kMostTracks = 1024;
  const auto known = standing_.find(track_id);
  if (known == standing_.end() && standing_.size() >= kMostTracks) return;

  if (known != standing_.end()) {
    known->second.lost.reset();
    const Disc& before = known->second.disc;
    if (geometry::distance(before.center_in_map, disc.center_in_map) < kSameDiscM &&
        std::abs(before.radius_m - disc.radius_m) < kSameDiscM)
      return;
  }

  if (known == standing_.end())
    events_.push_back(fmt::format("track {} stands at ({:.2f}, {:.2f}), radius {:.2f} m", track_id,
                                  disc.center_in_map.x, disc.center_in_map.y, disc.radius_m));
  standing_[track_id] = {disc, std::nullopt};
  coordinator_->set_standing(track_name(track_id), shape_of(disc), time::seconds(now));
}

void TrafficPlanner::drop_track(std::uint64_t track_id, Stamp now) {
  const auto known = standing_.find(track_id);
  if (known != standing_.end() && !known->second.lost) known->second.lost = now;
}

void TrafficPlanner::open_what_was_seen(Stamp now) {
  for (auto it = standing_.begin(); it != standing_.end();) {
    const std::optional<Stamp>& lost = it->second.lost;
    const std::optional<Stamp> seen = lost ? seen_.seen(it->second.disc.center_in_map) : std::nullopt;
    const bool is_over = lost && ((seen && *seen > *lost) || now - *lost > from_seconds(kLongestUnseenS));
    if (!is_over) {
      ++it;
      continue;
    }

    coordinator_->set_standing(track_name(it->first), {}, time::seconds(now));
    events_.push_back(fmt::format("track {} is gone", it->first));
    it = standing_.erase(it);
  }
}

void TrafficPlanner::take_over(Stamp now, const fleet::Claim& claim) {
  const bool after_another = claim.epoch > 1;
  claim_ = claim;
  if (after_another) goals_.take_over();
  has_gathered_ = has_gathered_ || after_another;
  began_ = now;

  for (auto& [agv_id, entry] : vehicles_) {
    entry.is_heard = entry.is_signed_off;
    entry.plan.reset();
    entry.planned_goal.clear();
    entry.grant = {};
  }

  coordinator_ = new_coordinator();
  for (const auto& [agv_id, entry] : vehicles_)
    if (entry.is_signed_off) tell_sign_off(agv_id, entry, now);
}

FleetOrders TrafficPlanner::step(Stamp now, const OutOfTime& out_of_time) {
  FleetOrders orders;
  out_of_time_ = out_of_time;
  if (!began_) began_ = now;

  std::optional<Plan> own = goals_.step(now, out_of_time);
  std::vector<std::string> own_events = goals_.take_events();
  is_busy_ = own.has_value();

  if (settings_.as_printed) {
    if (own) orders.plans.push_back(std::move(*own));
    events_.insert(events_.end(), own_events.begin(), own_events.end());
    return orders;
  }

  if (own) take_own_plan(std::move(*own), now, orders);

  // A vehicle that was not heard may still have road from another leader. Plans that know of all vehicles are better;
  // later on there are plans, and no road, and each vehicle is told for which one it waits.
  if (!are_all_heard() && now - *began_ < from_seconds(kHearAllS)) return orders;
  if (is_gathering(now)) return orders;

  open_what_was_seen(now);
  const traffic::Orders joint = coordinator_->step(time::seconds(now));
  is_busy_ = is_busy_ || coordinator_->is_busy();

  for (const traffic::Way& way : joint.ways) take_way(way, orders);
  for (const traffic::GrantedRoad& road : joint.grants) take_grant(road, now, orders);
  refresh(orders);
  events_.insert(events_.end(), joint.events.begin(), joint.events.end());

  return orders;
}

void TrafficPlanner::take_own_plan(Plan plan, Stamp now, FleetOrders& orders) {
  const auto known = vehicles_.find(plan.agv_id);
  if (known == vehicles_.end()) return;  // its goal was cancelled before its build was known

  Entry& entry = known->second;
  if (plan.goal_id == entry.reached_goal && !plan.is_cancelled()) return;  // looked at again, as the map changed

  if (plan.is_found()) {
    entry.planned_goal = plan.goal_id;
    coordinator_->set_goal(plan.agv_id, plan.goal_id, plan.goal_in_map, time::seconds(now));
    return;
  }

  entry.planned_goal.clear();
  coordinator_->set_goal(plan.agv_id, "", std::nullopt, time::seconds(now));

  plan.id = coordinator_->take_plan_id(plan.agv_id);
  events_.push_back(fmt::format("{}: plan {} to {} ({}): {}: {}", plan.agv_id, plan.id, plan.goal_id,
                                name(plan.trigger), name(plan.outcome), plan.detail));
  entry.plan = plan;
  orders.plans.push_back(std::move(plan));
}

void TrafficPlanner::take_way(const traffic::Way& way, FleetOrders& orders) {
  Entry& entry = vehicles_[way.agv_id];
  const Plan* own = goals_.plan_of(way.agv_id);
  const bool has_goal = own != nullptr && own->is_found() && !way.goal_id.empty() && own->goal_id == way.goal_id;

  Plan plan;
  plan.agv_id = way.agv_id;
  plan.id = way.plan_id;
  plan.goal_id = way.goal_id;
  plan.map_id = map_id_;
  plan.map_revision = map_revision_;

  const bool is_new_goal = !entry.plan || entry.plan->goal_id != way.goal_id;
  const bool is_taken_over = has_goal && own->trigger == PlanTrigger::kTakeover;
  plan.trigger = is_new_goal ? (is_taken_over ? PlanTrigger::kTakeover : PlanTrigger::kNewGoal)
                 : entry.plan->map_revision != map_revision_ ? PlanTrigger::kMapChanged
                                                             : PlanTrigger::kVehicleBlocked;
  if (has_goal) {
    plan.detail = own->detail;
    plan.goal_in_map = own->goal_in_map;
    plan.position_tolerance_m = own->position_tolerance_m;
    plan.yaw_tolerance_rad = own->yaw_tolerance_rad;
  } else {
    const Point2 end = way.waypoints_in_map.back();
    plan.goal_in_map = {end.x, end.y, 0.0};
  }

  plan.waypoints_in_map = way.waypoints_in_map;
  plan.length_m = length_m(way.waypoints_in_map);
  plan.first_step = way.first_step;
  plan.step_ends_m = way.step_ends_m;
  plan.headings_rad = way.headings_rad;
  plan.own_steps = way.own_steps;
  plan.tube_m = way.tube_m;

  events_.push_back(fmt::format("{}: plan {} to {} ({}): {:.2f} m, {} steps, {}", plan.agv_id, plan.id,
                                plan.goal_id.empty() ? "a place of rest" : plan.goal_id, name(plan.trigger),
                                plan.length_m, plan.step_ends_m.size(), way.own_or_roadmap));
  entry.plan = plan;
  orders.plans.push_back(std::move(plan));
}

void TrafficPlanner::refresh(FleetOrders& orders) {
  for (auto& [agv_id, entry] : vehicles_) {
    if (!entry.plan || !entry.plan->is_found() || entry.grant.gives_back) continue;

    Plan& plan = *entry.plan;
    if (plan.map_revision == map_revision_) continue;

    // Its goal is looked at first: it may have become one that cannot be reached.
    const Plan* own = goals_.plan_of(agv_id);
    if (own != nullptr && own->is_found() && own->map_revision != map_revision_) continue;

    plan.map_id = map_id_;
    plan.map_revision = map_revision_;
    orders.plans.push_back(plan);
  }
}

void TrafficPlanner::take_grant(const traffic::GrantedRoad& road, Stamp now, FleetOrders& orders) {
  Entry& entry = vehicles_[road.agv_id];
  const bool has_waited = !entry.grant.reason.empty() && entry.grant.limit_step == road.limit_step;

  fleet::Grant grant;
  grant.agv_id = road.agv_id;
  grant.number = road.number;
  grant.plan_id = road.plan_id;
  grant.limit_m = road.limit_m;
  grant.limit_step = road.limit_step;
  grant.gives_back = road.gives_back;
  grant.waits_for = road.waits_for;
  grant.reason = road.reason;

  if (!has_waited) entry.waits_since = now;
  entry.grant = grant;
  orders.grants.push_back(std::move(grant));
}

std::vector<Point2> TrafficPlanner::own_way(const std::string& agv_id, Point2 from_in_map, Point2 to_in_map) {
  // The way's shape is wider than what the search keeps free: past what stands by so much more.
  const traffic::Kind& kind = vehicles_.at(agv_id).kind;
  const double wider_m = std::max(0.0, kind.tube_m + traffic::Coordinator::Settings{}.gap_m - settings_.margin_m);
  std::vector<Disc> standing;
  for (const auto& [id, thing] : standing_)
    standing.push_back({thing.disc.center_in_map, thing.disc.radius_m + wider_m});

  // Where the way leads against a one-way zone, it is looked for again with that zone closed.
  std::vector<std::vector<Point2>> closed;
  for (std::size_t tries = 0; tries <= zones_.size(); ++tries) {
    std::vector<Point2> way = goals_.own_way(agv_id, from_in_map, to_in_map, standing, out_of_time_, closed);
    const std::size_t before = closed.size();
    for (const fleet::Zone& zone : zones_)
      if (traffic::goes_against(zone, way)) closed.push_back(fleet::corners_of(zone));
    if (closed.size() == before) return way;
  }

  return {};
}

fleet::TrafficStatus TrafficPlanner::status(Stamp now) const {
  fleet::TrafficStatus status;
  status.vehicles = static_cast<std::uint32_t>(vehicles_.size());
  status.refused = coordinator_->refused();
  status.circles = coordinator_->circles();

  for (const auto& [agv_id, entry] : vehicles_) {
    const bool has_goal = !entry.planned_goal.empty();
    if (has_goal) ++status.with_goal;

    const Stamp since = entry.navigation ? entry.navigation_arrived : began_.value_or(now);
    const bool is_silent = !entry.is_signed_off && now - since > from_seconds(kSilentS);
    if (entry.is_signed_off) {
      const geometry::Pose2 heard_at = last_pose(entry).value_or(geometry::Pose2{});
      status.signed_off.push_back({agv_id, entry.signed_off_at_in_map.value_or(heard_at.position())});
    }
    if (is_silent) status.silent.push_back({agv_id, last_pose(entry).value_or(geometry::Pose2{}).position()});

    if (!has_goal || entry.grant.reason.empty()) continue;
    status.waiting.push_back({agv_id, entry.grant.waits_for.empty() ? "" : entry.grant.waits_for.front(),
                              entry.grant.reason, time::seconds(now - entry.waits_since)});
  }

  for (const std::string& agv_id : expected_) status.silent.push_back({agv_id, {}});
  for (const std::string& agv_id : given_up_) status.signed_off.push_back({agv_id, {}});

  return status;
}

}  // namespace aisle::global_planner
