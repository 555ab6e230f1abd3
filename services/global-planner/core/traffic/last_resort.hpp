#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <vector>

#include "services/global-planner/core/traffic/joint_step.hpp"
#include "services/global-planner/core/traffic/parts.hpp"

namespace aisle::global_planner::traffic {

/// A joint plan of all vehicles by a search over where all of them stand: LaCAM (lazily constrained depth-first search,
/// after Okumura 2023), with JointStep as its generator. A rescue: the plans that it finds are far from short.
///
///   node        where each vehicle stands
///   constraint  moves that are prescribed to the first few vehicles; each node tries them one more at a time, so all
///               joint steps are tried in the end
class LastResort {
 public:
  explicit LastResort(JointPlan::Parts& parts);

  /// Brings the vehicle with the oldest goal that has no plan to that goal; replans the others between. Keeps all or
  /// restores all.
  bool plan(double now_s);

 private:
  /// Moves prescribed to the first vehicles of the order.
  struct Constraint {
    std::shared_ptr<const Constraint> before;
    Move move;
    std::size_t depth{0};
  };

  struct Node {
    std::vector<PlaceId> places;
    std::vector<MotionId> by;         // the last motion of each vehicle
    std::vector<Move> moves;          // from the parent, in an order in which they can be driven
    std::vector<std::size_t> movers;  // whose
    std::size_t parent{0};
    std::deque<std::shared_ptr<const Constraint>> open;
  };

  bool choose_vehicles();
  void choose_obstacles();
  void begin(double now_s);
  bool search();
  bool next_step(std::size_t node, const std::shared_ptr<const Constraint>& constraint);
  std::vector<std::vector<Move>> wishes_at(const Node& node);
  double to_go_s(std::size_t vehicle, PlaceId place);
  std::size_t add_node(std::size_t parent, const JointStep& step);

  std::vector<std::vector<Leg>> schedule(double now_s);
  void commit(const std::vector<std::vector<Leg>>& legs);
  void replan_each(double now_s);

  JointPlan::Parts& parts_;
  std::vector<Agent*> vehicles_;  // the oldest goal without a plan first, those without goals last
  std::vector<PlaceId> goals_;    // kNoId: it only makes way
  std::vector<ShapeId> obstacles_;
  JointStep step_;

  std::vector<Node> nodes_;
  std::map<std::vector<PlaceId>, std::size_t> known_;
  std::size_t last_{0};  // the node in which the first vehicle is at its goal
};

}  // namespace aisle::global_planner::traffic
