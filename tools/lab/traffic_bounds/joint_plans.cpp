#include "tools/lab/traffic_bounds/joint_plans.hpp"

#include <ctime>
#include <map>
#include <string>
#include <vector>

#include "services/global-planner/core/traffic/joint_plan.hpp"

namespace aisle::lab {
namespace {

using global_planner::traffic::Agent;
using global_planner::traffic::JointPlan;
using global_planner::traffic::kNoId;
using global_planner::traffic::PlaceId;
using global_planner::traffic::Roadmap;

constexpr int kRounds = 4;  // over those without a plan

struct Ends {
  std::string agv_id;
  PlaceId start{kNoId};
  PlaceId goal{kNoId};
  double heading_rad{0.0};
};

void add_agent(JointPlan& plans, const FloorModel& model, const Ends& ends) {
  plans.add(ends.agv_id, model.kind_id, ends.start, ends.heading_rad, 0.0);
  Agent& agent = *plans.find(ends.agv_id);
  agent.goal = ends.goal;
  agent.has_plan_to_goal = ends.goal == ends.start;
}

double end_s(const Agent& agent) { return agent.steps.empty() ? 0.0 : agent.steps.back().end_s; }

void plan_all(JointPlan& plans, const std::vector<Ends>& fleet) {
  for (const Ends& ends : fleet) plans.plan(ends.agv_id, {}, 0.0);

  for (int round = 0; round < kRounds; ++round) {
    bool is_missing = false;

    for (const std::string& id : plans.asked_to_leave())
      if (!plans.plan(id, {}, 0.0)) plans.plan_group(id, 0.0);

    for (const Ends& ends : fleet) {
      if (plans.find(ends.agv_id)->has_plan_to_goal) continue;
      is_missing = true;
      if (!plans.plan(ends.agv_id, {}, 0.0)) plans.plan_group(ends.agv_id, 0.0);
    }

    if (!is_missing) return;
    if (round + 2 == kRounds) plans.plan_all(0.0);
  }
}

}  // namespace

JointPlans plan_from_nothing(const FloorModel& model, const scenario::Scenario& fleet) {
  Roadmap roadmap;
  roadmap.set_map(model.clearance, {0, 0},
                  {model.clearance.geometry().width - 1, model.clearance.geometry().height - 1});
  roadmap.kind(model.kind);

  std::vector<Ends> all;
  for (std::size_t i = 0; i < fleet.vehicles.size(); ++i) {
    const geometry::Pose2 start = fleet.vehicles[i].start_in_map;
    Ends ends{fleet.vehicles[i].id, roadmap.temporary_place(model.kind_id, start),
              roadmap.temporary_place(model.kind_id, fleet.missions[i].goals_in_map.front()), start.yaw};
    if (ends.start != kNoId && ends.goal != kNoId) all.push_back(std::move(ends));
  }

  JointPlan together(roadmap, {});
  for (const Ends& ends : all) add_agent(together, model, ends);

  const std::clock_t begin = std::clock();
  plan_all(together, all);

  JointPlans out;
  out.cpu_s = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
  for (const Ends& ends : all) {
    const Agent& agent = *together.find(ends.agv_id);
    if (!agent.has_plan_to_goal) continue;

    JointPlan one(roadmap, {});
    add_agent(one, model, ends);
    one.plan(ends.agv_id, {}, 0.0);

    ++out.planned;
    out.ends_s += end_s(agent);
    out.alone_s += end_s(*one.find(ends.agv_id));
  }

  return out;
}

}  // namespace aisle::lab
