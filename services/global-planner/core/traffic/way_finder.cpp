#include "services/global-planner/core/traffic/way_finder.hpp"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace aisle::global_planner::traffic {
namespace {

// A way over others' rests is taken only if it ends so much sooner.
constexpr double kWorthAskingS = 1.0;

// A plan gives way to one by the roadmap only if that ends so much sooner.
constexpr double kWorthChangingS = 0.5;

// A way without a detour is taken if it ends no more than this later. Detours are looked for over so many steps.
constexpr double kWorthADetourS = 0.5;
constexpr std::size_t kLongestDetour = 6;

// Those in the way of those in the way, and so on, so many times.
constexpr std::size_t kMostAskedInTurn = 6;

// A queue stands so far from the mouth of its goal, in seconds of driving alone, and no farther than that.
constexpr double kQueueFromS = 3.0;
constexpr double kQueueToS = 30.0;

}  // namespace

/// A cut of an own way is joined with the places around it when a new way may begin there.
Departure WayFinder::departure(const Agent& agent, double now_s) {
  const Departure out = timetable_.departure(agent, now_s);
  const Place& place = roadmap_.place(out.place);
  if (place.is_temporary) roadmap_.temporary_place(place.kind, place.base_in_map);
  return out;
}

View WayFinder::view_of(const Agent& agent, double now_s, double soft_rest_s) const {
  View view;
  view.agent = agent.number;
  view.soft_rest_s = soft_rest_s;
  view.now_s = now_s;
  return view;
}

std::vector<MotionId> WayFinder::own_way_left(const Agent& agent) const {
  const auto found = own_ways_.find(agent.id);
  if (found == own_ways_.end()) return {};

  const PlaceId here = timetable_.granted_end(agent);
  const auto next = std::find_if(found->second.begin(), found->second.end(),
                                 [&](MotionId id) { return roadmap_.motion(id).from == here; });
  return {next, found->second.end()};
}

void WayFinder::remember_own_way(const Agent& agent, std::vector<MotionId> motions) {
  own_ways_[agent.id] = std::move(motions);
}

/// The own way if it ends at most `terms.own_way_bonus_s` later than the roadmap's.
std::optional<WayFinder::Choice> WayFinder::choose(const Agent& agent, const View& view, const Terms& terms) {
  const Departure from = departure(agent, view.now_s);
  const auto choice = [&](std::optional<std::vector<Leg>> legs, bool is_own_way) -> std::optional<Choice> {
    if (!legs) return std::nullopt;
    const double end_s = legs->empty() ? from.time_s : legs->back().end_s;
    return Choice{std::move(*legs), is_own_way, end_s};
  };

  auto found = search_.find(from, {agent.goal, {}}, view);
  if (found) leave_out_detours(from, view, *found);

  const auto road = choice(std::move(found), false);
  const std::vector<MotionId> motions = terms.is_roadmap_only ? std::vector<MotionId>{} : own_way_left(agent);
  if (motions.empty() || roadmap_.motion(motions.back()).to != agent.goal) return road;

  auto own = choice(search_.time(from, motions, view), true);
  return own && (!road || own->end_s <= road->end_s + terms.own_way_bonus_s) ? own : road;
}

/// Where a vehicle has to wait, driving to and fro may bring it a moment sooner to where it wants to go: it waits
/// instead.
///
/// How: from each place of the way the farthest place of it, a few steps on, is looked for that is one motion away, or
/// is the same place. Without the steps between them the way is timed anew.
void WayFinder::leave_out_detours(const Departure& from, const View& view, std::vector<Leg>& legs) {
  for (std::size_t i = 0; i + 1 < legs.size(); ++i) {
    const PlaceId here = roadmap_.motion(legs[i].motion).from;
    const std::size_t last = std::min(i + kLongestDetour, legs.size() - 1);

    for (std::size_t j = last; j > i; --j) {
      const PlaceId there = roadmap_.motion(legs[j].motion).to;
      const MotionId direct = here == there ? kNoId : motion_between(here, there);
      if (here != there && direct == kNoId) continue;

      std::vector<MotionId> motions;
      for (std::size_t k = 0; k < i; ++k) motions.push_back(legs[k].motion);
      if (direct != kNoId) motions.push_back(direct);
      for (std::size_t k = j + 1; k < legs.size(); ++k) motions.push_back(legs[k].motion);

      auto timed = motions.empty() ? std::nullopt : search_.time(from, motions, view);
      if (!timed || timed->back().end_s > legs.back().end_s + kWorthADetourS) continue;

      legs = std::move(*timed);
      break;
    }
  }
}

/// The shortest open one.
MotionId WayFinder::motion_between(PlaceId from, PlaceId to) const {
  MotionId best = kNoId;
  for (const MotionId id : roadmap_.place(from).leaving) {
    const Motion& motion = roadmap_.motion(id);
    if (motion.to != to || !SpaceTimeSearch::may_drive(motion, roadmap_.place(from), roadmap_.place(to))) continue;
    if (best == kNoId || motion.length_m < roadmap_.motion(best).length_m) best = id;
  }

  return best;
}

double WayFinder::alone_s(const Agent& agent) { return search_.alone_s(timetable_.granted_end(agent), agent.goal); }

bool WayFinder::go(Agent& agent, double now_s, const Terms& terms) {
  auto best = choose(agent, view_of(agent, now_s, kForEver), terms);
  const double start_s = departure(agent, now_s).time_s;
  const bool is_late = best && best->end_s - start_s > 1.5 * alone_s(agent) + settings_.late_s;

  if (!best || is_late) {
    auto over_rests = choose(agent, view_of(agent, now_s, terms.soft_rest_s), terms);
    if (over_rests && (!best || over_rests->end_s + kWorthAskingS < best->end_s)) best = std::move(over_rests);
  }
  if (!best || best->end_s > terms.latest_end_s - (best->is_own_way ? 0.0 : kWorthChangingS)) return false;

  timetable_.replace_tail(agent, best->legs, best->is_own_way);
  return true;
}

bool WayFinder::go_own_way(Agent& agent, double now_s, double latest_end_s) {
  const std::vector<MotionId> motions = own_way_left(agent);
  if (motions.empty() || roadmap_.motion(motions.back()).to != agent.goal) return false;

  const auto legs = search_.time(departure(agent, now_s), motions, view_of(agent, now_s, kForEver));
  if (!legs || legs->back().end_s > latest_end_s) return false;

  timetable_.replace_tail(agent, *legs, true);
  return true;
}

/// May the vehicle stand there without being in the way?
bool WayFinder::is_spare(const Agent& agent, PlaceId place, Rest rest) const {
  const Place& here = roadmap_.place(place);
  if (here.is_closed || here.is_temporary) return false;
  if (rest != Rest::kAny && (!here.may_rest || here.corridor != kNoId)) return false;
  if (rest == Rest::kParking && !roadmap_.zones().is_parking(here.base_in_map.position())) return false;

  for (const auto& [id, other] : timetable_.agents()) {
    if (other.number == agent.number || other.goal == kNoId) continue;
    if (other.goal == place || meet(here.standing, roadmap_.place(other.goal).standing, settings_.gap_m)) return false;
  }
  return true;
}

bool WayFinder::find_rest(Agent& agent, double now_s, const Terms& terms, Rest rest) {
  const Departure from = departure(agent, now_s);
  const Destination to{kNoId, [&](PlaceId place) { return is_spare(agent, place, rest); }};
  for (const double soft_rest_s : {kForEver, terms.soft_rest_s}) {
    const auto legs = search_.find(from, to, view_of(agent, now_s, soft_rest_s));
    if (!legs) continue;
    timetable_.replace_tail(agent, *legs, false);
    return true;
  }
  return false;
}

bool WayFinder::leave(Agent& agent, double now_s, const Terms& terms) {
  if (agent.pending() == agent.steps.size()) {
    const double arrival_s = departure(agent, now_s).time_s;
    if (search_.is_free_for_ever(timetable_.granted_end(agent), arrival_s, view_of(agent, now_s, kForEver)))
      return true;
  }
  if (roadmap_.zones().has_parking() && find_rest(agent, now_s, terms, Rest::kParking)) return true;
  return find_rest(agent, now_s, terms, Rest::kStrict) || find_rest(agent, now_s, terms, Rest::kAny);
}

bool WayFinder::go_or_leave(Agent& agent, double now_s, const Terms& terms) {
  if (agent.is_frozen) return false;
  if (agent.goal != kNoId && ahead_in_queue(agent) == nullptr && go(agent, now_s, terms)) return true;
  return leave(agent, now_s, terms);
}

bool WayFinder::clear(const Agent& agent, double now_s, const Terms& terms, std::size_t depth) {
  std::set<std::uint32_t> resters;
  for (std::size_t i = agent.pending(); i < agent.steps.size(); ++i)
    for (const Link& link : agent.steps[i].links) {
      const Agent* other = timetable_.at(link.agent);
      if (other != nullptr && link.step >= other->beyond()) resters.insert(other->number);
    }

  bool can_all = true;
  for (const std::uint32_t number : resters) {
    Agent& rester = *timetable_.at(number);
    if (rester.has_plan_to_goal) continue;  // it leaves when it has been there
    if (depth == 0 || !go_or_leave(rester, now_s, terms))
      can_all = false;
    else
      can_all = clear(rester, now_s, terms, depth - 1) && can_all;
  }
  return can_all;
}

bool WayFinder::clear_way_of(const Agent& agent, double now_s, const Terms& terms) {
  return clear(agent, now_s, terms, kMostAskedInTurn);
}

/// How: on open floor goals that only meet are no queue: the second one arrives when the first has left.
const Agent* WayFinder::ahead_in_queue(const Agent& agent) const {
  if (agent.goal == kNoId) return nullptr;

  const Place& goal = roadmap_.place(agent.goal);
  for (const auto& [id, other] : timetable_.agents()) {
    if (other.number == agent.number || other.goal == kNoId) continue;
    const bool is_older = other.goal_since_s != agent.goal_since_s ? other.goal_since_s < agent.goal_since_s
                                                                   : other.number < agent.number;
    if (!is_older) continue;
    if (other.goal == agent.goal) return &other;
    if (goal.corridor != kNoId && meet(goal.standing, roadmap_.place(other.goal).standing, settings_.gap_m))
      return &other;
  }
  return nullptr;
}

/// The place of rest nearest to the goal that is free for ever and so far from the mouth of the goal that whoever comes
/// out can pass; none: kNoId.
PlaceId WayFinder::queue_place(const Agent& agent, double now_s) {
  const std::vector<double>& seconds = roadmap_.seconds_to(agent.goal);
  std::vector<std::pair<double, PlaceId>> near;
  for (PlaceId place = 0; place < seconds.size(); ++place) {
    if (!std::isfinite(seconds[place]) || roadmap_.place(place).kind != agent.kind) continue;
    const Place& here = roadmap_.place(place);
    if (here.corridor == kNoId && here.may_rest && !here.is_temporary) near.emplace_back(seconds[place], place);
  }
  if (near.empty()) return kNoId;

  std::sort(near.begin(), near.end());
  const double mouth_s = near.front().first;
  const View view = view_of(agent, now_s, kForEver);
  for (const auto& [to_goal_s, place] : near) {
    if (to_goal_s > mouth_s + kQueueToS) break;
    if (to_goal_s < mouth_s + kQueueFromS || !is_spare(agent, place, Rest::kStrict)) continue;
    if (search_.is_free_for_ever(place, now_s + kQueueToS, view)) return place;
  }
  return kNoId;
}

void WayFinder::queue(Agent& agent, double now_s) {
  const PlaceId rest = timetable_.rest_place(agent);
  const bool is_near = search_.alone_s(rest, agent.goal) < kQueueToS;
  if (is_near && is_spare(agent, rest, Rest::kStrict)) {
    if (search_.is_free_for_ever(rest, timetable_.end_s(agent, now_s), view_of(agent, now_s, kForEver))) return;
  }

  const PlaceId place = queue_place(agent, now_s);
  if (place == kNoId || place == rest) return;

  const auto legs = search_.find(departure(agent, now_s), {place, {}}, view_of(agent, now_s, kForEver));
  if (legs) timetable_.replace_tail(agent, *legs, false);
}

std::optional<std::vector<Leg>> WayFinder::way_past_plans(const Agent& agent, double now_s) {
  View view = view_of(agent, now_s, 0.0);
  view.granted_only = true;
  return search_.find(departure(agent, now_s), {agent.goal, {}}, view);
}

void WayFinder::explain(Agent& agent, double now_s) {
  agent.waits_for.clear();
  if (!std::isfinite(alone_s(agent))) {
    agent.reason = "no way in the map";
    return;
  }

  const Place& goal = roadmap_.place(agent.goal);
  for (const auto& [id, other] : timetable_.agents()) {
    if (other.number == agent.number) continue;
    if (!meet(roadmap_.place(timetable_.rest_place(other)).standing, goal.standing, settings_.gap_m)) continue;
    agent.waits_for = {id};
    agent.reason = (other.is_frozen ? "goal taken by frozen " : "goal taken by ") + id;
    return;
  }

  const auto way = way_past_plans(agent, now_s);
  if (!way) {
    agent.reason = "no way between what stands and what is granted";
    for (const auto& [id, other] : timetable_.agents())
      if (other.is_frozen) agent.waits_for.push_back(id);
    return;
  }
  agent.waits_for = timetable_.those_met(agent, *way);
  agent.reason = "no room yet";
}

}  // namespace aisle::global_planner::traffic
