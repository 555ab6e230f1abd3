#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "services/global-planner/core/parameters.hpp"
#include "services/local-planner/core/critic.hpp"
#include "tools/lab/parameters/named_parameters.hpp"

namespace aisle::lab {

/// A parameter set to a value.
struct ParameterValue {
  Side side;
  std::string planner;
  std::string name;
  std::string value;

  /// "global.wang.log_base"
  std::string full_name() const { return std::string(lab::name(side)) + "." + planner + "." + name; }

  bool operator==(const ParameterValue& other) const {
    return full_name() == other.full_name() && value == other.value;
  }
};

/// Finds the parameter that `text` names: "wang.alpha", or with its side, "global.yu.beta", which is needed where both
/// planners of that name have one. With `only`, names without a side are of that one.
/// @throws config::BadInput, beginning with `flag`, with the nearest name for an unknown planner or parameter
NamedParameter find_parameter(const std::string& flag, const std::string& text, std::optional<Side> only = {});

/// "wang.alpha=0.1". The value is checked too. @throws config::BadInput as find_parameter, also with the range
ParameterValue parse_parameter(const std::string& flag, const std::string& text, std::optional<Side> only = {});

/// Checks that the value is within its range. @throws config::BadInput, beginning with `flag`, with the range
void check_value(const std::string& flag, const ParameterValue& value);

/// A YAML file of the same, by side, planner and name:
///
///     global: {wang: {log_base: 2, passes: none}}
///     local: {wang: {alpha: 0.1}, local-planner: {horizon_s: 3}}
///
/// @throws config::BadInput with file, line, and for an unknown name the nearest one
std::vector<ParameterValue> read_parameter_file(const std::filesystem::path& file);

/// Those of the global planner `planner`, for its Variant::make. The last one of a name counts.
global_planner::Parameters global_parameters(const std::vector<ParameterValue>& values, const std::string& planner);

/// The local planner `planner` with its values. @pre there is one of this name, and the values were checked
local_planner::Variant local_variant(const std::vector<ParameterValue>& values, const std::string& planner);

/// Sets the services' settings among the values. @pre the values were checked
void set_settings(const std::vector<ParameterValue>& values, global_planner::FleetSettings& fleet,
                  local_planner::Settings& local);

/// Which planners a command runs, and how it drives: what decides whether a parameter counts.
struct InUse {
  std::vector<std::string> global;  // names of planners
  std::vector<std::string> local;   // empty where nothing is driven
  bool paper_limits{false};
  bool as_printed{false};
};

/// Refuses a value that would change nothing: of a planner that is not in use, or of another kind of drive.
/// @throws config::BadInput, beginning with `flag`
void check_in_use(const std::string& flag, const std::vector<ParameterValue>& values, const InUse& in_use);

}  // namespace aisle::lab
