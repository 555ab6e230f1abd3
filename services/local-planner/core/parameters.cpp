#include "services/local-planner/core/parameters.hpp"

#include <algorithm>
#include <iterator>

namespace aisle::local_planner {
namespace {

constexpr double kMostWeight = 100.0;

std::string text_of(double value) {
  std::string text = std::to_string(value);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

}  // namespace

std::vector<Parameter> parameters_of(Variant& variant) {
  std::vector<Parameter> all;
  for (WeightedCritic& critic : variant.critics) all.push_back({critic.symbol, &critic.weight, 0.0, kMostWeight});

  PaperLimits& limits = variant.paper;
  AsPrinted& printed = variant.printed;
  const Parameter others[] = {
      {"max_speed_mps", &limits.max_speed_mps, 0.05, 10.0},
      {"max_turn_radps", &limits.max_turn_radps, 0.05, 10.0},
      {"max_acceleration_mps2", &limits.max_acceleration_mps2, 0.05, 20.0},
      {"max_deceleration_mps2", &limits.max_deceleration_mps2, 0.05, 20.0},
      {"max_turn_acceleration_radps2", &limits.max_turn_acceleration_radps2, 0.05, 50.0},
      {"horizon_s", &limits.horizon_s, 0.5, 10.0},
      {"interval_s", &printed.interval_s, 0.02, 0.5},
      {"linear_step_mps", &printed.linear_step_mps, 0.001, 1.0},
      {"angular_step_radps", &printed.angular_step_radps, 0.001, 1.0},
      {"next_target_m", &printed.next_target_m, 0.05, 10.0},
      {"path_step_m", &printed.path_step_m, 0.05, 10.0},
      {"path_ahead_m", &printed.path_ahead_m, 0.05, 10.0},
      {"clearance_cap_m", &printed.clearance_cap_m, 0.05, 5.0},
      {"mover_cap_m", &printed.mover_cap_m, 0.05, 5.0},
      {"radius_m", &printed.radius_m, 0.05, 5.0},
  };
  all.insert(all.end(), std::begin(others), std::end(others));
  return all;
}

std::string set_parameter(Variant& variant, const std::string& name, double value) {
  const std::vector<Parameter> all = parameters_of(variant);
  const auto found = std::find_if(all.begin(), all.end(), [&](const Parameter& it) { return it.name == name; });
  if (found == all.end()) {
    std::string names;
    for (const Parameter& it : all) names += (names.empty() ? "" : ", ") + it.name;
    return variant.name + " has no parameter '" + name + "'; there are " + names;
  }
  if (!(value >= found->least && value <= found->most))
    return variant.name + "." + name + " is a number from " + text_of(found->least) + " to " + text_of(found->most);
  *found->value = value;
  return {};
}

}  // namespace aisle::local_planner
