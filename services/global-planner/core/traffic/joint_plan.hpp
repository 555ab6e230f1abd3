#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "services/global-planner/core/traffic/roadmap.hpp"

namespace aisle::global_planner::traffic {

/// A motion of another vehicle that must be done before one's own may be granted.
struct Link {
  std::string agv_id;
  std::uint64_t step{0};       // done once that vehicle has reported `done > step`
  std::uint32_t agent{kNoId};  // `Agent::number` of that vehicle
};

/// One motion of a vehicle's plan.
struct Step {
  MotionId motion{kNoId};
  Shape shape;          // of the motion, and of the arc from the step before
  double begin_s{0.0};  // forecast; never decides
  double end_s{0.0};
  bool is_own_way{false};
  std::vector<Link> links;
  MotionId before{kNoId};  // the step before, whose arc is in `shape`; none: there was none when this was planned
};

/// A vehicle as the joint plan sees it. Step numbers count from its registration: the step after the one in which it
/// stands at its first place is 1. Steps `done` to `granted - 1` are being driven, those from `granted` on may change.
struct Agent {
  std::string id;
  KindId kind{0};
  PlaceId place{kNoId};      // where the first step of `steps` begins: where it stands when it has none
  std::uint64_t done{0};     // steps that it reported to be behind it
  std::uint64_t granted{0};  // steps granted, >= done
  std::vector<Step> steps;   // steps[i] has the number done + i
  double heading_rad{0.0};

  PlaceId goal{kNoId};       // where it wants to go; none: it may be sent anywhere
  double goal_since_s{0.0};  // age: the older, the more it counts
  bool has_plan_to_goal{false};
  std::vector<std::string> waits_for;  // why there is no plan: for whom
  std::string reason;                  // in words: "goal taken by agv-7"
  bool is_queueing{false};             // another one with an older goal there goes first
  bool is_frozen{false};               // dead, held or disobedient: it is planned around and never moved
  std::uint32_t number{kNoId};         // in the order of joining, never used twice

  /// Steps that are granted and not yet behind it: the first ones of `steps`.
  std::size_t pending() const { return static_cast<std::size_t>(granted - done); }

  /// The number of the first step that it has no plan for yet.
  std::uint64_t beyond() const { return done + steps.size(); }
};

/// The ways of all vehicles in space and time, and the order in which they pass where their ways meet. Forecast times
/// serve to find the order; only the order (`Step::links`) decides who goes first. No link leads in a circle.
///
/// Budgets count expanded states, not time: the same calls give the same plans.
class JointPlan {
 public:
  struct Settings {
    double gap_m{0.05};
    std::size_t most_expanded{40'000};
    double merge_s{0.3};          // reservations nearer in time are one
    double soft_rest_s{6.0};      // a rest that others may plan over ends so long after it began
    double late_s{8.0};           // a plan that takes 1.5 times the free run and this longer is late: see plan()
    double own_way_bonus_s{1.0};  // an own way is taken if it ends no later than this after the roadmap's
    double heuristic_weight{1.2};
  };

  JointPlan(Roadmap& roadmap, const Settings& settings);
  ~JointPlan();
  JointPlan(const JointPlan&) = delete;
  JointPlan& operator=(const JointPlan&) = delete;

  /// The agent rests at `place` from now on, whatever it did before; its goal stays. Those that are planned to pass
  /// there wait until it has left.
  /// @param first_step number of the next step that it will get
  Agent& add(const std::string& agv_id, KindId kind, PlaceId place, double heading_rad, double now_s,
             std::uint64_t first_step = 0);
  void remove(const std::string& agv_id);
  Agent* find(const std::string& agv_id);
  const std::map<std::string, Agent>& agents() const;

  /// Steps before `done` are behind the vehicle, and its next one is forecast from there.
  void report(const std::string& agv_id, std::uint64_t done, double now_s);

  /// The next step is granted: from now on it is earlier than all that is not.
  void grant_next(const std::string& agv_id);

  /// A plan to the agent's goal behind what is granted, among all others; changes nothing when it finds none, but for
  /// `waits_for` and `reason`.
  ///
  /// Where others rest, the plan keeps clear of them; where that fails or is late, it passes over their places later,
  /// linked to their next step beyond their plans, and they are planned to leave. Behind an older goal at the same
  /// place the agent goes to a place near it, and the result is false. Without a goal it leaves for the soonest place
  /// of rest when others need its place.
  /// @param own_way motions of the vehicle's own way from where its grants end, tried first; may be empty
  bool plan(const std::string& agv_id, const std::vector<MotionId>& own_way, double now_s);

  /// The vehicle's own way from where its grants end takes the place of its plan, if it ends no later. @pre has a plan
  /// to its goal
  bool take_own_way(const std::string& agv_id, const std::vector<MotionId>& own_way, double now_s);

  /// Vehicles that rest where others are planned to pass, and have no plan to leave yet: plan() or plan_group() them.
  /// Not those that rest at their goal, until it is taken from them.
  std::vector<std::string> asked_to_leave() const;

  /// The vehicle is never moved again until this is ended: it is dead, held or disobedient. Its plan beyond its grants
  /// ends, and so do the plans that wait for it.
  /// @return the vehicles whose plans were cut
  std::vector<std::string> freeze(const std::string& agv_id, double now_s);
  void unfreeze(const std::string& agv_id, double now_s);

  /// Replans a group around the agent: see 8.6. Keeps all or restores all.
  bool plan_group(const std::string& agv_id, double now_s);

  /// Search over configurations of all vehicles: see 8.7. False: no joint plan, or out of budget.
  bool plan_all(double now_s);

  /// One try to shorten the sum of ends: see 8.8. True when something improved.
  bool improve(double now_s, std::uint64_t& random_state);

  /// Drops all steps of the agent that are not granted; it rests where its grants end.
  void cut(const std::string& agv_id, double now_s);

  /// The granted steps from `step` on were given back with the vehicle's word; they and all behind are dropped.
  void give_back(const std::string& agv_id, std::uint64_t step, double now_s);

  /// Slips all forecasts to what was reported; the order stays.
  void retime(double now_s);

  /// Are all links of the agent's next ungranted step done? False when it has none.
  bool is_next_free(const std::string& agv_id) const;

  /// The vehicles that the agent's next ungranted step waits for.
  std::vector<std::string> next_waits_for(const std::string& agv_id) const;

  /// Places and motions that plans, goals and remembered own ways name: for Roadmap::sweep().
  std::vector<PlaceId> places_in_use() const;
  std::vector<MotionId> motions_in_use() const;

  /// What sweep() ended: nothing is remembered of these ids any more.
  void forget(const Roadmap::Ended& ended);

  /// Expanded states of all searches since the beginning.
  std::uint64_t expanded() const;

  /// Circles that retime() found: stays 0, or there is a fault.
  std::uint64_t circles() const { return circles_; }

  /// How much the oldest goal was postponed for the sake of others since it became the oldest.
  struct Patience {
    std::uint32_t agent{kNoId};
    double goal_since_s{0.0};
    double spent_s{0.0};
  };

  struct Parts;  // what is reserved, the search, and those that plan with them; see parts.hpp

 private:
  std::unique_ptr<Parts> parts_;
  std::uint64_t circles_{0};
};

}  // namespace aisle::global_planner::traffic
