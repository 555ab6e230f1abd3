#include <pybind11/stl.h>

#include <algorithm>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "python/native/arguments.hpp"
#include "python/native/arrays.hpp"
#include "python/native/bindings.hpp"
#include "python/native/map.hpp"
#include "tools/lab/planning/chosen_planners.hpp"
#include "tools/lab/planning/offline_plan.hpp"

namespace aisle::python {
namespace {

namespace py = pybind11;
using global_planner::Outcome;
using global_planner::Variant;

constexpr double kFarthestLookM = 5.0;  // clearances along a path are measured this far
constexpr int kCallsBetweenSignals = 64;

const Variant& variant_of(const std::string& name) { return *lab::chosen_planners({name}).front(); }

const char* name_of(Outcome outcome) {
  switch (outcome) {
    case Outcome::kFound:
      return "found";
    case Outcome::kNoPath:
      return "no path";
    case Outcome::kStartBlocked:
      return "start blocked";
    case Outcome::kGoalBlocked:
      return "goal blocked";
    case Outcome::kOutOfMap:
      return "out of map";
    case Outcome::kOutOfTime:
      break;
  }
  return "out of time";
}

/// (n, 2) positions; headings (n,) or none; distances (n,) to what is not free; figures by name.
py::dict dict_of(const lab::Answer& answer, const grid::ClearanceField& clearance, const std::string& refusal) {
  const global_planner::PlannedPath& plan = answer.plan;
  const global_planner::PathFigures& figures = answer.figures;
  std::vector<double> positions_m, clearances_m;
  for (const geometry::Point2& point : plan.waypoints_in_map) {
    positions_m.insert(positions_m.end(), {point.x, point.y});
    clearances_m.push_back(clearance.clearance_m(point));
  }

  using namespace pybind11::literals;
  return py::dict("outcome"_a = name_of(plan.outcome), "refusal"_a = refusal, "fault"_a = answer.fault,
                  "positions_m"_a = array_of(positions_m, 2), "headings_rad"_a = array_of(plan.headings_rad),
                  "clearance_m"_a = array_of(clearances_m), "length_m"_a = figures.length_m, "nodes"_a = figures.nodes,
                  "turning_points"_a = figures.turning_points, "turning_angle_rad"_a = figures.turning_angle_rad,
                  "least_clearance_m"_a = figures.least_clearance_m, "expanded"_a = plan.expanded,
                  "time_us"_a = answer.time_us);
}

// Of every length that a vehicle needs.
constexpr double kLargestM = 100.0;
constexpr double kSmallestSideM = 0.001;

/// Of length, width, ahead. @throws config::BadInput
geometry::Footprint outline_of(const std::vector<double>& footprint_m) {
  return geometry::rectangle(within("footprint_m: length", footprint_m.at(0), kSmallestSideM, kLargestM),
                             within("footprint_m: width", footprint_m.at(1), kSmallestSideM, kLargestM),
                             within("footprint_m: ahead", footprint_m.at(2), -kLargestM, kLargestM));
}

/// `task` says what the vehicle needs; the rest is filled in here.
py::dict plan(const Map& map, const lab::Place& start, const lab::Place& goal, const std::string& planner,
              const Texts& parameters, lab::OfflineTask task) {
  const Variant& variant = variant_of(planner);
  const std::vector<lab::ParameterValue> values = values_of(parameters, lab::Side::kGlobal, planner);
  lab::check_in_use("parameters", values, {{planner}, {}});

  task.queries = {{start.in_map, goal.in_map, 0.0}};
  task.start_yaw_rad = start.yaw_rad;
  task.goal_yaw_rad = goal.yaw_rad;
  task.parameters[planner] = lab::global_parameters(values, planner);

  lab::Answer answer;
  std::string refusal;
  std::shared_ptr<const grid::ClearanceField> clearance;
  {
    const py::gil_scoped_release unlocked;
    clearance = map.clearance(std::max(kFarthestLookM, task.needed_clearance_m() + 1.0));
    refusal = lab::plan_offline(task, {&variant}, *clearance, interruption(kCallsBetweenSignals),
                                [&](const lab::OfflineAnswer& it) { answer = it.answer; })
                  .refusal;
  }

  raise_if_interrupted();
  return dict_of(answer, *clearance, refusal);
}

/// Of a name with its planner. @throws config::BadInput with the nearest name for one that does not exist
void check_parameter_name(const std::string& name) { lab::find_parameter("parameters", name); }

py::list planners() {
  py::list all;
  for (const Variant& variant : global_planner::all_variants())
    all.append(py::make_tuple(variant.name, variant.summary));
  return all;
}

/// (side, planner, name, default, unit, range, condition, meaning) of each.
py::list parameters(const std::string& planner) {
  py::list all;
  for (const lab::NamedParameter& it : lab::parameters_of_planner(planner))
    all.append(py::make_tuple(lab::name(it.side), it.planner, it.name, it.default_value, it.unit, it.range,
                              it.condition, it.meaning));
  return all;
}

}  // namespace

void bind_planning(py::module_& module) {
  module.def("planners", &planners);
  module.def("parameters", &parameters, py::arg("planner"));
  module.def("check_parameter_name", &check_parameter_name, py::arg("name"));
  module.def(
      "plan",
      [](const Map& map, const std::vector<double>& start, const std::vector<double>& goal, const std::string& planner,
         const Texts& parameters, double radius_m, const std::vector<double>& footprint_m, double safe_distance_m,
         double preferred_clearance_m, double turning_radius_m, bool nearest) {
        lab::OfflineTask task;
        task.radius_m = within("radius_m", radius_m, 0.0, kLargestM);
        if (!footprint_m.empty()) task.outline = outline_of(footprint_m);
        task.safe_distance_m = within("safe_distance_m", safe_distance_m, 0.0, kLargestM);
        task.preferred_clearance_m = within("preferred_clearance_m", preferred_clearance_m, 0.0, kLargestM);
        task.turning_radius_m = within("turning_radius_m", turning_radius_m, 0.0, kLargestM);
        task.goes_to_nearest = nearest;
        return plan(map, place_of("start", start), place_of("goal", goal), planner, parameters, std::move(task));
      },
      py::arg("map"), py::arg("start"), py::arg("goal"), py::arg("planner"), py::arg("parameters"), py::arg("radius_m"),
      py::arg("footprint_m"), py::arg("safe_distance_m"), py::arg("preferred_clearance_m"), py::arg("turning_radius_m"),
      py::arg("nearest"));
}

}  // namespace aisle::python
