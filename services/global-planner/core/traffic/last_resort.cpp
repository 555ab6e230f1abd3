#include "services/global-planner/core/traffic/last_resort.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace aisle::global_planner::traffic {
namespace {

// Joint steps times vehicles that are tried at most.
constexpr std::size_t kMostTries = 30'000;

}  // namespace

LastResort::LastResort(JointPlan::Parts& parts) : parts_(parts), step_(parts.meetings, obstacles_) {}

/// @return is there a vehicle whose goal can be reached when nobody is in its way, and that has no plan?
bool LastResort::choose_vehicles() {
  std::vector<std::pair<Agent*, PlaceId>> chosen;
  for (auto& [id, agent] : parts_.timetable.agents()) {
    if (agent.is_frozen) continue;
    const bool has_turn = agent.goal != kNoId && parts_.ways.ahead_in_queue(agent) == nullptr;
    chosen.emplace_back(&agent, has_turn && std::isfinite(parts_.ways.alone_s(agent)) ? agent.goal : kNoId);
  }

  std::stable_sort(chosen.begin(), chosen.end(), [](const auto& a, const auto& b) {
    if ((a.second == kNoId) != (b.second == kNoId)) return b.second == kNoId;
    if (a.first->has_plan_to_goal != b.first->has_plan_to_goal) return b.first->has_plan_to_goal;
    return a.first->goal_since_s < b.first->goal_since_s;
  });
  for (const auto& [agent, goal] : chosen) {
    vehicles_.push_back(agent);
    goals_.push_back(goal);
  }
  return !vehicles_.empty() && goals_.front() != kNoId && !vehicles_.front()->has_plan_to_goal;
}

/// Those that are never moved stand in the way with all that they hold.
void LastResort::choose_obstacles() {
  for (const auto& [id, agent] : parts_.timetable.agents()) {
    if (!agent.is_frozen) continue;
    obstacles_.push_back(parts_.meetings.of_place(parts_.timetable.rest_place(agent)));
    for (std::size_t i = 0; i < agent.pending(); ++i)
      obstacles_.push_back(parts_.meetings.of_motion(agent.steps[i].motion));
  }
}

void LastResort::begin(double now_s) {
  Node start;
  for (const Agent* vehicle : vehicles_) {
    const Departure from = parts_.ways.departure(*vehicle, now_s);
    start.places.push_back(from.place);
    start.by.push_back(from.before);
  }
  start.open.push_back(nullptr);
  known_[start.places] = 0;
  nodes_.push_back(std::move(start));
}

double LastResort::to_go_s(std::size_t vehicle, PlaceId place) { return parts_.search.alone_s(place, goals_[vehicle]); }

/// All moves of each vehicle from where it stands, the nearest to its goal first; without a goal it would rather stay.
std::vector<std::vector<Move>> LastResort::wishes_at(const Node& node) {
  std::vector<std::vector<Move>> out(vehicles_.size());
  for (std::size_t vehicle = 0; vehicle < vehicles_.size(); ++vehicle) {
    const PlaceId here = node.places[vehicle];
    std::vector<std::pair<double, Move>> moves;
    const Move stay{kNoId, here, here, node.by[vehicle]};
    moves.emplace_back(goals_[vehicle] == kNoId ? 0.0 : to_go_s(vehicle, here), stay);

    for (const MotionId id : parts_.roadmap.place(here).leaving) {
      const Motion& motion = parts_.roadmap.motion(id);
      const Place& to = parts_.roadmap.place(motion.to);
      const bool is_end = motion.to == goals_[vehicle];
      if (!SpaceTimeSearch::may_drive(motion, parts_.roadmap.place(here), to) || (to.is_temporary && !is_end)) continue;

      const double order = goals_[vehicle] == kNoId ? 1.0 : to_go_s(vehicle, motion.to);
      moves.emplace_back(order, Move{id, here, motion.to, node.by[vehicle]});
    }
    std::stable_sort(moves.begin(), moves.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [order, move] : moves) out[vehicle].push_back(move);
  }
  return out;
}

std::size_t LastResort::add_node(std::size_t parent, const JointStep& step) {
  Node node;
  node.places = nodes_[parent].places;
  node.by = nodes_[parent].by;
  node.parent = parent;
  for (const std::size_t vehicle : step.order()) {
    const Move& move = step.move(vehicle);
    if (move.stays()) continue;
    node.places[vehicle] = move.to;
    node.by[vehicle] = move.motion;
    node.moves.push_back(move);
    node.movers.push_back(vehicle);
  }
  node.open.push_back(nullptr);

  const auto [known, is_new] = known_.try_emplace(node.places, nodes_.size());
  if (is_new) nodes_.push_back(std::move(node));
  return known->second;
}

/// A step from the node in which some moves are prescribed, and PIBT chooses the others. False: there is none.
bool LastResort::next_step(std::size_t number, const std::shared_ptr<const Constraint>& constraint) {
  const Node& node = nodes_[number];
  step_.begin(node.places, node.by);

  const std::size_t depth = constraint ? constraint->depth : 0;
  std::vector<const Constraint*> prescribed;
  for (const Constraint* c = constraint.get(); c != nullptr; c = c->before.get()) prescribed.push_back(c);
  std::reverse(prescribed.begin(), prescribed.end());
  for (std::size_t vehicle = 0; vehicle < depth; ++vehicle)
    if (!step_.prescribe(vehicle, prescribed[vehicle]->move)) return false;

  const auto wishes = wishes_at(node);
  for (std::size_t vehicle = 0; vehicle < vehicles_.size(); ++vehicle)
    if (!step_.has_move(vehicle) && !step_.choose(vehicle, wishes)) return false;
  return true;
}

/// How: depth first. The node on top tries its next constraint; the step that comes of it leads to a new node, which
/// goes on top, or to a known one, which is taken up again.
bool LastResort::search() {
  std::vector<std::size_t> stack{0};
  const std::size_t most_tries = kMostTries / vehicles_.size();
  for (std::size_t tries = 0; !stack.empty() && tries < most_tries; ++tries) {
    const std::size_t number = stack.back();
    if (nodes_[number].places.front() == goals_.front()) {
      last_ = number;
      return true;
    }
    if (nodes_[number].open.empty()) {
      stack.pop_back();
      continue;
    }

    const std::shared_ptr<const Constraint> constraint = nodes_[number].open.front();
    nodes_[number].open.pop_front();
    const std::size_t depth = constraint ? constraint->depth : 0;
    if (depth < vehicles_.size()) {
      const std::vector<std::vector<Move>> wishes = wishes_at(nodes_[number]);
      for (const Move& move : wishes[depth])
        nodes_[number].open.push_back(std::make_shared<const Constraint>(Constraint{constraint, move, depth + 1}));
    }

    if (next_step(number, constraint)) stack.push_back(add_node(number, step_));
  }
  return false;
}

/// The steps as legs with times.
///
/// How: all moves in an order in which they can be driven; each begins when its vehicle is there and all moves before
/// it that meet it have ended.
std::vector<std::vector<Leg>> LastResort::schedule(double now_s) {
  std::vector<std::size_t> path;
  for (std::size_t number = last_; number != 0; number = nodes_[number].parent) path.push_back(number);
  std::reverse(path.begin(), path.end());

  struct Driven {
    std::uint32_t agent{kNoId};
    ShapeId motion{kNoId};
    ShapeId corner{kNoId};
    double end_s{0.0};
  };
  std::vector<Driven> driven;
  std::vector<double> free_s(vehicles_.size());
  std::vector<double> heading_rad(vehicles_.size());
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    const Departure from = parts_.ways.departure(*vehicles_[i], now_s);
    free_s[i] = from.time_s;
    heading_rad[i] = from.heading_rad;
    for (std::size_t k = 0; k < vehicles_[i]->pending(); ++k) {
      const Step& step = vehicles_[i]->steps[k];
      const ShapeId corner = step.before == kNoId ? kNoId : parts_.meetings.of_corner(step.before, step.motion);
      driven.push_back({vehicles_[i]->number, parts_.meetings.of_motion(step.motion), corner, step.end_s});
    }
  }

  const auto meet = [&](ShapeId a, ShapeId b) { return a != kNoId && b != kNoId && parts_.meetings.meet(a, b); };
  std::vector<std::vector<Leg>> legs(vehicles_.size());
  for (const std::size_t number : path) {
    const Node& node = nodes_[number];
    for (std::size_t i = 0; i < node.moves.size(); ++i) {
      const Move& move = node.moves[i];
      const std::size_t vehicle = node.movers[i];
      const Motion& motion = parts_.roadmap.motion(move.motion);
      const ShapeId shape = parts_.meetings.of_motion(move.motion);
      const ShapeId corner = move.before == kNoId ? kNoId : parts_.meetings.of_corner(move.before, move.motion);

      double begin_s = free_s[vehicle];
      for (const Driven& other : driven) {
        if (other.agent == vehicles_[vehicle]->number || other.end_s <= begin_s) continue;
        if (meet(other.motion, shape) || meet(other.corner, shape) || meet(other.motion, corner) ||
            meet(other.corner, corner))
          begin_s = other.end_s;
      }
      const double end_s = begin_s + run_s(parts_.roadmap.kind(motion.kind), motion, heading_rad[vehicle], true);
      legs[vehicle].push_back({move.motion, begin_s, end_s});
      driven.push_back({vehicles_[vehicle]->number, shape, corner, end_s});
      free_s[vehicle] = end_s;
      heading_rad[vehicle] = motion.exit_rad;
    }
  }
  return legs;
}

void LastResort::commit(const std::vector<std::vector<Leg>>& legs) {
  for (Agent* vehicle : vehicles_) parts_.timetable.drop_from(*vehicle, vehicle->granted);
  for (std::size_t i = 0; i < vehicles_.size(); ++i) parts_.timetable.replace_tail(*vehicles_[i], legs[i], false);
}

/// Each vehicle alone between the others, the oldest goal first: to its goal, or sooner.
void LastResort::replan_each(double now_s) {
  for (std::size_t i = 0; i < vehicles_.size(); ++i) {
    if (goals_[i] == kNoId) continue;
    WayFinder::Terms terms{parts_.settings.soft_rest_s};
    if (vehicles_[i]->has_plan_to_goal) terms.latest_end_s = parts_.timetable.end_s(*vehicles_[i], now_s);
    if (parts_.ways.go(*vehicles_[i], now_s, terms)) parts_.ways.clear_way_of(*vehicles_[i], now_s, terms);
  }
}

bool LastResort::plan(double now_s) {
  if (!choose_vehicles()) return false;
  choose_obstacles();
  begin(now_s);
  if (!search()) return false;

  commit(schedule(now_s));
  replan_each(now_s);
  return vehicles_.front()->has_plan_to_goal;
}

}  // namespace aisle::global_planner::traffic
