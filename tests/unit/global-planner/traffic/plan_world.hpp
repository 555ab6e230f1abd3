#pragma once
// Vehicles that drive plans step by step, as a coordinator would let them: plans, grants through a lock, and reports.

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "common/geometry/footprint.hpp"
#include "common/grid/clearance.hpp"
#include "services/global-planner/core/traffic/joint_plan.hpp"
#include "services/global-planner/core/traffic/lock.hpp"
#include "tests/support/ascii_grid.hpp"

namespace aisle::test_support {

/// A pseudo-random sequence that is the same everywhere.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : state_(seed * 2654435761ULL + 88172645463325252ULL) {}

  std::uint64_t next() {
    state_ ^= state_ << 13U;
    state_ ^= state_ >> 7U;
    state_ ^= state_ << 17U;
    return state_;
  }
  std::size_t below(std::size_t limit) { return static_cast<std::size_t>(next() % limit); }
  double between(double low, double high) { return low + (high - low) * static_cast<double>(next() % 10007) / 10006.0; }

 private:
  std::uint64_t state_;
};

/// A cart that turns on the spot: a disc of 0.35 m.
inline global_planner::traffic::Kind cart() {
  global_planner::traffic::Kind kind;
  kind.footprint = geometry::disc(0.35);
  return kind;
}

/// A floor drawn as text, its roadmap for carts, and what is planned and held on it.
class PlanWorld {
 public:
  using Agent = global_planner::traffic::Agent;
  using PlaceId = global_planner::traffic::PlaceId;

  explicit PlanWorld(const std::vector<std::string>& floor, double cell_m = 0.5,
                     const global_planner::traffic::JointPlan::Settings& settings = {})
      : grid_(fine(grid_from_text(floor, cell_m))),
        clearance_(grid_),
        plan_(roadmap_, settings),
        lock_(settings.gap_m) {
    roadmap_.set_map(clearance_, {0, 0}, {grid_.geometry().width - 1, grid_.geometry().height - 1});
    kind_ = roadmap_.kind(cart());
  }

  global_planner::traffic::Roadmap& roadmap() { return roadmap_; }
  global_planner::traffic::JointPlan& plan() { return plan_; }
  global_planner::traffic::KindId kind() const { return kind_; }
  double now_s() const { return now_s_; }

  /// The place nearest to a point. @throws std::invalid_argument when there is none near it
  PlaceId near(geometry::Point2 in_map) const {
    const PlaceId place = roadmap_.nearest(kind_, {in_map.x, in_map.y, 0.0});
    if (place == global_planner::traffic::kNoId) throw std::invalid_argument("no place near this point");
    return place;
  }

  /// Open places of the roadmap.
  std::vector<PlaceId> places() const {
    std::vector<PlaceId> out;
    for (PlaceId id = 0; id < roadmap_.places(); ++id)
      if (!roadmap_.place(id).is_closed && !roadmap_.place(id).is_temporary) out.push_back(id);
    return out;
  }

  Agent& add(const std::string& id, PlaceId place) {
    Agent& agent = plan_.add(id, kind_, place, 0.0, now_s_);
    lock_.admit(id, 0, roadmap_.place(place).standing);
    return agent;
  }

  void send(const std::string& id, PlaceId goal) {
    Agent& agent = *plan_.find(id);
    agent.goal = goal;
    agent.goal_since_s = now_s_;
    agent.has_plan_to_goal = false;
  }

  /// Vehicles that stand at their goals have none any more. @return how many are left with a goal
  std::size_t end_goals_reached() {
    std::size_t left = 0;
    for (const auto& [id, agent] : plan_.agents()) {
      if (agent.goal == global_planner::traffic::kNoId) continue;
      if (agent.steps.empty() && agent.place == agent.goal) {
        plan_.find(id)->goal = global_planner::traffic::kNoId;
        plan_.find(id)->has_plan_to_goal = false;
      } else {
        ++left;
      }
    }
    return left;
  }

  /// Plans for those that need one, the oldest goal first; with their neighbours where they find none alone.
  void plan_those_without() {
    std::vector<Agent*> waiting;
    for (const auto& [id, agent] : plan_.agents())
      if (agent.goal != global_planner::traffic::kNoId && !agent.has_plan_to_goal) waiting.push_back(plan_.find(id));
    std::sort(waiting.begin(), waiting.end(), [](const Agent* a, const Agent* b) {
      return a->goal_since_s != b->goal_since_s ? a->goal_since_s < b->goal_since_s : a->number < b->number;
    });

    for (Agent* agent : waiting) {
      if (plan_.plan(agent->id, {}, now_s_)) continue;
      if (!agent->reason.empty() && agent->reason.rfind("goal taken by", 0) == 0) continue;
      if (plan_.plan_group(agent->id, now_s_)) continue;
      if (agent == waiting.front()) plan_.plan_all(now_s_);
    }
    for (const std::string& id : plan_.asked_to_leave())
      if (!plan_.plan(id, {}, now_s_)) plan_.plan_group(id, now_s_);
  }

  /// Grants up to `ahead` steps to each vehicle whose links are done.
  void grant(std::size_t ahead = 3) {
    for (const auto& [id, agent] : plan_.agents()) {
      while (agent.pending() < ahead && plan_.is_next_free(id)) {
        const auto& step = agent.steps[agent.pending()];
        if (!lock_.admit(id, agent.granted, step.shape)) {
          ++refused_;
          break;
        }
        plan_.grant_next(id);
      }
    }
  }

  /// Vehicles drive for `dt_s`; `hold(id)` says which of them stand meanwhile.
  template <class Hold>
  void drive(double dt_s, Hold&& hold) {
    now_s_ += dt_s;
    std::vector<std::string> ids;
    for (const auto& [id, agent] : plan_.agents()) ids.push_back(id);
    for (const std::string& id : ids) {
      const Agent& agent = *plan_.find(id);
      if (agent.pending() == 0 || hold(id)) continue;

      double& left_s = left_s_[id];
      if (left_s <= 0.0) left_s = agent.steps.front().end_s - agent.steps.front().begin_s;
      left_s -= dt_s;
      if (left_s <= 0.0) report(id, agent.done + 1);
    }
    plan_.retime(now_s_);
  }

  void report(const std::string& id, std::uint64_t done) {
    plan_.report(id, done, now_s_);
    const Agent& agent = *plan_.find(id);
    lock_.admit(id, done, roadmap_.place(agent.place).standing);
    lock_.release(id, done);
  }

  /// Motions that the lock refused though all their links were done.
  std::uint64_t refused() const { return refused_; }

  /// Do the links of all steps that are not granted lead in no circle?
  bool has_no_circle() const {
    std::map<std::pair<std::string, std::uint64_t>, int> colours;  // 1: being looked at, 2: leads in no circle
    for (const auto& [id, agent] : plan_.agents())
      for (std::size_t i = 0; i < agent.steps.size(); ++i)
        if (!leads_out(agent, agent.done + i, colours)) return false;
    return true;
  }

 private:
  using Colours = std::map<std::pair<std::string, std::uint64_t>, int>;

  /// The same floor in cells of a fifth.
  static grid::OccupancyGrid fine(const grid::OccupancyGrid& coarse) {
    const auto& g = coarse.geometry();
    grid::OccupancyGrid out(grid::Geometry{5 * g.width, 5 * g.height, g.resolution_m / 5.0, {0.0, 0.0}});
    for (int y = 0; y < 5 * g.height; ++y)
      for (int x = 0; x < 5 * g.width; ++x) out.set({x, y}, coarse.at({x / 5, y / 5}));
    return out;
  }

  bool leads_out(const Agent& agent, std::uint64_t number, Colours& colours) const {
    if (number < agent.done || number >= agent.done + agent.steps.size()) return true;
    int& colour = colours[{agent.id, number}];
    if (colour != 0) return colour == 2;

    colour = 1;
    if (number > agent.done && !leads_out(agent, number - 1, colours)) return false;
    for (const auto& link : agent.steps[static_cast<std::size_t>(number - agent.done)].links) {
      const auto other = plan_.agents().find(link.agv_id);
      if (other != plan_.agents().end() && !leads_out(other->second, link.step, colours)) return false;
    }
    colours[{agent.id, number}] = 2;
    return true;
  }

  grid::OccupancyGrid grid_;
  grid::ClearanceField clearance_;
  global_planner::traffic::Roadmap roadmap_;
  global_planner::traffic::JointPlan plan_;
  global_planner::traffic::Lock lock_;
  global_planner::traffic::KindId kind_{0};
  std::map<std::string, double> left_s_;
  double now_s_{0.0};
  std::uint64_t refused_{0};
};

}  // namespace aisle::test_support
