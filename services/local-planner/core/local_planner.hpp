#pragma once
#include <optional>
#include <string>
#include <vector>

#include "services/local-planner/core/inputs.hpp"
#include "services/local-planner/core/recovery.hpp"
#include "services/local-planner/core/settings.hpp"
#include "services/local-planner/core/telling.hpp"
#include "services/local-planner/core/way.hpp"

namespace aisle::local_planner {

/// Drives one vehicle along its plan, at 50 Hz, without touching what it can know of.
///
///   inputs ─► guard ─► way (lane, detour, aside) ─► right of way ─► speed cap and target ─► dynamic window ─► command
///
/// Keeps to the right, slows in bends, near walls and near people, waits where others go first, drives around what
/// stands, steps aside for those whom it blocks, and asks for another plan when none of this helps. Whatever is missing
/// or old in its inputs stops it, and the output says which. Deterministic: the same calls give the same outputs. Not
/// for several threads.
class LocalPlanner {
 public:
  explicit LocalPlanner(const Settings& settings = {}, Variant variant = wang());
  /// One cycle. `now` never goes back; call it every `control_period_s`.
  Output step(const Inputs& inputs, time::Stamp now);

 private:
  struct Cycle;  // what one step works on

  std::optional<std::pair<Phase, Reason>> guard(const Inputs& inputs, time::Stamp now);
  std::optional<std::pair<Phase, Reason>> guard_plan(const Inputs& inputs, time::Stamp now);
  void adopt_plan(const Inputs& inputs, Cycle& cycle);
  void hold(Cycle& cycle, Phase phase, Reason reason);
  bool finish(Cycle& cycle);
  void find_detour(Cycle& cycle);
  void advise_traffic(Cycle& cycle);
  void step_aside(Cycle& cycle);
  bool find_spot(Cycle& cycle, const std::vector<std::string>& for_whom);
  void recover(Cycle& cycle);
  void drive(Cycle& cycle);
  void leave_path_for_sub_target(Cycle& cycle) const;
  Scene scene_of(const Cycle& cycle) const;
  static bool somebody_walks_by(const Cycle& cycle);
  void brake(Cycle& cycle);
  bool is_lost(const Cycle& cycle) const;
  geometry::Twist2 turn_of(const Cycle& cycle, double error_rad) const;
  Aim aim(const Cycle& cycle) const;
  geometry::Point2 visible_target(const Cycle& cycle) const;
  double least_spare_m(const Cycle& cycle, double s_m, double most_m) const;
  double speed_cap(const Cycle& cycle) const;
  void describe(Cycle& cycle);
  void command(Cycle& cycle, const geometry::Twist2& wanted);

  Settings settings_;
  Variant variant_;
  Observer observer_;
  Way way_;
  geometry::Twist2 last_command_;
  double steering_rad_{0.0};  // of a tricycle, after the last command
  time::Stamp last_step_{};
  time::Stamp late_{};                            // when a cycle last came too late
  std::uint64_t plan_id_{0};                      // of the lane
  std::vector<geometry::Point2> plan_waypoints_;  // as the plan had them
  std::string goal_id_;
  geometry::Pose2 goal_in_map_;
  std::uint64_t lane_revision_{0};
  std::uint64_t seen_revision_{0};
  time::Stamp revision_changed_{};
  bool arrived_{false};
  time::Stamp near_since_{};  // within the goal's tolerance
  bool turning_{false};
  bool lets_pass_{false};   // people who walk by refused all that moves, in the cycle before
  time::Stamp moved_{};     // when the vehicle last moved, or had no reason to
  time::Stamp searched_{};  // when detours were last looked for
  time::Stamp stepped_aside_{};
  Patience patience_;
  bool backs_off_{false};  // the way aside is a recovery, and no courtesy
  std::optional<Blocked> blocked_;
};

}  // namespace aisle::local_planner
