#pragma once

#include "services/local-planner/core/arrival.hpp"
#include "services/local-planner/core/command_following.hpp"
#include "services/local-planner/core/guard.hpp"
#include "services/local-planner/core/inputs.hpp"
#include "services/local-planner/core/planner.hpp"
#include "services/local-planner/core/right_of_way/right_of_way.hpp"
#include "services/local-planner/core/settings.hpp"
#include "services/local-planner/core/stuck.hpp"
#include "services/local-planner/core/surroundings.hpp"
#include "services/local-planner/core/target.hpp"
#include "services/local-planner/core/turning.hpp"
#include "services/local-planner/core/way.hpp"
#include "services/local-planner/core/way_keeping.hpp"

namespace aisle::local_planner {

/// Drives one vehicle along its plan, at 50 Hz, without touching what it can know of.
///
///   inputs ─► guard ─► way keeping ─► arrival ─► surroundings ─► right of way ─► target ─► speed cap
///                                                                   ─► turning, or dynamic window ─► command, status
///
/// Keeps to the right, slows in bends, near walls and near people, waits where others go first, drives around what
/// stands, steps aside for vehicles that it blocks, and asks for another plan when none of this helps. Whatever is
/// missing or old in its inputs stops it, and the output says which.
class LocalPlanner final : public Planner {
 public:
  explicit LocalPlanner(const Settings& settings = {}, Variant variant = wang());
  Output step(const Inputs& inputs, time::Stamp now) override;

 private:
  struct Decision;  // what a cycle wants, and says

  /// The cycle's decision: what keeps the vehicle from driving, its goal, or its way.
  Decision decide(const Moment& moment);

  Decision hold(const Stopped& stopped, time::Stamp now);

  /// Takes up the newest plan; another lane or goal begins everything anew.
  void adopt_plan(const Moment& moment);

  Decision stay(const AtGoal& at_goal, time::Stamp now);
  Decision drive(const OnWay& on_way, const Ruling& ruling);
  Output drive_to(const Target& target, const OnWay& on_way, const Ruling& ruling);

  /// The surroundings as the dynamic window sees them, with this cycle's highest speed.
  Scene scene_towards(const Target& target, const OnWay& on_way, const Ruling& ruling) const;

  Settings settings_;
  Variant variant_;
  Guard guard_;
  CommandFollower follower_;
  WayKeeper way_keeper_;
  Way way_;
  Arrival arrival_;
  Observer observer_;
  RightOfWay right_of_way_;
  Stuck stuck_;
  TurnOnTheSpot turn_;
};

}  // namespace aisle::local_planner
