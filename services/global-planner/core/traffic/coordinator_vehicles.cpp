#include <algorithm>
#include <cmath>
#include <utility>

#include "services/global-planner/core/traffic/coordinator.hpp"

namespace aisle::global_planner::traffic {
namespace {

using geometry::Point2;
using geometry::Pose2;

constexpr double kRegisterS = 0.5;  // between two tries
constexpr double kSamePlaceM = 0.02;
constexpr double kStandsMps = 0.02;
constexpr double kLongestEscapeM = 4.0;

double length_m(const std::vector<Point2>& path) {
  double sum = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) sum += geometry::distance(path[i - 1], path[i]);
  return sum;
}

/// Of a local planner that drives no plan with steps.
bool says_no_road(const Report& report) { return report.limit_step == 0 && report.held.empty(); }

}  // namespace

void Coordinator::set_vehicle(const std::string& agv_id, const Kind& kind) {
  expected_.erase(agv_id);
  VehicleEntry& vehicle = vehicles_[agv_id];
  if (vehicle.id == agv_id && vehicle.kind == kind) return;

  const bool was_known = !vehicle.id.empty();
  vehicle.id = agv_id;
  vehicle.kind = kind;
  vehicle.kind_id = roadmap_.kind(kind);

  // Another build: it is planned anew from where it stands.
  if (was_known && vehicle.is_registered) {
    plans_.remove(agv_id);
    vehicle.is_registered = false;
  }
}

void Coordinator::expect(const std::string& agv_id) {
  if (vehicles_.count(agv_id) == 0) expected_.insert(agv_id);
}

void Coordinator::hear(const Report& report, double now_s) {
  const auto found = vehicles_.find(report.agv_id);
  if (found == vehicles_.end()) return;

  VehicleEntry& vehicle = found->second;
  const bool is_behind = vehicle.is_heard && report.step_done < vehicle.said.step_done;
  const bool is_restarted = vehicle.is_heard && report.boot_id != vehicle.said.boot_id;
  if (is_behind && !is_restarted) return;  // overtaken by a later one
  if (is_restarted && (is_behind || says_no_road(report))) return hear_restarted(vehicle, report, now_s);

  const std::uint64_t answered = vehicle.said.grant_number;
  const bool has_others_grant = report.is_others_grant || report.grant_number >= vehicle.next_grant;

  vehicle.said = report;
  vehicle.said.grant_number = report.is_others_grant ? answered : std::max(answered, report.grant_number);
  vehicle.heard_s = now_s;
  vehicle.is_heard = true;
  vehicle.next_plan_id = std::max(vehicle.next_plan_id, report.plan_id + 1);
  vehicle.next_grant = std::max(vehicle.next_grant, report.grant_number + 1);

  const bool was_signed_off = std::exchange(vehicle.is_signed_off, false);
  if (!vehicle.is_registered) return;

  if (was_signed_off) {
    events_.push_back(vehicle.id + " was signed off, and is heard again");
    take_in_anew(vehicle, now_s);
    return;
  }

  // It has road that this leader never gave: it was told by an earlier one. An old word of road that it has given back
  // since names a grant of this leader.
  if (has_others_grant && report.limit_step > plans_.find(vehicle.id)->granted) {
    events_.push_back(vehicle.id + " has road from an earlier leader");
    take_in_anew(vehicle, now_s);
    return;
  }

  hear_again(vehicle, now_s);
  hear_progress(vehicle, now_s);
  hear_answer(vehicle, now_s);
  end_exceptions(vehicle);
}

/// A silent vehicle speaks: it is planned for again.
void Coordinator::hear_again(VehicleEntry& vehicle, double now_s) {
  if (!std::exchange(vehicle.is_silent, false)) return;

  plans_.unfreeze(vehicle.id, now_s);
  open("dead " + vehicle.id);
  events_.push_back(vehicle.id + " is heard again");
}

/// Its local planner has started again and knows nothing yet of a plan without road, the newest that it was told? Then
/// no road that it was given before can reach it any more.
bool Coordinator::has_forgotten_its_road(const VehicleEntry& vehicle, const Report& report) const {
  return says_no_road(report) && report.plan_id + 1 == vehicle.next_plan_id && report.plan_id != vehicle.way.plan_id;
}

/// Its local planner has started again: it has not found its step yet on the plan that it was told, or it has the plan
/// that ended its road. Until it says more, all that it holds stays held; it is no silent vehicle.
void Coordinator::hear_restarted(VehicleEntry& vehicle, const Report& report, double now_s) {
  vehicle.heard_s = now_s;
  vehicle.said.base_in_map = report.base_in_map;
  vehicle.said.speed_mps = report.speed_mps;
  if (!vehicle.is_registered) return;

  vehicle.is_signed_off = false;
  hear_again(vehicle, now_s);
  if (!has_forgotten_its_road(vehicle, report)) return;

  // Numbers that were given out are not used again.
  const std::uint64_t step = plans_.find(vehicle.id)->granted, answered = vehicle.said.grant_number;
  vehicle.said = report;
  vehicle.said.step_done = vehicle.said.limit_step = step;
  vehicle.said.grant_number = answered;
  events_.push_back(vehicle.id + " has started again, without road");
  take_in_anew(vehicle, now_s);
}

/// What was held for the vehicle ends, and what its newest word says is held.
void Coordinator::take_in_anew(VehicleEntry& vehicle, double now_s) {
  for (const std::string& other : vehicle.excepted) vehicles_.at(other).excepted.erase(vehicle.id);
  vehicle.excepted.clear();
  vehicle.lead_in = {};
  vehicle.asked_back.reset();
  vehicle.is_off_road = false;
  vehicle.is_silent = false;
  open("dead " + vehicle.id);
  open("before " + vehicle.id);
  lock_.forget(vehicle.id);

  vehicle.is_registered = false;
  vehicle.registering_s = -1e9;
  register_vehicle(vehicle, now_s);
}

/// Frees what lies behind the vehicle. Where it stands at the end of its grants it goes on holding that place.
void Coordinator::hear_progress(VehicleEntry& vehicle, double now_s) {
  Agent* agent = plans_.find(vehicle.id);
  if (agent == nullptr) return;

  const std::uint64_t done = std::min(vehicle.said.step_done, agent->granted);

  if (!vehicle.lead_in.path_in_map.empty()) {
    const std::uint64_t behind = vehicle.lead_in.first_step + vehicle.lead_in.step_ends_m.size();
    if (done < behind) return;

    vehicle.lead_in = {};
    if (!vehicle.is_off_road) lock_.force(vehicle.id, Shape());
  }

  if (done <= agent->done) return;

  const Step& last = agent->steps[done - 1 - agent->done];
  const Motion& behind = roadmap_.motion(last.motion);
  vehicle.is_behind_own = last.is_own_way;
  vehicle.behind = LeadIn{behind.path_in_map, behind.headings_rad, {behind.length_m}, done - 1};

  plans_.report(vehicle.id, done, now_s);
  lock_.release(vehicle.id, done);
}

/// Only a status that obeys the grant which asked, or a later one, answers.
void Coordinator::hear_answer(VehicleEntry& vehicle, double now_s) {
  if (!vehicle.asked_back || vehicle.asked_back->number == 0) return;
  if (vehicle.said.grant_number < vehicle.asked_back->number) return;

  Agent* agent = plans_.find(vehicle.id);
  const std::uint64_t limit = std::max(vehicle.said.limit_step, agent->done);
  const bool stands = vehicle.said.speed_mps < kStandsMps;

  // Within a step it keeps that step's floor until it has come to a stand.
  const bool gives_back_its_step = limit == agent->done && agent->granted > agent->done;
  if (gives_back_its_step && !stands) return;

  vehicle.asked_back.reset();
  if (!vehicle.lead_in.path_in_map.empty()) {
    if (stands && vehicle.said.limit_step == vehicle.said.step_done) rebase(vehicle, now_s);
  } else if (gives_back_its_step) {
    rebase(vehicle, now_s);
  } else if (limit < agent->granted) {
    lock_.give_back(vehicle.id, limit);
    plans_.give_back(vehicle.id, limit, now_s);
    hold_end_of_grants(vehicle);
  }

  vehicle.tried_s = -1e9;
  has_changed_ = true;
}

/// The vehicle stands within a step, or within its lead-in, and gives the rest of it back: from now on it is planned
/// from where it is.
void Coordinator::rebase(VehicleEntry& vehicle, double now_s) {
  Agent* agent = plans_.find(vehicle.id);
  const bool has_lead_in = !vehicle.lead_in.path_in_map.empty();
  const std::uint64_t step = has_lead_in ? vehicle.said.step_done : agent->done;
  const Shape body = roadmap_.zones().held(standing_shape(vehicle.kind, vehicle.said.base_in_map));

  const PlaceId place = roadmap_.temporary_place(vehicle.kind_id, vehicle.said.base_in_map);
  if (place == kNoId) return;  // it keeps the step, and is asked again

  lock_.force(vehicle.id, body);
  lock_.give_back(vehicle.id, step);
  vehicle.lead_in = {};
  vehicle.is_off_road = false;
  place_agent(vehicle, place, step, now_s);
  hold_end_of_grants(vehicle);
}

/// Makes the agent anew at the place, with the given number of the next step.
void Coordinator::place_agent(VehicleEntry& vehicle, PlaceId place, std::uint64_t step, double now_s) {
  plans_.add(vehicle.id, vehicle.kind_id, place, vehicle.said.base_in_map.yaw, now_s, step);
  vehicle.is_registered = true;
  vehicle.without_plan_s = now_s;
  vehicle.tried_s = -1e9;
  vehicle.sent.clear();
  vehicle.behind.reset();
  set_agent_goal(vehicle, now_s);
  plans_changed();
}

/// Its body is held at once. A vehicle that still has road from an earlier leader keeps it, and is planned from its
/// end.
void Coordinator::register_vehicle(VehicleEntry& vehicle, double now_s) {
  if (!vehicle.is_heard || !has_map_ || now_s < vehicle.registering_s + kRegisterS) return;

  vehicle.registering_s = now_s;
  const Report& said = vehicle.said;
  const std::uint64_t step = std::max(said.step_done, said.limit_step);

  LeadIn lead_in;
  lead_in.first_step = said.step_done;
  for (const HeldPose& pose : said.held) {
    if (!lead_in.path_in_map.empty() &&
        geometry::distance(lead_in.path_in_map.back(), pose.base_in_map.position()) < 1e-6)
      continue;

    lead_in.path_in_map.push_back(pose.base_in_map.position());
    if (!vehicle.kind.turns_on_the_spot()) lead_in.headings_rad.push_back(pose.base_in_map.yaw);
  }

  const bool has_road = step > said.step_done && lead_in.path_in_map.size() > 1;
  if (has_road) {
    // All its steps end where its road ends, but for those whose end its word tells.
    lead_in.step_ends_m.assign(step - said.step_done, length_m(lead_in.path_in_map));
    double along = 0.0;
    for (std::size_t i = 1; i < said.held.size(); ++i) {
      along += geometry::distance(said.held[i - 1].base_in_map.position(), said.held[i].base_in_map.position());
      if (said.held[i].step >= said.step_done && said.held[i].step < step)
        lead_in.step_ends_m[said.held[i].step - said.step_done] = along;
    }
  }

  Shape body = standing_shape(vehicle.kind, said.base_in_map);
  const Pose2 end = has_road ? said.held.back().base_in_map : said.base_in_map;
  if (has_road) body.add(swept_shape(vehicle.kind, lead_in.path_in_map, lead_in.headings_rad));
  body = roadmap_.zones().held(std::move(body));

  lock_.force(vehicle.id, body);
  ask_back_around(vehicle, body, now_s);
  const PlaceId place = roadmap_.temporary_place(vehicle.kind_id, end);
  if (place == kNoId) return;

  const Shape standing = roadmap_.zones().held(standing_shape(vehicle.kind, end));
  const std::vector<std::string> near = lock_.holders(vehicle.id, standing);
  if (!near.empty()) {
    vehicle.excepted.insert(near.begin(), near.end());
    for (const std::string& other : near) {
      lock_.except(vehicle.id, other);
      vehicles_.at(other).excepted.insert(vehicle.id);
    }
  }

  lock_.admit(vehicle.id, step, standing);
  place_agent(vehicle, place, step, now_s);
  if (has_road) {
    vehicle.lead_in = lead_in;
  } else {
    lock_.force(vehicle.id, Shape());
  }

  if (!vehicle.is_signed_off) events_.push_back(vehicle.id + " takes part in the traffic");
}

/// Road that others were granted before the newcomer was heard, or before a body left its road, and that meets what it
/// holds, is asked back.
void Coordinator::ask_back_around(const VehicleEntry& newcomer, const Shape& body, double now_s) {
  for (const std::string& id : lock_.holders(newcomer.id, body)) {
    const Agent* agent = plans_.find(id);
    if (agent == nullptr) continue;

    for (std::size_t i = 0; i < agent->pending(); ++i) {
      if (!meet(agent->steps[i].shape, body, settings_.gap_m)) continue;

      ask_back(vehicles_.at(id), agent->done + i, now_s);
      break;
    }
  }
}

/// A vehicle that began too near to others drives, straight and never nearer to them, to a place that is free of all.
bool Coordinator::escape(VehicleEntry& vehicle, double now_s) {
  const Pose2 from = vehicle.said.base_in_map;
  const Agent* agent = plans_.find(vehicle.id);
  double shortest = kLongestEscapeM;
  PlaceId best = kNoId;

  const auto keeps_away = [&](Point2 to) {
    return std::all_of(vehicle.excepted.begin(), vehicle.excepted.end(), [&](const std::string& other) {
      const Point2 there = vehicles_.at(other).said.base_in_map.position();
      return geometry::distance_to_segment(there, from.position(), to) >
             geometry::distance(there, from.position()) - kSamePlaceM;
    });
  };

  const auto is_free_of_all = [&](const Place& place) {
    for (const auto& [id, other] : vehicles_) {
      if (id == vehicle.id) continue;
      for (const auto& [step, shape] : lock_.held(id))
        if (meet(shape, place.standing, settings_.gap_m)) return false;
    }
    return true;
  };

  for (const MotionId leaving : roadmap_.place(agent->place).leaving) {
    const Motion& motion = roadmap_.motion(leaving);
    const Place& place = roadmap_.place(motion.to);
    if (motion.length_m >= shortest || !is_open(leaving)) continue;
    if (!keeps_away(place.base_in_map.position()) || !is_free_of_all(place)) continue;
    if (!lock_.holders(vehicle.id, motion.shape).empty()) continue;

    shortest = motion.length_m;
    best = leaving;
  }

  if (best == kNoId) return false;

  const Motion motion = roadmap_.motion(best);
  const std::uint64_t step = agent->granted;
  LeadIn lead_in{motion.path_in_map, motion.headings_rad, {motion.length_m}, step};
  lock_.force(vehicle.id, motion.shape);
  lock_.give_back(vehicle.id, step);
  place_agent(vehicle, motion.to, step + 1, now_s);
  lock_.admit(vehicle.id, step + 1, roadmap_.place(motion.to).standing);
  vehicle.lead_in = lead_in;
  events_.push_back(vehicle.id + " leaves a spot too near to another");
  return true;
}

/// While two are too near to each other, one of them leaves and the other holds. First both have given back what road
/// they were asked for.
void Coordinator::part_near_ones(double now_s) {
  const auto is_driving = [](const VehicleEntry& vehicle) {
    return !vehicle.lead_in.path_in_map.empty() || vehicle.asked_back.has_value();
  };

  for (auto& [id, vehicle] : vehicles_) {
    if (vehicle.excepted.empty() || now_s < vehicle.registering_s + kRegisterS) continue;

    const bool is_parting =
        is_driving(vehicle) || std::any_of(vehicle.excepted.begin(), vehicle.excepted.end(),
                                           [&](const std::string& other) { return is_driving(vehicles_.at(other)); });

    vehicle.registering_s = now_s;
    if (!is_parting) escape(vehicle, now_s);
  }
}

/// They count again as soon as nothing that the two hold meets.
void Coordinator::end_exceptions(VehicleEntry& vehicle) {
  for (auto it = vehicle.excepted.begin(); it != vehicle.excepted.end();) {
    bool is_near = false;
    for (const auto& [step, mine] : lock_.held(vehicle.id))
      for (const auto& [other_step, shape] : lock_.held(*it)) is_near = is_near || meet(mine, shape, settings_.gap_m);

    if (is_near) {
      ++it;
      continue;
    }

    lock_.end_exception(vehicle.id, *it);
    vehicles_.at(*it).excepted.erase(vehicle.id);
    it = vehicle.excepted.erase(it);
  }
}

/// A vehicle that is not heard keeps what it holds; others are planned round it.
void Coordinator::look_for_silence(double now_s) {
  for (auto& [id, vehicle] : vehicles_) {
    if (!vehicle.is_registered || vehicle.is_silent || now_s <= vehicle.heard_s + settings_.silent_s) continue;

    vehicle.is_silent = true;
    if (!vehicle.is_signed_off) events_.push_back(id + " is silent");

    for (const std::string& other : plans_.freeze(id, now_s)) vehicles_.at(other).tried_s = -1e9;

    Shape held;
    for (const auto& [step, shape] : lock_.held(id)) held.add(shape);
    close("dead " + id, held, now_s);
  }
}

void Coordinator::sign_off(const std::string& agv_id, const std::optional<Point2>& place_in_map,
                           const std::optional<Report>& last_word, double now_s) {
  expected_.erase(agv_id);
  const auto found = vehicles_.find(agv_id);
  if (found == vehicles_.end()) return;

  VehicleEntry& vehicle = found->second;
  if (vehicle.is_heard && !vehicle.is_signed_off && now_s <= vehicle.heard_s + settings_.silent_s) {
    events_.push_back(agv_id + " is heard, and was not signed off");
    return;
  }

  if (!vehicle.is_signed_off) events_.push_back(agv_id + " is signed off");
  if (!vehicle.is_registered && !place_in_map && !last_word) {
    remove_vehicle(vehicle);
    return;
  }

  vehicle.is_signed_off = true;
  vehicle.heard_s = -1e9;

  if (!vehicle.is_registered || place_in_map) {
    if (!vehicle.is_registered && last_word) vehicle.said = *last_word;
    vehicle.said.is_blocked = false;
    vehicle.is_heard = true;
    if (place_in_map) {
      stand_at(vehicle, *place_in_map, now_s);
    } else {
      take_in_anew(vehicle, now_s);
    }
  }

  look_for_silence(now_s);
}

/// It holds its place there, whatever its heading, and nothing else.
void Coordinator::stand_at(VehicleEntry& vehicle, Point2 place_in_map, double now_s) {
  Report& said = vehicle.said;
  said.base_in_map = {place_in_map.x, place_in_map.y, said.base_in_map.yaw};
  said.speed_mps = 0.0;
  said.limit_step = said.step_done;
  said.held.clear();
  take_in_anew(vehicle, now_s);

  const double reach_m = geometry::reach_m(vehicle.kind.footprint) + vehicle.kind.tube_m;
  lock_.force(vehicle.id, Shape({Capsule{place_in_map, place_in_map, reach_m}}));
  vehicle.is_off_road = true;
}

/// Nothing is kept of it.
void Coordinator::remove_vehicle(VehicleEntry& vehicle) {
  const std::string agv_id = vehicle.id;
  for (const std::string& other : vehicle.excepted) vehicles_.at(other).excepted.erase(agv_id);
  plans_.remove(agv_id);

  lock_.forget(agv_id);
  open("dead " + agv_id);
  open("before " + agv_id);
  vehicles_.erase(agv_id);
}

}  // namespace aisle::global_planner::traffic
