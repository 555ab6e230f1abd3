#pragma once

#include <cstdint>
#include <vector>

#include "services/global-planner/core/traffic/parts.hpp"

namespace aisle::global_planner::traffic {

/// Replans several vehicles together: all of it is kept, or nothing has changed.
class GroupPlanner {
 public:
  explicit GroupPlanner(JointPlan::Parts& parts) : parts_(parts) {}

  /// The agent and those in its way (spec section 8.6). @return has the agent a plan to its goal, or out of the way?
  bool plan(Agent& agent, double now_s);

  /// One vehicle that loses much, and those that it waits for (spec section 8.8). @return did the sum of ends fall?
  /// @param random_state of the order, goes on with each call
  bool improve(double now_s, std::uint64_t& random_state);

 private:
  using Members = std::vector<Agent*>;

  Members those_in_the_way(Agent& agent, double now_s);
  bool plan_in_order(const Members& order, double now_s, const WayFinder::Terms& terms, double most_sum_s = kForEver);
  double least_sum_of_ends_s(const Members& order, std::size_t planned, double now_s);
  Agent* most_late(double now_s, std::uint64_t& random_state);
  Members those_waited_for(Agent& agent);
  double lost_s(const Agent& agent, double now_s);
  double sum_of_ends_s(double now_s) const;
  std::size_t number_with_plan() const;
  const Agent* oldest_with_plan(double now_s);

  JointPlan::Parts& parts_;
};

}  // namespace aisle::global_planner::traffic
