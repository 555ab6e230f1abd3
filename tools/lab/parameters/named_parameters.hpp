#pragma once

#include <string>
#include <vector>

#include "services/global-planner/core/fleet_types.hpp"
#include "services/local-planner/core/settings.hpp"

namespace aisle::lab {

/// Which of the two planners a parameter belongs to.
enum class Side { kGlobal, kLocal };

/// "global" or "local".
const char* name(Side side);

/// One parameter that may be set, with what a person needs to set it.
struct NamedParameter {
  Side side;
  std::string planner;        // "wang"; "global-planner" or "local-planner": a key of that service's configuration
  std::string name;           // "alpha"
  std::string default_value;  // as published
  std::string unit;           // "m/s"; "-" where it has none
  std::string range;          // "0 to 100", "one of a, b"
  std::string condition;      // in which drives it counts: "--as-printed"; empty: in all
  std::string meaning;        // one line

  /// "global.wang.log_base"
  std::string full_name() const;
};

/// The planner name under which the settings of a service stand, whatever its variant.
inline constexpr const char* kGlobalSettings = "global-planner";
inline constexpr const char* kLocalSettings = "local-planner";

/// All of them: the variants' in the order of their names, then the services' settings.
const std::vector<NamedParameter>& named_parameters();

/// Those of the planners of this name, on both sides; all for an empty name.
/// @throws config::BadInput, with the nearest name, for a planner that has none
std::vector<NamedParameter> parameters_of_planner(const std::string& planner);

/// Sets a key of the service's configuration. @returns why it was refused, or empty
std::string set_setting(global_planner::FleetSettings& settings, const std::string& name, const std::string& text);
std::string set_setting(local_planner::Settings& settings, const std::string& name, const std::string& text);

}  // namespace aisle::lab
