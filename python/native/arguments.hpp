#pragma once

#include <map>
#include <string>
#include <vector>

#include "tools/lab/parameters/parameter_values.hpp"
#include "tools/lab/planning/subject.hpp"

namespace aisle::python {

/// Parameters by name, with their values as texts: "alpha", "wang.alpha" or "local.wang.alpha" -> "0.1".
using Texts = std::map<std::string, std::string>;

/// Of x, y or x, y, yaw: metres and radians in map. @throws config::BadInput that names `what`
lab::Place place_of(const std::string& what, const std::vector<double>& numbers);

/// `value` itself. @throws config::BadInput that names the argument `what`, unless it lies within `least` and `most`
double within(const std::string& what, double value, double least, double most);

/// The parameters of a call. A bare name is one of `planner` on `side`; names without a side are of either.
/// @throws config::BadInput for an unknown name or a value out of range
std::vector<lab::ParameterValue> values_of(const Texts& texts, lab::Side side, const std::string& planner);

}  // namespace aisle::python
