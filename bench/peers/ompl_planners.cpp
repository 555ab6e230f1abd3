#include "bench/peers/ompl_planners.hpp"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <memory>
#include <stdexcept>
#include <utility>

#include "common/grid/line_of_sight.hpp"

namespace aisle::bench {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

/// In map.
geometry::Point2 point(const ob::State* state) {
  const double* values = state->as<ob::RealVectorStateSpace::StateType>()->values;
  return {values[0], values[1]};
}

/// Our own line check, so that OMPL does not pay for one that looks at many more points.
class LineOfSight final : public ob::MotionValidator {
 public:
  LineOfSight(const ob::SpaceInformationPtr& space, const grid::ClearanceField& clearance)
      : MotionValidator(space), clearance_(clearance) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    return grid::is_line_free(clearance_, point(from), point(to), 1e-6);
  }

  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last_valid) const override {
    last_valid.second = 0.0;
    if (last_valid.first != nullptr) si_->copyState(last_valid.first, from);
    return checkMotion(from, to);
  }

 private:
  const grid::ClearanceField& clearance_;
};

/// @throws std::invalid_argument
ob::PlannerPtr made(const std::string& planner, const ob::SpaceInformationPtr& space) {
  if (planner == "RRTConnect") return std::make_shared<og::RRTConnect>(space);
  if (planner != "BITstar") throw std::invalid_argument("OMPL planner " + planner);
  return std::make_shared<og::BITstar>(space);
}

/// Once a process: no log, a fixed seed.
void keep_quiet_and_repeatable() {
  static const bool once = [] {
    ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
    ompl::RNG::setSeed(1);
    return true;
  }();

  static_cast<void>(once);
}

}  // namespace

/// The plane within the map's bounds, with our own checks of states and motions.
PeerAnswer ompl_plan(const std::string& planner, const grid::ClearanceField& clearance, geometry::Point2 start_in_map,
                     geometry::Point2 goal_in_map, double limit_s) {
  keep_quiet_and_repeatable();

  const grid::Geometry& g = clearance.geometry();
  auto plane = std::make_shared<ob::RealVectorStateSpace>(2);
  ob::RealVectorBounds bounds(2);

  bounds.setLow(0, g.origin_in_map.x);
  bounds.setLow(1, g.origin_in_map.y);
  bounds.setHigh(0, g.origin_in_map.x + g.width * g.resolution_m);
  bounds.setHigh(1, g.origin_in_map.y + g.height * g.resolution_m);
  plane->setBounds(bounds);

  og::SimpleSetup setup(plane);
  setup.setStateValidityChecker([&](const ob::State* state) { return clearance.clearance_m(point(state)) > 0.0; });
  setup.getSpaceInformation()->setMotionValidator(
      std::make_shared<LineOfSight>(setup.getSpaceInformation(), clearance));

  ob::ScopedState<> start(plane);
  ob::ScopedState<> goal(plane);

  start[0] = start_in_map.x;
  start[1] = start_in_map.y;
  goal[0] = goal_in_map.x;
  goal[1] = goal_in_map.y;
  setup.setStartAndGoalStates(start, goal);

  // Any length will do: else BIT* would go on improving until the limit.
  const auto shortest = std::make_shared<ob::PathLengthOptimizationObjective>(setup.getSpaceInformation());
  shortest->setCostThreshold(shortest->infiniteCost());
  setup.setOptimizationObjective(shortest);
  setup.setPlanner(made(planner, setup.getSpaceInformation()));

  PeerAnswer answer;

  const auto solved = setup.solve(
      ob::plannerOrTerminationCondition(ob::timedPlannerTerminationCondition(limit_s),
                                        ob::exactSolnPlannerTerminationCondition(setup.getProblemDefinition())));

  answer.is_found = solved == ob::PlannerStatus::EXACT_SOLUTION;
  if (answer.is_found) answer.length_cells = setup.getSolutionPath().length() / g.resolution_m;

  return answer;
}

}  // namespace aisle::bench
