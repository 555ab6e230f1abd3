#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/global-planner/core/traffic/joint_plan.hpp"
#include "services/global-planner/core/traffic/space_time_search.hpp"
#include "services/global-planner/core/traffic/timetable.hpp"

namespace aisle::global_planner::traffic {

/// Plans one vehicle at a time among the plans of all others: to its goal, to a place of rest, or near a goal that is
/// taken. Groups, improvement and the last resort are made of these.
class WayFinder {
 public:
  WayFinder(Roadmap& roadmap, Timetable& timetable, SpaceTimeSearch& search, const JointPlan::Settings& settings)
      : roadmap_(roadmap), timetable_(timetable), search_(search), settings_(settings) {}

  struct Terms {
    double soft_rest_s{6.0};      // how long others' rests count
    double own_way_bonus_s{0.0};  // how much later than the roadmap's an own way may end
    double latest_end_s{kForEver};
    bool is_roadmap_only{false};  // own ways are not tried
  };

  /// Where and when the agent's plan may change.
  Departure departure(const Agent& agent, double now_s);

  /// Replaces what is not granted by a way to the goal; changes nothing when there is none. @pre has a goal
  bool go(Agent& agent, double now_s, const Terms& terms);

  /// Replaces what is not granted by what is left of the agent's own way; changes nothing when that ends later. @pre
  /// has a goal
  bool go_own_way(Agent& agent, double now_s, double latest_end_s);

  /// The same to the soonest place where it is in nobody's way; nothing to do when nobody needs its place.
  bool leave(Agent& agent, double now_s, const Terms& terms);

  /// To its goal, else out of the way.
  bool go_or_leave(Agent& agent, double now_s, const Terms& terms);

  /// The same for those that rest where the agent is planned to pass, and for those in their ways.
  /// @return can all of them leave?
  bool clear_way_of(const Agent& agent, double now_s, const Terms& terms);

  /// A vehicle with an older goal at the same place, if there is one.
  const Agent* ahead_in_queue(const Agent& agent) const;

  /// Moves the agent to a place near its goal, beside the way out of it; changes nothing when there is none.
  void queue(Agent& agent, double now_s);

  /// The way that only what is granted or frozen can hinder.
  std::optional<std::vector<Leg>> way_past_plans(const Agent& agent, double now_s);

  /// Seconds alone from where its grants end to its goal; infinity: there is no way.
  double alone_s(const Agent& agent);

  /// Says in the agent why it has no plan. @pre go() failed
  void explain(Agent& agent, double now_s);

  /// The motions of the own way that the vehicle may still drive; empty: none is left.
  std::vector<MotionId> own_way_left(const Agent& agent) const;
  void remember_own_way(const Agent& agent, std::vector<MotionId> motions);
  const std::map<std::string, std::vector<MotionId>>& own_ways() const { return own_ways_; }
  void forget_own_way(const std::string& agv_id) { own_ways_.erase(agv_id); }

 private:
  struct Choice {
    std::vector<Leg> legs;
    bool is_own_way{false};
    double end_s{0.0};
  };

  /// Where a vehicle may rest: anywhere; at a place of rest, outside corridors; at one of these in a parking zone.
  enum class Rest { kAny, kStrict, kParking };

  View view_of(const Agent& agent, double now_s, double soft_rest_s) const;
  std::optional<Choice> choose(const Agent& agent, const View& view, const Terms& terms);
  void leave_out_detours(const Departure& from, const View& view, std::vector<Leg>& legs);
  MotionId motion_between(PlaceId from, PlaceId to) const;
  bool is_spare(const Agent& agent, PlaceId place, Rest rest) const;
  bool find_rest(Agent& agent, double now_s, const Terms& terms, Rest rest);
  PlaceId queue_place(const Agent& agent, double now_s);
  bool clear(const Agent& agent, double now_s, const Terms& terms, std::size_t depth);

  Roadmap& roadmap_;
  Timetable& timetable_;
  SpaceTimeSearch& search_;
  JointPlan::Settings settings_;
  std::map<std::string, std::vector<MotionId>> own_ways_;
};

}  // namespace aisle::global_planner::traffic
