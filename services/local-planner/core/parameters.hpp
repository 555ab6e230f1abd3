#pragma once
#include <string>
#include <vector>

#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

/// A number of a variant, by name, with the range in which it may be set.
struct Parameter {
  std::string name;  // "alpha", "max_speed_mps"
  double* value;     // in the variant
  double least;
  double most;
};

/// Every number of a variant: the weights by their symbols in the paper, the limits of the paper's vehicle, and what
/// the drive as printed goes by. Points into `variant`.
std::vector<Parameter> parameters_of(Variant& variant);

/// Sets one of them. @returns why it was refused: unknown, no number, or out of range; empty: it is set
std::string set_parameter(Variant& variant, const std::string& name, double value);

}  // namespace aisle::local_planner
