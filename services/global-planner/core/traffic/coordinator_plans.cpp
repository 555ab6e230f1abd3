#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "services/global-planner/core/traffic/coordinator.hpp"

namespace aisle::global_planner::traffic {
namespace {

using geometry::Point2;
using geometry::Pose2;

constexpr double kRetryS = 1.0;  // between two searches for the same vehicle; where the budget is short, ever longer:
constexpr double kMostRetryS = 4.0;
constexpr double kRetryGrowth = 1.3;
constexpr double kLastResortS = 4.0;  // without a plan: then all are planned together
constexpr double kOwnWayRetryS = 2.0;
constexpr int kPlansASlice = 8;
constexpr std::uint64_t kExpandedASlice = 1'000;  // no further search begins in a slice after so many states

constexpr double kLeastPieceM = 0.3;  // of an own way: shorter legs go with their neighbours
constexpr double kLeastPitchM = 1.0;

double pitch_m(const Kind& kind, double gap_m) {
  return std::max(kLeastPitchM, 2.0 * (geometry::reach_m(kind.footprint) + kind.tube_m) + gap_m);
}

/// The path in pieces of about the pitch. It is cut at its corners, so that no arc reaches over the end of a piece by
/// more than the corner there; corners that follow each other closely stay within one piece.
/// @param may_stop may the vehicle stop here? Only there is the path cut.
std::vector<std::vector<Point2>> cut_up(const std::vector<Point2>& path, double pitch,
                                        const std::function<bool(Point2)>& may_stop) {
  std::vector<std::vector<Point2>> pieces;
  std::vector<Point2> piece{path.front()};
  double length = 0.0;

  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point2 from = path[i - 1], to = path[i];
    const double leg = geometry::distance(from, to);
    if (leg < 1e-6) continue;

    const int parts = leg < kLeastPieceM ? 1 : std::max(1, static_cast<int>(std::lround(leg / pitch)));
    for (int part = 1; part <= parts; ++part) {
      piece.push_back(part == parts ? to : from + static_cast<double>(part) / parts * (to - from));
      length += leg / parts;

      const bool is_end = i + 1 == path.size() && part == parts;
      if (!is_end && (length < kLeastPieceM || !may_stop(piece.back()))) continue;

      pieces.push_back(piece);
      piece.assign(1, piece.back());
      length = 0.0;
    }
  }

  return pieces;
}

}  // namespace

void Coordinator::set_goal(const std::string& agv_id, const std::string& goal_id,
                           const std::optional<Pose2>& goal_in_map, double now_s) {
  const auto found = vehicles_.find(agv_id);
  if (found == vehicles_.end()) return;

  VehicleEntry& vehicle = found->second;
  const bool is_same =
      vehicle.goal_in_map.has_value() == goal_in_map.has_value() && vehicle.goal_id == goal_id &&
      (!goal_in_map || (goal_in_map->x == vehicle.goal_in_map->x && goal_in_map->y == vehicle.goal_in_map->y));
  if (is_same) return;

  vehicle.goal_id = goal_id;
  vehicle.goal_in_map = goal_in_map;
  vehicle.goal_since_s = now_s;
  if (goal_in_map) newest_goal_s_ = now_s;
  vehicle.without_plan_s = now_s;
  vehicle.tried_s = -1e9;
  vehicle.tries = 0;
  vehicle.reason.clear();
  plans_changed();

  if (!vehicle.is_registered) return;

  // What is not granted of the way to the old goal is dropped, unless it goes to the same spot.
  set_agent_goal(vehicle, now_s);
}

void Coordinator::set_agent_goal(VehicleEntry& vehicle, double now_s) {
  const PlaceId goal = vehicle.goal_in_map ? goal_place(vehicle) : kNoId;

  Agent* agent = plans_.find(vehicle.id);
  if (goal != agent->goal && agent->pending() < agent->steps.size()) plans_.cut(vehicle.id, now_s);

  agent = plans_.find(vehicle.id);
  agent->goal = goal;
  agent->goal_since_s = vehicle.goal_since_s;
  agent->has_plan_to_goal = goal != kNoId && agent->steps.size() == agent->pending() && end_of_grants(*agent) == goal;
  if (vehicle.goal_in_map && goal == kNoId) vehicle.reason = "no way in the map";
}

/// The place of its goal. A vehicle that does not turn on the spot comes with the heading that it reaches soonest.
PlaceId Coordinator::goal_place(const VehicleEntry& vehicle) {
  const Pose2 goal = *vehicle.goal_in_map;
  if (vehicle.kind.turns_on_the_spot()) return roadmap_.temporary_place(vehicle.kind_id, goal);

  const PlaceId from = end_of_grants(*plans_.find(vehicle.id));
  double soonest_s = std::numeric_limits<double>::infinity();
  PlaceId best = kNoId;

  for (int quarter = 0; quarter < 4; ++quarter) {
    const double yaw = geometry::wrap(0.5 * geometry::kPi * quarter);
    const PlaceId place = roadmap_.temporary_place(vehicle.kind_id, {goal.x, goal.y, yaw});
    if (place == kNoId) continue;
    if (place == from) return place;
    if (roadmap_.place(place).leaving.empty()) continue;

    const double seconds = roadmap_.seconds_to(from, place);
    if (seconds >= soonest_s) continue;

    soonest_s = seconds;
    best = place;
  }

  return best;
}

PlaceId Coordinator::end_of_grants(const Agent& agent) const {
  const std::size_t granted = agent.pending();
  return granted == 0 ? agent.place : roadmap_.motion(agent.steps[granted - 1].motion).to;
}

/// Those who have a goal and no plan, the oldest first.
void Coordinator::plan_those_without(double now_s) {
  std::vector<VehicleEntry*> without;
  for (auto& [id, vehicle] : vehicles_) {
    const Agent* agent = plans_.find(id);
    if (agent == nullptr || agent->is_frozen || !vehicle.goal_in_map) continue;

    if (agent->has_plan_to_goal) {
      vehicle.without_plan_s = now_s;
      continue;
    }

    if (now_s >= retry_at_s(vehicle) && !vehicle.asked_back) without.push_back(&vehicle);
  }

  std::stable_sort(without.begin(), without.end(),
                   [](const VehicleEntry* a, const VehicleEntry* b) { return a->goal_since_s < b->goal_since_s; });

  int planned = 0;
  const std::uint64_t most_expanded = plans_.expanded() + kExpandedASlice;
  for (VehicleEntry* vehicle : without) {
    if (vehicle->tries > 0 && tries_expanded_ <= 0.0) continue;

    if (planned++ == kPlansASlice || plans_.expanded() >= most_expanded) {
      is_busy_ = true;
      return;
    }

    const std::uint64_t before = plans_.expanded();
    vehicle->tried_s = now_s;
    const bool has_plan = plan_one(*vehicle, now_s) && plans_.find(vehicle->id)->has_plan_to_goal;
    if (!has_plan || vehicle->tries > 0) tries_expanded_ -= static_cast<double>(plans_.expanded() - before);
    vehicle->tries = has_plan ? 0 : vehicle->tries + 1;
    if (has_plan) plans_changed();
  }
}

/// When a vehicle without a plan is searched one for again. Where the budget is short, those that were tried often wait
/// longer: so the younger goals have their turn as well.
double Coordinator::retry_at_s(const VehicleEntry& vehicle) const {
  if (tries_expanded_ > 0.5 * kMostTriesSaved) return vehicle.tried_s + kRetryS;
  return vehicle.tried_s + std::min(kMostRetryS, kRetryS * std::pow(kRetryGrowth, std::max(0, vehicle.tries - 1)));
}

/// Alone among the others; else with the vehicles in its way; in the end all together.
bool Coordinator::plan_one(VehicleEntry& vehicle, double now_s) {
  Agent* agent = plans_.find(vehicle.id);
  if (agent->goal == kNoId) {
    set_agent_goal(vehicle, now_s);
    agent = plans_.find(vehicle.id);
    if (agent->goal == kNoId) return false;
  }

  if (plans_.plan(vehicle.id, own_way_motions(vehicle), now_s)) return true;

  // In a queue it waits its turn. A group may move it out of the way and leave it without a plan, for the same reason.
  agent = plans_.find(vehicle.id);
  if (agent->is_queueing || tries_expanded_ <= 0.0) return false;

  const std::vector<std::string> waits_for = agent->waits_for;
  const std::string reason = agent->reason;
  if (plans_.plan_group(vehicle.id, now_s)) {
    agent = plans_.find(vehicle.id);
    if (!agent->has_plan_to_goal) {
      agent->waits_for = waits_for;
      agent->reason = reason;
    }

    return true;
  }

  if (now_s < vehicle.without_plan_s + kLastResortS) return false;

  const bool is_oldest = std::none_of(vehicles_.begin(), vehicles_.end(), [&](const auto& other) {
    const Agent* another = plans_.find(other.first);
    return another != nullptr && other.second.goal_in_map && !another->has_plan_to_goal && !another->is_frozen &&
           other.second.goal_since_s < vehicle.goal_since_s;
  });

  return is_oldest && plans_.plan_all(now_s);
}

/// Whoever rests where another wants to pass leaves, with its next goal or to a place of rest.
void Coordinator::move_resters(double now_s) {
  for (const std::string& id : plans_.asked_to_leave()) {
    const auto found = vehicles_.find(id);
    if (found == vehicles_.end() || found->second.asked_back || now_s < found->second.tried_s + kRetryS) continue;

    VehicleEntry& vehicle = found->second;
    const Agent* agent = plans_.find(id);
    if (agent == nullptr || agent->is_frozen) continue;

    const std::uint64_t before = plans_.expanded();
    vehicle.tried_s = now_s;
    if (plans_.plan(id, {}, now_s) || plans_.plan_group(id, now_s)) plans_changed();
    tries_expanded_ -= static_cast<double>(plans_.expanded() - before);
  }
}

/// Every few seconds a vehicle that drives by the roadmap looks for a way of its own from where its grants end.
void Coordinator::retry_own_way(double now_s) {
  VehicleEntry* next = nullptr;

  for (auto& [id, vehicle] : vehicles_) {
    const Agent* agent = plans_.find(id);
    if (agent == nullptr || agent->is_frozen || !agent->has_plan_to_goal || vehicle.asked_back) continue;

    const std::size_t granted = agent->pending();
    const bool has_own = granted < agent->steps.size() && agent->steps.back().is_own_way;
    if (granted >= agent->steps.size() || has_own || now_s < vehicle.own_tried_s + kOwnWayRetryS) continue;
    if (next == nullptr || vehicle.own_tried_s < next->own_tried_s) next = &vehicle;
  }

  if (next == nullptr) return;

  next->own_tried_s = now_s;
  const std::vector<MotionId> own = own_way_motions(*next);
  if (own.empty()) return;

  // Where there is the time, another way by the roadmap is looked for as well.
  const std::uint64_t before = plans_.expanded();
  if (improve_expanded_ > 0.0)
    plans_.plan(next->id, own, now_s);
  else
    plans_.take_own_way(next->id, own, now_s);
  improve_expanded_ -= static_cast<double>(plans_.expanded() - before);
}

/// The vehicle's own way from where its grants end to its goal, as motions; empty where there is none.
std::vector<MotionId> Coordinator::own_way_motions(const VehicleEntry& vehicle) {
  if (!own_way_ || !vehicle.goal_in_map || !vehicle.kind.turns_on_the_spot()) return {};

  const Agent* agent = plans_.find(vehicle.id);
  const PlaceId begin = end_of_grants(*agent);
  const PlaceId goal = agent->goal;
  if (goal == kNoId || begin == goal) return {};

  const Point2 from = roadmap_.place(begin).base_in_map.position();
  const Point2 to = roadmap_.place(goal).base_in_map.position();
  const std::vector<Point2> path = own_way_(vehicle.id, from, to);
  if (path.size() < 2) return {};

  std::vector<MotionId> motions;
  PlaceId last = begin;
  const auto may_stop = [&](Point2 at) {
    return !roadmap_.zones().forbid_stopping(standing_shape(vehicle.kind, {at.x, at.y, 0.0}));
  };
  std::vector<std::vector<Point2>> pieces = cut_up(path, pitch_m(vehicle.kind, settings_.gap_m), may_stop);

  for (std::size_t i = 0; i < pieces.size(); ++i) {
    std::vector<Point2>& piece = pieces[i];
    const Pose2 end{piece.back().x, piece.back().y, geometry::bearing(piece[piece.size() - 2], piece.back())};
    const PlaceId next = i + 1 == pieces.size() ? goal : roadmap_.temporary_place(vehicle.kind_id, end, false);
    if (next == kNoId || next == last) return {};

    // A place that is there already may lie a little beside the cut.
    piece.front() = roadmap_.place(last).base_in_map.position();
    piece.back() = roadmap_.place(next).base_in_map.position();
    motions.push_back(roadmap_.temporary_motion(last, next, piece));
    if (motions.back() == kNoId) return {};
    last = next;
  }

  return motions;
}

/// Temporary places and motions that nobody uses any more end.
void Coordinator::sweep(double now_s) {
  swept_s_ = now_s;
  plans_.forget(roadmap_.sweep(plans_.places_in_use(), plans_.motions_in_use()));
}

}  // namespace aisle::global_planner::traffic
