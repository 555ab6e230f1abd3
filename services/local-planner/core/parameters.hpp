#pragma once
#include <string>
#include <vector>

#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

/// In which drives a parameter counts: in all, in those with the paper's vehicle (`--paper-limits`, `--as-printed`), or
/// only in those as printed.
enum class ParameterScope { kAlways, kPaperVehicle, kAsPrinted };

/// A number of a variant, by name, with the range in which it may be set.
struct Parameter {
  std::string name;  // "alpha", "max_speed_mps"
  double* value;     // in the variant
  double least;
  double most;
  ParameterScope scope{ParameterScope::kAlways};
  std::string meaning{};  // one line
};

/// A rule of a variant, by name: what is set by words.
struct RuleParameter {
  std::string name;   // "target_rule"
  std::string value;  // in use
  std::string range;  // "one of goal, path-nodes"
  ParameterScope scope{ParameterScope::kAlways};
  std::string meaning{};
};

/// Every number of a variant: the weights by their symbols in the paper, the limits of the paper's vehicle, and what
/// the drive as printed goes by. Points into `variant`.
std::vector<Parameter> parameters_of(Variant& variant);

/// Every rule of a variant: what it aims at, and how the vehicle of the drive as printed moves.
std::vector<RuleParameter> rules_of(const Variant& variant);

/// Sets one of the numbers. @returns why it was refused: unknown, no number, or out of range; empty: it is set
std::string set_parameter(Variant& variant, const std::string& name, double value);

/// Sets a number or a rule. @returns why it was refused, or empty
std::string set_parameter(Variant& variant, const std::string& name, const std::string& text);

}  // namespace aisle::local_planner
