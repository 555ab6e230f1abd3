#pragma once

#include "services/local-planner/core/arrival.hpp"
#include "services/local-planner/core/avoidance.hpp"
#include "services/local-planner/core/command_following.hpp"
#include "services/local-planner/core/guard.hpp"
#include "services/local-planner/core/inputs.hpp"
#include "services/local-planner/core/planner.hpp"
#include "services/local-planner/core/road.hpp"
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
///   inputs ─► road ─► guard ─► way keeping ─► arrival ─► surroundings ─► avoidance ─► target ─► speed cap
///                                                                   ─► turning, or dynamic window ─► command, status
///
/// Drives as far as its road is granted, and in the tube that goes with it; slows in bends, near walls and near people,
/// drives around what stands where the floor is its own, and asks for another plan when none of this helps. Whatever is
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

  /// Where the road ends for now, on the lane; infinity: nowhere.
  double stop_at_m() const;

  /// Metres of the outline off its path; 0 without steps.
  double stray_m(const Moment& moment) const;

  /// In a tube and with nobody walking near, no speed is better for what is met later.
  bool looks_short(const OnWay& on_way) const;

  /// Has the vehicle left its tube?
  bool strays(const OnWay& on_way) const;

  double blocked_after_s() const;

  /// Where it is on its road, for the leader of the traffic.
  void tell_road(const Moment& moment, Output& out) const;

  /// The surroundings as the dynamic window sees them, with this cycle's highest speed.
  Scene scene_towards(const Target& target, const OnWay& on_way, const Ruling& ruling) const;

  Settings settings_;
  DwaSettings dwa_in_tube_;  // looks no farther than its headings
  Variant variant_;
  Guard guard_;
  CommandFollower follower_;
  WayKeeper way_keeper_;
  Way way_;
  Arrival arrival_;
  Observer observer_;
  Road road_;
  Avoidance avoidance_;
  Stuck stuck_;
  TurnOnTheSpot turn_;
};

}  // namespace aisle::local_planner
