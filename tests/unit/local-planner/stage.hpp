#pragma once
// One cycle's beginning with invented times, for the tests of the planner's parts.
#include <string>
#include <utility>
#include <vector>

#include "services/local-planner/core/moment.hpp"
#include "services/local-planner/core/surroundings.hpp"
#include "services/local-planner/core/way.hpp"
#include "tests/unit/local-planner/hall.hpp"

namespace aisle::local_planner {

inline constexpr time::Stamp kStart = std::chrono::seconds(100);
inline time::Stamp at_s(double later_s) { return kStart + time::from_seconds(later_s); }

/// A vehicle of radius 0.35 m that stands in a hall of 20 m x 10 m, with a plan and nothing around it.
class Stage {
 public:
  explicit Stage(geometry::Pose2 base = {3.0, 5.0, 0.0}, const grid::OccupancyGrid& grid = hall(20.0, 10.0))
      : clearance_(grid) {
    inputs.clearance = &clearance_;
    inputs.map_revision = 1;
    inputs.vehicle = Vehicle{"agv-1", geometry::disc(0.35), {}, 10.0, 0.2};
    inputs.tracker_heard = inputs.tracker_alive = kStart;
    inputs.state.set({base, {}}, kStart);
    motion.base_now = motion.base_then = base;
    give_plan({{3.0, 5.0}, {15.0, 5.0}});
  }

  void give_plan(std::vector<geometry::Point2> waypoints) {
    Plan plan;
    plan.id = 1;
    plan.goal_id = "goal-1";
    plan.map_revision = inputs.map_revision;
    plan.goal_in_map = {waypoints.back().x, waypoints.back().y, 0.0};
    plan.waypoints_in_map = std::move(waypoints);
    inputs.plan = std::move(plan);
  }

  void place(const geometry::Pose2& base) { motion.base_now = motion.base_then = base; }

  /// A lane straight along the plan, with its speed profile.
  Way straight_way() const {
    Way way;
    way.adopt(Lane(Route(resample(inputs.plan->waypoints_in_map, kRouteStepM))), motion.base_now.position(), false);
    way.profile(clearance_, inputs.vehicle->reach_m(), {});
    return way;
  }

  Moment moment(double later_s = 0.0) const {
    return {inputs, *inputs.vehicle, inputs.vehicle->discs(), motion, at_s(later_s)};
  }

  Inputs inputs;
  OwnMotion motion;
  Surroundings around;

 private:
  grid::ClearanceField clearance_;
};

inline bool is_zero(const geometry::Twist2& twist) {
  return twist.linear_mps == 0.0 && twist.angular_radps == 0.0 && twist.sideways_mps == 0.0;
}

/// A tricycle of 2.4 m x 1.1 m, which cannot turn on the spot.
inline Vehicle forklift() {
  Vehicle vehicle;
  vehicle.id = "agv-1";
  vehicle.limits.model = kinematics::Model::kTricycle;
  vehicle.footprint = geometry::rectangle(2.4, 1.1);
  return vehicle;
}

}  // namespace aisle::local_planner
