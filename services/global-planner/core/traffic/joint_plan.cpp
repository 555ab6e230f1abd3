#include "services/global-planner/core/traffic/joint_plan.hpp"

#include <utility>

#include "services/global-planner/core/traffic/group.hpp"
#include "services/global-planner/core/traffic/last_resort.hpp"
#include "services/global-planner/core/traffic/parts.hpp"

namespace aisle::global_planner::traffic {

JointPlan::JointPlan(Roadmap& roadmap, const Settings& settings) : parts_(std::make_unique<Parts>(roadmap, settings)) {}

JointPlan::~JointPlan() = default;

Agent& JointPlan::add(const std::string& agv_id, KindId kind, PlaceId place, double heading_rad, double,
                      std::uint64_t first_step) {
  Agent before;
  if (const Agent* known = find(agv_id)) before = *known;
  remove(agv_id);

  Agent& agent = parts_->timetable.add(agv_id, kind, place, heading_rad, first_step);
  agent.goal = before.goal;
  agent.goal_since_s = before.goal_since_s;
  agent.has_plan_to_goal = agent.goal == place && agent.goal != kNoId;
  return agent;
}

void JointPlan::remove(const std::string& agv_id) {
  parts_->ways.forget_own_way(agv_id);
  parts_->timetable.remove(agv_id);
}

Agent* JointPlan::find(const std::string& agv_id) { return parts_->timetable.find(agv_id); }

const std::map<std::string, Agent>& JointPlan::agents() const { return parts_->timetable.agents(); }

void JointPlan::report(const std::string& agv_id, std::uint64_t done, double now_s) {
  if (Agent* agent = find(agv_id)) parts_->timetable.report(*agent, done, now_s);
}

void JointPlan::grant_next(const std::string& agv_id) {
  if (Agent* agent = find(agv_id)) parts_->timetable.grant_next(*agent);
}

bool JointPlan::plan(const std::string& agv_id, const std::vector<MotionId>& own_way, double now_s) {
  Agent* agent = find(agv_id);
  if (agent == nullptr || agent->is_frozen) return false;

  WayFinder& ways = parts_->ways;
  WayFinder::Terms terms{parts_->settings.soft_rest_s};
  if (agent->goal == kNoId) {
    agent->has_plan_to_goal = false;
    return ways.leave(*agent, now_s, terms) && ways.clear_way_of(*agent, now_s, terms);
  }

  if (!own_way.empty()) {
    ways.remember_own_way(*agent, own_way);
    terms.own_way_bonus_s = parts_->settings.own_way_bonus_s;
  }
  const Agent* ahead = ways.ahead_in_queue(*agent);
  agent->is_queueing = ahead != nullptr;
  if (ahead != nullptr) {
    ways.queue(*agent, now_s);
    agent->waits_for = {ahead->id};
    agent->reason = "goal taken by " + ahead->id;
    return false;
  }

  const bool has_plan = agent->has_plan_to_goal && parts_->timetable.rest_place(*agent) == agent->goal;
  if (has_plan) terms = {parts_->settings.soft_rest_s, 0.0, parts_->timetable.end_s(*agent, now_s)};
  if (!ways.go(*agent, now_s, terms)) {
    if (has_plan) return true;
    ways.explain(*agent, now_s);
    return false;
  }

  agent->waits_for.clear();
  agent->reason.clear();
  ways.clear_way_of(*agent, now_s, {parts_->settings.soft_rest_s});
  return true;
}

bool JointPlan::take_own_way(const std::string& agv_id, const std::vector<MotionId>& own_way, double now_s) {
  Agent* agent = find(agv_id);
  if (agent == nullptr || agent->is_frozen || !agent->has_plan_to_goal) return false;

  parts_->ways.remember_own_way(*agent, own_way);
  return parts_->ways.go_own_way(*agent, now_s, parts_->timetable.end_s(*agent, now_s));
}

std::vector<std::string> JointPlan::asked_to_leave() const {
  std::vector<std::string> out;
  for (const std::uint32_t number : parts_->timetable.asked_to_leave()) {
    const Agent& agent = *parts_->timetable.at(number);
    if (!agent.is_frozen && !agent.has_plan_to_goal) out.push_back(agent.id);
  }
  return out;
}

bool JointPlan::plan_group(const std::string& agv_id, double now_s) {
  Agent* agent = find(agv_id);
  return agent != nullptr && !agent->is_frozen && GroupPlanner(*parts_).plan(*agent, now_s);
}

bool JointPlan::plan_all(double now_s) {
  parts_->timetable.begin_trial();
  const bool has_plan = LastResort(*parts_).plan(now_s);
  if (has_plan)
    parts_->timetable.keep_trial();
  else
    parts_->timetable.undo_trial();
  return has_plan;
}

bool JointPlan::improve(double now_s, std::uint64_t& random_state) {
  return GroupPlanner(*parts_).improve(now_s, random_state);
}

void JointPlan::cut(const std::string& agv_id, double) {
  if (Agent* agent = find(agv_id)) parts_->timetable.drop_from(*agent, agent->granted);
}

void JointPlan::give_back(const std::string& agv_id, std::uint64_t step, double) {
  Agent* agent = find(agv_id);
  if (agent != nullptr && step >= agent->done) parts_->timetable.drop_from(*agent, step);
}

std::vector<std::string> JointPlan::freeze(const std::string& agv_id, double now_s) {
  Agent* frozen = find(agv_id);
  if (frozen == nullptr) return {};

  std::vector<std::string> cut_ids{agv_id};
  cut(agv_id, now_s);
  parts_->timetable.set_frozen(*frozen, true);

  for (auto& [id, agent] : parts_->timetable.agents()) {
    bool waits = false;
    for (std::size_t i = agent.pending(); i < agent.steps.size(); ++i)
      for (const Link& link : agent.steps[i].links) waits = waits || link.agent == frozen->number;
    if (!waits) continue;

    cut(id, now_s);
    cut_ids.push_back(id);
  }
  return cut_ids;
}

void JointPlan::unfreeze(const std::string& agv_id, double) {
  if (Agent* agent = find(agv_id)) parts_->timetable.set_frozen(*agent, false);
}

void JointPlan::retime(double now_s) {
  if (!parts_->timetable.retime(now_s)) ++circles_;
}

bool JointPlan::is_next_free(const std::string& agv_id) const {
  const Agent* agent = parts_->timetable.find(agv_id);
  return agent != nullptr && agent->pending() < agent->steps.size() && next_waits_for(agv_id).empty();
}

std::vector<std::string> JointPlan::next_waits_for(const std::string& agv_id) const {
  const Agent* agent = parts_->timetable.find(agv_id);
  if (agent == nullptr || agent->pending() == agent->steps.size()) return {};

  std::vector<std::string> out;
  for (const Link& link : agent->steps[agent->pending()].links)
    if (!parts_->timetable.is_done(link)) out.push_back(link.agv_id);
  return out;
}

std::vector<PlaceId> JointPlan::places_in_use() const {
  std::vector<PlaceId> out;
  for (const auto& [id, agent] : agents()) {
    out.push_back(agent.place);
    if (agent.goal != kNoId) out.push_back(agent.goal);
  }
  for (const MotionId motion : motions_in_use()) {
    out.push_back(parts_->roadmap.motion(motion).from);
    out.push_back(parts_->roadmap.motion(motion).to);
  }
  return out;
}

std::vector<MotionId> JointPlan::motions_in_use() const {
  std::vector<MotionId> out;
  const auto use = [&](MotionId id) {
    if (id != kNoId && parts_->roadmap.motion(id).from != kNoId) out.push_back(id);
  };
  for (const auto& [id, agent] : agents()) {
    for (const Step& step : agent.steps) {
      use(step.motion);
      use(step.before);
    }
  }
  for (const auto& [id, motions] : parts_->ways.own_ways())
    for (const MotionId motion : motions) use(motion);
  return out;
}

void JointPlan::forget(const Roadmap::Ended& ended) { parts_->meetings.forget(ended.places, ended.motions); }

std::uint64_t JointPlan::expanded() const { return parts_->search.expanded(); }

}  // namespace aisle::global_planner::traffic
