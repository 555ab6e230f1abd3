#include "tools/lab/planning/ompl_planners.hpp"

#include <ompl/base/MotionValidator.h>
#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/RealVectorStateSpace.h>
#include <ompl/config.h>
#include <ompl/geometric/PathGeometric.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/rrt/InformedRRTstar.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include <chrono>
#include <stdexcept>
#include <utility>

#include "services/global-planner/core/drivable.hpp"

namespace aisle::lab {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;

using global_planner::Drivable;
using global_planner::OutOfTime;
using global_planner::PlannedPath;
using global_planner::Problem;

/// In map.
geometry::Point2 point(const ob::State* state) {
  const double* values = state->as<ob::RealVectorStateSpace::StateType>()->values;
  return {values[0], values[1]};
}

/// Our own line check, so that OMPL does not pay for one that looks at many more points.
class LineOfSight final : public ob::MotionValidator {
 public:
  LineOfSight(const ob::SpaceInformationPtr& space, const Drivable& drivable)
      : MotionValidator(space), drivable_(drivable) {}

  bool checkMotion(const ob::State* from, const ob::State* to) const override {
    return drivable_.is_line_free(point(from), point(to));
  }

  bool checkMotion(const ob::State* from, const ob::State* to,
                   std::pair<ob::State*, double>& last_valid) const override {
    last_valid.second = 0.0;
    if (last_valid.first != nullptr) si_->copyState(last_valid.first, from);
    return checkMotion(from, to);
  }

 private:
  const Drivable& drivable_;
};

/// @throws std::invalid_argument
ob::PlannerPtr made(const std::string& name, const ob::SpaceInformationPtr& space) {
  if (name == "rrtconnect") return std::make_shared<og::RRTConnect>(space);
  if (name == "rrtstar") return std::make_shared<og::RRTstar>(space);
  if (name == "informed-rrtstar") return std::make_shared<og::InformedRRTstar>(space);
  if (name == "bitstar") return std::make_shared<og::BITstar>(space);
  throw std::invalid_argument("OMPL planner " + name);
}

/// The plane within the map's bounds.
ob::StateSpacePtr plane_of(const grid::Geometry& geometry) {
  auto plane = std::make_shared<ob::RealVectorStateSpace>(2);
  ob::RealVectorBounds bounds(2);

  bounds.setLow(0, geometry.origin_in_map.x);
  bounds.setLow(1, geometry.origin_in_map.y);
  bounds.setHigh(0, geometry.origin_in_map.x + geometry.width * geometry.resolution_m);
  bounds.setHigh(1, geometry.origin_in_map.y + geometry.height * geometry.resolution_m);

  plane->setBounds(bounds);
  return plane;
}

ob::ScopedState<> state_at(const ob::StateSpacePtr& plane, geometry::Point2 in_map) {
  ob::ScopedState<> state(plane);
  state[0] = in_map.x;
  state[1] = in_map.y;
  return state;
}

class OmplPlanner final : public global_planner::Planner {
 public:
  OmplPlanner(std::string name, const SamplingBounds& bounds, unsigned seed)
      : name_(std::move(name)), bounds_(bounds), seed_(seed) {
    ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  }

 private:
  /// How: the seed of all of OMPL's generators is set before any of this search is made; states and lines are judged
  /// by our own checks; a count of the planner's own questions whether to end bounds it.
  PlannedPath search(const Problem& problem, const Drivable& drivable, const OutOfTime& out_of_time) override {
    ompl::RNG::setSeed(seed_);
    const ob::StateSpacePtr plane = plane_of(drivable.geometry());
    og::SimpleSetup setup(plane);
    const ob::SpaceInformationPtr& space = setup.getSpaceInformation();
    setup.setStateValidityChecker([&](const ob::State* state) { return drivable.is_free(point(state)); });
    space->setMotionValidator(std::make_shared<LineOfSight>(space, drivable));
    setup.setStartAndGoalStates(state_at(plane, problem.start_in_map), state_at(plane, problem.goal_in_map));

    const auto shortest = std::make_shared<ob::PathLengthOptimizationObjective>(space);
    // Any length will do: else a planner would go on improving.
    if (bounds_.ends_at_first_path) shortest->setCostThreshold(shortest->infiniteCost());
    setup.setOptimizationObjective(shortest);
    setup.setPlanner(made(name_, space));

    PlannedPath plan = blank();
    const auto solved = setup.solve(ended(setup.getProblemDefinition(), out_of_time, plan.expanded));
    if (solved != ob::PlannerStatus::EXACT_SOLUTION) {
      plan.outcome = global_planner::Outcome::kOutOfTime;
      return plan;
    }

    plan.outcome = global_planner::Outcome::kFound;
    for (const ob::State* state : setup.getSolutionPath().getStates()) plan.waypoints_in_map.push_back(point(state));
    return plan;
  }

  /// Asked once an iteration. `iterations` must outlive it.
  ob::PlannerTerminationCondition ended(const ob::ProblemDefinitionPtr& definition, const OutOfTime& out_of_time,
                                        std::size_t& iterations) const {
    using Clock = std::chrono::steady_clock;
    const SamplingBounds bounds = bounds_;
    const auto begun = Clock::now();

    return ob::PlannerTerminationCondition([bounds, begun, definition, &out_of_time, &iterations] {
      if (bounds.iterations > 0 && iterations >= bounds.iterations) return true;
      ++iterations;
      if (bounds.ends_at_first_path && definition->hasExactSolution()) return true;
      if (bounds.seconds > 0.0 && Clock::now() - begun >= std::chrono::duration<double>(bounds.seconds)) return true;
      return out_of_time != nullptr && out_of_time();
    });
  }

  std::string name_;
  SamplingBounds bounds_;
  unsigned seed_;
};

}  // namespace

std::string ompl_version() {
  return "OMPL " + std::to_string(OMPL_MAJOR_VERSION) + "." + std::to_string(OMPL_MINOR_VERSION) + "." +
         std::to_string(OMPL_PATCH_VERSION);
}

std::unique_ptr<global_planner::Planner> ompl_planner(const std::string& name, const SamplingBounds& bounds,
                                                      unsigned seed) {
  if (!is_ompl_planner(name)) throw std::invalid_argument("OMPL planner " + name);
  return std::make_unique<OmplPlanner>(name, bounds, seed);
}

}  // namespace aisle::lab
