#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "services/local-planner/core/command_following.hpp"
#include "services/local-planner/core/guard.hpp"
#include "services/local-planner/core/planner.hpp"
#include "services/local-planner/core/printed/target_rule.hpp"
#include "services/local-planner/core/surroundings.hpp"
#include "services/local-planner/core/way.hpp"

namespace aisle::local_planner {

/// A variant as its paper prints it: nothing of ours between the plan's nodes and the dynamic window.
///
///   inputs ─► guard ─► plan's nodes ─► at the goal? ─► [YU: faces the first node] ─► target rule of the paper
///                                         ─► dynamic window of one interval, or WU: follows the path ─► command,
///                                         status
///
/// There is no lane, no speed profile or cap, no limit, no detour, no turn on the spot but YU's first, no
/// recovery and no margin: a sample is refused only when the disc would touch a wall or a thing at its predicted place.
/// What the papers print wrongly stays repaired: signs, braking along the arc, rewards.
class PrintedPlanner final : public Planner {
 public:
  PrintedPlanner(const Settings& settings, const Variant& variant);
  Output step(const Inputs& inputs, time::Stamp now) override;

 private:
  Output decide(const Moment& moment);
  void adopt_plan(const Moment& moment);
  bool still_turns_to_first_node(const Moment& moment);
  geometry::Twist2 choose_twist(const Moment& moment, const Surroundings& around, Output& out);
  Aim aim_at(const PrintedTarget& target, const Moment& moment) const;

  DwaSettings dwa_;
  Variant variant_;
  Guard guard_;
  CommandFollower follower_;
  Observer observer_;

  Way way_;  // the plan's nodes
  std::string goal_id_;
  std::vector<geometry::Point2> waypoints_;
  std::size_t next_node_{1};
  bool has_faced_first_node_{false};
  bool has_arrived_{false};

  geometry::Twist2 wanted_;    // chosen last, and kept for an interval
  time::Stamp next_choice_{};  // when the next one is due
  Output last_;                // what was said of it
};

/// The dynamic window as the variant's paper prints it: V_d of one interval, its resolutions, its horizon, heading at
/// the trajectory's end, no margins, the whole deceleration.
DwaSettings printed_window(const DwaSettings& ours, const Variant& variant);

}  // namespace aisle::local_planner
