#include <algorithm>
#include <cmath>

#include "services/global-planner/core/traffic/coordinator.hpp"

namespace aisle::global_planner::traffic {
namespace {

using geometry::Point2;

constexpr double kBrakeShare = 0.7;  // of the deceleration, that road ahead is counted with
constexpr double kReactionS = 0.5;
constexpr double kStepM = 1.0;  // about a step's length: road is granted in whole steps

}  // namespace

/// A vehicle that was not heard yet: it may stand, and drive, anywhere. Empty: there is none.
std::string Coordinator::unheard() const {
  const auto found =
      std::find_if(vehicles_.begin(), vehicles_.end(), [](const auto& vehicle) { return !vehicle.second.is_heard; });
  if (found != vehicles_.end()) return found->first;

  return expected_.empty() ? std::string() : *expected_.begin();
}

/// Road to all who may have some. A pass serves each vehicle until it wants no more or has to wait.
void Coordinator::grant_all() {
  const std::string missing = unheard();
  const std::string wide = wide_one();

  for (auto& [id, vehicle] : vehicles_) {
    if (!vehicle.is_registered) continue;

    hold_end_of_grants(vehicle);
    vehicle.waits_for.clear();
    vehicle.reason.clear();

    if (!missing.empty()) {
      vehicle.waits_for = {missing};
      vehicle.reason = missing + " was not heard yet: it may be anywhere until it is, or is signed off";
      continue;
    }

    if (!wide.empty() && wide != id) {
      vehicle.waits_for = {wide};
      vehicle.reason = wide + " was alone, and has not come into its tube yet";
      continue;
    }

    while (grant_next(vehicle)) {
    }

    tell_reasons(vehicle);
  }
}

/// Is the road ahead shorter than what it takes to drive on without braking? Alone on the floor: as far as may be.
bool Coordinator::wants_road(const VehicleEntry& vehicle, const Agent& agent) const {
  const std::size_t granted = agent.pending();
  if (granted >= settings_.most_steps_ahead) return false;
  if (is_alone()) return true;

  double ahead = 0.0;
  for (std::size_t i = 0; i < granted; ++i) ahead += roadmap_.motion(agent.steps[i].motion).length_m;
  if (granted > 0) {
    const Point2 begin = roadmap_.place(agent.place).base_in_map.position();
    const double driven = geometry::distance(begin, vehicle.said.base_in_map.position());
    ahead -= std::min(driven, roadmap_.motion(agent.steps.front().motion).length_m);
  }

  const double v = vehicle.said.speed_mps;
  const double brakes = v * v / (2.0 * kBrakeShare * vehicle.kind.limits.max_deceleration_mps2);
  return ahead < std::max(settings_.least_ahead_m, brakes + v * (kReactionS + settings_.latency_s) + kStepM);
}

/// Does it stand, and will begin by driving elsewhere than its own way to its goal?
bool Coordinator::makes_way(const Agent& agent) const {
  return agent.pending() == 0 && !agent.steps.empty() && !agent.steps.front().is_own_way;
}

/// The next step, when its links are done and the lock admits its floor. False: no more for now.
bool Coordinator::grant_next(VehicleEntry& vehicle) {
  const Agent* agent = plans_.find(vehicle.id);
  const std::size_t granted = agent->pending();
  if (agent->is_frozen || vehicle.asked_back || granted >= agent->steps.size()) return false;
  if (!wants_road(vehicle, *agent)) return false;
  if (is_settling_ && makes_way(*agent)) return false;

  if (!vehicle.excepted.empty()) {
    vehicle.waits_for.assign(vehicle.excepted.begin(), vehicle.excepted.end());
    vehicle.reason = "too near to another";
    return false;
  }

  const Step& step = agent->steps[granted];
  if (!is_open(step.motion)) {
    vehicle.reason = "floor closed ahead";
    has_changed_ = true;
    return false;
  }

  if (!plans_.is_next_free(vehicle.id)) {
    vehicle.waits_for = plans_.next_waits_for(vehicle.id);
    vehicle.reason = "after another";
    return false;
  }

  const std::uint64_t number = agent->granted;
  if (!lock_.admit(vehicle.id, number, step.shape)) {
    vehicle.waits_for = lock_.holders(vehicle.id, step.shape);
    vehicle.reason = "floor held";

    // A forced shape counts apart: nobody planned it.
    const bool is_forced = std::any_of(vehicle.waits_for.begin(), vehicle.waits_for.end(), [&](const std::string& id) {
      const auto& held = lock_.held(id);
      const auto forced = held.find(Lock::kForced);
      return forced != held.end() && meet(forced->second, step.shape, settings_.gap_m);
    });

    if (!is_forced && vehicle.refused_step != number) {
      ++refused_;
      vehicle.refused_step = number;
      events_.push_back("fault: the lock refuses " + vehicle.id + " a step whose links are done, for " +
                        (vehicle.waits_for.empty() ? std::string("nobody") : vehicle.waits_for.front()));
    }

    return false;
  }

  plans_.grant_next(vehicle.id);
  hold_end_of_grants(vehicle);
  return true;
}

/// The place where its grants end stays held when the step to it is behind the vehicle. It is a part of that step's
/// floor, and kept whatever has been forced upon it since. A body that was forced ends as soon as it is held so.
void Coordinator::hold_end_of_grants(VehicleEntry& vehicle) {
  const Agent* agent = plans_.find(vehicle.id);
  const auto& held = lock_.held(vehicle.id);

  if (held.find(agent->granted) == held.end()) {
    const Shape& standing = roadmap_.place(end_of_grants(*agent)).standing;
    const bool is_held =
        lock_.keep(vehicle.id, agent->granted, standing) || lock_.admit(vehicle.id, agent->granted, standing);
    if (!is_held) return;
  }

  if (vehicle.lead_in.path_in_map.empty() && !vehicle.is_off_road) lock_.force(vehicle.id, Shape());
}

/// Why it has no (more) road, in words.
void Coordinator::tell_reasons(VehicleEntry& vehicle) {
  const Agent* agent = plans_.find(vehicle.id);
  if (!vehicle.goal_in_map || agent->has_plan_to_goal || !vehicle.reason.empty()) return;

  vehicle.waits_for = agent->waits_for;
  vehicle.reason = agent->goal == kNoId ? "no way in the map" : agent->reason.empty() ? "no way free" : agent->reason;
  if (!vehicle.waits_for.empty()) return;

  // What is closed may be the only way: those that are silent are named.
  for (const auto& [id, other] : vehicles_) {
    if (!other.is_silent || id == vehicle.id) continue;

    vehicle.waits_for.push_back(id);
    vehicle.reason = "no way past dead " + id;
  }
}

Way Coordinator::way_of(const VehicleEntry& vehicle, const Agent& agent) const {
  Way way;
  way.agv_id = vehicle.id;
  way.first_step = agent.done;
  way.leads_to_goal = agent.has_plan_to_goal;
  way.goal_id = vehicle.goal_id;

  double along = 0.0;
  const auto append = [&](Point2 point) {
    if (!way.waypoints_in_map.empty()) along += geometry::distance(way.waypoints_in_map.back(), point);
    way.waypoints_in_map.push_back(point);
  };

  const bool has_lead_in = !vehicle.lead_in.path_in_map.empty();
  if (has_lead_in || vehicle.behind) {
    const LeadIn& before = has_lead_in ? vehicle.lead_in : *vehicle.behind;
    way.first_step = before.first_step;
    way.headings_rad = before.headings_rad;
    way.step_ends_m = before.step_ends_m;
    way.own_steps.assign(way.step_ends_m.size(), has_lead_in ? 0 : vehicle.is_behind_own ? 1 : 0);
    for (const Point2 point : before.path_in_map) append(point);
  }

  if (agent.steps.empty() && way.waypoints_in_map.empty()) append(roadmap_.place(agent.place).base_in_map.position());

  bool has_own = false, has_roadmap = false;
  for (const Step& step : agent.steps) {
    const Motion& motion = roadmap_.motion(step.motion);
    const std::size_t skipped = way.waypoints_in_map.empty() ? 0 : 1;  // it begins where the last one ended

    for (std::size_t i = skipped; i < motion.path_in_map.size(); ++i) append(motion.path_in_map[i]);
    for (std::size_t i = skipped; i < motion.headings_rad.size(); ++i)
      way.headings_rad.push_back(motion.headings_rad[i]);

    way.step_ends_m.push_back(along);
    way.own_steps.push_back(step.is_own_way ? 1 : 0);
    (step.is_own_way ? has_own : has_roadmap) = true;
  }

  way.tube_m = tube_m(vehicle);
  way.own_or_roadmap = has_own && has_roadmap ? "own way, roadmap" : has_own ? "own way" : "roadmap";
  return way;
}

/// Sends the way anew when its steps have changed.
void Coordinator::tell_way(VehicleEntry& vehicle, Orders& orders) {
  const Agent* agent = plans_.find(vehicle.id);

  // The motions that were sent, from the step that the agent is in.
  const std::uint64_t first_sent = vehicle.way.first_step + vehicle.way.step_ends_m.size() - vehicle.sent.size();
  bool is_same = !vehicle.way.waypoints_in_map.empty() && agent->done >= first_sent &&
                 vehicle.sent.size() == agent->done - first_sent + agent->steps.size();

  for (std::size_t i = 0; is_same && i < agent->steps.size(); ++i)
    is_same = vehicle.sent[agent->done - first_sent + i] == agent->steps[i].motion;

  // A vehicle that is at its goal already gets a way of one point, so that it hears of the goal.
  const bool is_other_goal = agent->has_plan_to_goal && vehicle.way.goal_id != vehicle.goal_id;
  const bool has_nothing = agent->steps.empty() && vehicle.lead_in.path_in_map.empty();
  const bool is_other_tube = vehicle.way.tube_m != tube_m(vehicle);
  const bool is_new = (is_other_goal || ((!is_same || is_other_tube) && !has_nothing)) && !vehicle.asked_back;

  if (is_new) {
    vehicle.way = way_of(vehicle, *agent);
    vehicle.way.plan_id = vehicle.next_plan_id++;
    if (is_alone()) vehicle.newest_wide_plan = vehicle.way.plan_id;
    vehicle.sent.clear();
    for (const Step& step : agent->steps) vehicle.sent.push_back(step.motion);
    orders.ways.push_back(vehicle.way);
  }

  tell_grant(vehicle, is_new, orders);
}

double Coordinator::limit_on_way_m(const VehicleEntry& vehicle, std::uint64_t limit_step) const {
  const Way& way = vehicle.way;
  if (limit_step <= way.first_step || way.step_ends_m.empty()) return 0.0;
  return way.step_ends_m[std::min<std::size_t>(limit_step - way.first_step, way.step_ends_m.size()) - 1];
}

void Coordinator::tell_grant(VehicleEntry& vehicle, bool is_new_way, Orders& orders) {
  const Agent* agent = plans_.find(vehicle.id);
  GrantedRoad grant;
  grant.agv_id = vehicle.id;
  grant.plan_id = vehicle.way.plan_id;
  grant.gives_back = vehicle.asked_back.has_value();
  grant.limit_step = vehicle.asked_back ? vehicle.asked_back->limit_step : agent->granted;
  grant.limit_m = limit_on_way_m(vehicle, grant.limit_step);
  grant.waits_for = vehicle.waits_for;
  grant.reason = vehicle.reason;
  std::sort(grant.waits_for.begin(), grant.waits_for.end());
  grant.waits_for.erase(std::unique(grant.waits_for.begin(), grant.waits_for.end()), grant.waits_for.end());

  const GrantedRoad& told = vehicle.told;
  const bool is_asked_anew = vehicle.asked_back && vehicle.asked_back->number == 0;
  const bool is_same = !is_new_way && !is_asked_anew && told.number > 0 && told.limit_step == grant.limit_step &&
                       told.gives_back == grant.gives_back && told.waits_for == grant.waits_for &&
                       told.reason == grant.reason;
  if (is_same) return;

  grant.number = vehicle.next_grant++;
  if (vehicle.asked_back && vehicle.asked_back->number == 0) vehicle.asked_back->number = grant.number;

  vehicle.told = grant;
  orders.grants.push_back(grant);
}

}  // namespace aisle::global_planner::traffic
