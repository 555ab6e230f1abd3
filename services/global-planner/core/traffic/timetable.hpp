#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "services/global-planner/core/traffic/joint_plan.hpp"
#include "services/global-planner/core/traffic/reservations.hpp"
#include "services/global-planner/core/traffic/space_time_search.hpp"

namespace aisle::global_planner::traffic {

/// The plans of all vehicles, what they reserve of the floor, and the order in which they pass.
///
/// Of two steps that meet, the one whose forecast begins first goes first, and the other is linked to it; granted steps
/// count as earlier than all others. So each link leads to a step that is forecast to end before its own begins, and no
/// links lead in a circle. Whoever passes over a place where another rests is linked to the rester's next step beyond
/// its plan.
class Timetable {
 public:
  /// @param soft_rest_s what waits for a step that no plan has yet is forecast to wait so long
  Timetable(const Roadmap& roadmap, Meetings& meetings, double merge_s, double soft_rest_s);

  Agent& add(const std::string& agv_id, KindId kind, PlaceId place, double heading_rad, std::uint64_t first_step);
  void remove(const std::string& agv_id);
  Agent* find(const std::string& agv_id);
  Agent* at(std::uint32_t number) { return by_number_[number]; }
  std::map<std::string, Agent>& agents() { return agents_; }
  const std::map<std::string, Agent>& agents() const { return agents_; }

  const Reservations& reservations() const { return reservations_; }
  const std::unordered_map<std::uint32_t, std::vector<ReservationId>>& corridor_rests() const {
    return corridor_rests_;
  }

  /// Where the agent may change its plan: at the end of its granted steps, no earlier than now.
  Departure departure(const Agent& agent, double now_s) const;

  /// The place where its grants end, and where its plan ends.
  PlaceId granted_end(const Agent& agent) const { return end_of(agent, agent.pending()); }
  PlaceId rest_place(const Agent& agent) const { return end_of(agent, agent.steps.size()); }

  /// When its plan ends; now for one that has none.
  double end_s(const Agent& agent, double now_s) const;

  /// New steps behind the granted ones, and their order among all others.
  void replace_tail(Agent& agent, const std::vector<Leg>& legs, bool is_own_way);

  /// Ends the steps from this number on, granted or not. @pre done <= step
  void drop_from(Agent& agent, std::uint64_t step);

  /// @pre has an ungranted step, whose links are done
  void grant_next(Agent& agent);

  /// Steps before `done` are behind the vehicle. @pre done <= granted
  void report(Agent& agent, std::uint64_t done, double now_s);

  void set_frozen(Agent& agent, bool is_frozen);

  /// Is the step that it leads to behind its vehicle?
  bool is_done(const Link& link) const;

  /// Forecasts all steps anew from `now_s`, as early as the order allows; the order stays.
  ///
  /// How: a longest path over steps in the order of their links (Kahn's algorithm).
  /// @return false when links lead in a circle
  bool retime(double now_s);

  /// Vehicles that rest where another vehicle is planned to pass, and have no plan to leave.
  std::set<std::uint32_t> asked_to_leave() const;

  /// Vehicles in the way of these legs, in the order in which they are met: they rest there, or are planned to be there
  /// at that time.
  std::vector<std::string> those_met(const Agent& agent, const std::vector<Leg>& legs);

  /// From now on all changes of ungranted steps can be undone, until one of the two ends it. @pre none has begun
  void begin_trial();
  void keep_trial();
  void undo_trial();

 private:
  struct StepBook {
    ReservationId motion{kNoId};
    ReservationId corner{kNoId};
    ReservationId wait{kNoId};
  };
  struct Book {
    std::vector<StepBook> steps;  // as Agent::steps
    ReservationId rest{kNoId};
    std::uint32_t corridor{kNoId};  // in which it rests
  };
  struct StepGraph {
    struct Node {
      Step* step{nullptr};
      bool is_driven{false};
      double ready_s{0.0};  // when all that it waits for has ended, as far as that is known
      std::uint32_t waits_for{0};
    };
    struct Edge {
      std::uint32_t from{0};
      std::uint32_t to{0};
      double delay_s{0.0};
    };

    std::vector<Node> nodes;
    std::vector<Edge> edges;  // sorted by `from`
  };
  struct Tail {
    std::vector<Step> steps;
    bool has_plan_to_goal{false};
  };

  PlaceId end_of(const Agent& agent, std::size_t steps) const;
  Step step_of(const Leg& leg, MotionId before, bool is_own_way);

  void save_tail(const Agent& agent);
  void set_tail(Agent& agent, std::vector<Step> tail);
  void erase_book(Book& book, std::size_t from);
  void erase_rest(Book& book);
  void write_book(const Agent& agent);
  void write_rest(const Agent& agent);
  void write_times(const Agent& agent);

  void unlink(const Agent& agent);
  void relink(Agent& agent);
  void link_step(Agent& agent, std::size_t index);
  void link_those_over_rest(const Agent& agent);
  void link_shape(Agent& agent, std::size_t index, ShapeId shape);
  void link_corridor(Agent& agent, std::size_t index);
  void add_link(Agent& agent, std::size_t index, const Agent& to, std::uint64_t number);
  bool is_after_rest(const Agent& agent, std::size_t index, const Agent& rester) const;
  bool is_before(const Agent& a, std::size_t a_index, const Agent& b, std::size_t b_index) const;
  StepGraph graph_of_steps(double now_s);
  bool enters(const Step& step, std::uint32_t corridor) const;

  const Roadmap& roadmap_;
  Meetings& meetings_;
  Reservations reservations_;
  double soft_rest_s_;

  std::map<std::string, Agent> agents_;
  std::vector<Agent*> by_number_;  // null: has left
  std::vector<Book> books_;        // by number
  std::unordered_map<std::uint32_t, std::vector<ReservationId>> corridor_rests_;

  bool is_trial_{false};
  std::map<std::uint32_t, Tail> saved_;  // tails before the trial, by agent
};

}  // namespace aisle::global_planner::traffic
