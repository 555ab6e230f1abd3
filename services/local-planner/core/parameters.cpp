#include "services/local-planner/core/parameters.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <utility>

namespace aisle::local_planner {
namespace {

constexpr double kMostWeight = 100.0;
constexpr const char* kTowardsGoal = "towards-goal";

/// The shortest text that reads back as the same number.
std::string text_of(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// Strictly a number: no blanks, nothing after it. Not a number where it is none.
double number_of(const std::string& text) {
  char* end = nullptr;
  const bool begins_well = !text.empty() && text.front() != ' ';
  const double value = std::strtod(text.c_str(), &end);
  return begins_well && *end == '\0' ? value : std::nan("");
}

template <class Value>
struct Word {
  const char* name;
  Value value;
};

constexpr Word<TargetRule> kTargetRules[] = {{"goal", target_rules::goal},
                                             {"nearest-path-point", target_rules::nearest_path_point},
                                             {"path-nodes", target_rules::path_nodes},
                                             {"turning-points", target_rules::turning_points},
                                             {"local-sub-target", target_rules::local_sub_target}};
constexpr Word<kinematics::Model> kModels[] = {{"differential", kinematics::Model::kDifferential},
                                               {"omnidirectional", kinematics::Model::kOmnidirectional},
                                               {"tricycle", kinematics::Model::kTricycle}};
constexpr Word<bool> kYesOrNo[] = {{"yes", true}, {"no", false}};

template <class Value, std::size_t Count>
std::string word_of(const Word<Value> (&words)[Count], const Value& value) {
  for (const Word<Value>& word : words)
    if (word.value == value) return word.name;
  return "?";
}

template <class Value, std::size_t Count>
std::string range_of(const Word<Value> (&words)[Count]) {
  std::string text;
  for (const Word<Value>& word : words) text += (text.empty() ? "one of " : ", ") + std::string(word.name);
  return text;
}

/// False when `text` is none of the words.
template <class Value, std::size_t Count>
bool set_word(const Word<Value> (&words)[Count], const std::string& text, Value& value) {
  for (const Word<Value>& word : words) {
    if (text != word.name) continue;
    value = word.value;
    return true;
  }
  return false;
}

bool set_start_yaw(const std::string& text, std::optional<double>& yaw_rad) {
  const double value = number_of(text);
  if (text != kTowardsGoal && !(std::abs(value) <= geometry::kPi)) return false;
  yaw_rad = text == kTowardsGoal ? std::nullopt : std::optional<double>(value);
  return true;
}

/// False when `text` is no value of the rule `name`.
bool set_rule(Variant& variant, const std::string& name, const std::string& text) {
  AsPrinted& printed = variant.printed;
  if (name == "knows_path") return set_word(kYesOrNo, text, variant.knows_path);
  if (name == "rolling_window") return set_word(kYesOrNo, text, variant.has_rolling_window);
  if (name == "target_rule") return set_word(kTargetRules, text, printed.target_rule);
  if (name == "model") return set_word(kModels, text, printed.model);
  if (name == "faces_first_node") return set_word(kYesOrNo, text, printed.faces_first_node);
  return set_start_yaw(text, printed.start_yaw_rad);
}

template <class All>
auto named(All& all, const std::string& name) {
  return std::find_if(all.begin(), all.end(), [&](const auto& it) { return it.name == name; });
}

std::string unknown(Variant& variant, const std::string& name) {
  std::string names;
  for (const Parameter& it : parameters_of(variant)) names += (names.empty() ? "" : ", ") + it.name;
  for (const RuleParameter& it : rules_of(variant)) names += ", " + it.name;
  return variant.name + " has no parameter '" + name + "'; there are " + names;
}

}  // namespace

std::vector<Parameter> parameters_of(Variant& variant) {
  using Scope = ParameterScope;
  std::vector<Parameter> all;
  for (WeightedCritic& critic : variant.critics)
    all.push_back({critic.symbol, &critic.weight, 0.0, kMostWeight, Scope::kAlways,
                   "weight of a critic, by its symbol in the paper"});

  PaperLimits& limits = variant.paper;
  AsPrinted& printed = variant.printed;
  const Parameter others[] = {
      {"max_speed_mps", &limits.max_speed_mps, 0.05, 10.0, Scope::kPaperVehicle, "limit of the vehicle"},
      {"max_turn_radps", &limits.max_turn_radps, 0.05, 10.0, Scope::kPaperVehicle, "limit of the vehicle"},
      {"max_acceleration_mps2", &limits.max_acceleration_mps2, 0.05, 20.0, Scope::kPaperVehicle,
       "limit of the vehicle"},
      {"max_deceleration_mps2", &limits.max_deceleration_mps2, 0.05, 20.0, Scope::kPaperVehicle,
       "limit of the vehicle"},
      {"max_turn_acceleration_radps2", &limits.max_turn_acceleration_radps2, 0.05, 50.0, Scope::kPaperVehicle,
       "limit of the vehicle"},
      {"horizon_s", &limits.horizon_s, 0.5, 10.0, Scope::kPaperVehicle, "so far samples are simulated"},
      {"interval_s", &printed.interval_s, 0.02, 0.5, Scope::kAsPrinted, "between two choices"},
      {"linear_step_mps", &printed.linear_step_mps, 0.001, 1.0, Scope::kAsPrinted, "resolution of v"},
      {"angular_step_radps", &printed.angular_step_radps, 0.001, 1.0, Scope::kAsPrinted, "resolution of w"},
      {"next_target_m", &printed.next_target_m, 0.05, 10.0, Scope::kAsPrinted, "so near a target is reached"},
      {"path_step_m", &printed.path_step_m, 0.05, 10.0, Scope::kAsPrinted,
       "between points of the path, LI's sub-goals"},
      {"path_ahead_m", &printed.path_ahead_m, 0.05, 10.0, Scope::kAsPrinted, "WU: so far ahead the path is followed"},
      {"clearance_cap_m", &printed.clearance_cap_m, 0.05, 5.0, Scope::kAsPrinted, "more room at walls earns nothing"},
      {"mover_cap_m", &printed.mover_cap_m, 0.05, 5.0, Scope::kAsPrinted, "more room at what moves earns nothing"},
      {"radius_m", &printed.radius_m, 0.05, 5.0, Scope::kAsPrinted, "of the vehicle's disc"},
  };
  all.insert(all.end(), std::begin(others), std::end(others));
  return all;
}

std::vector<RuleParameter> rules_of(const Variant& variant) {
  using Scope = ParameterScope;
  const AsPrinted& printed = variant.printed;
  return {
      {"knows_path", word_of(kYesOrNo, variant.knows_path), range_of(kYesOrNo), Scope::kAlways,
       "no: straight at the goal, as a traditional dynamic window"},
      {"rolling_window", word_of(kYesOrNo, variant.has_rolling_window), range_of(kYesOrNo), Scope::kAlways,
       "WU: a local sub-target while a collision is predicted"},
      {"target_rule", word_of(kTargetRules, printed.target_rule), range_of(kTargetRules), Scope::kAsPrinted,
       "what the dynamic window aims at"},
      {"model", word_of(kModels, printed.model), range_of(kModels), Scope::kAsPrinted, "how the vehicle moves"},
      {"faces_first_node", word_of(kYesOrNo, printed.faces_first_node), range_of(kYesOrNo), Scope::kAsPrinted,
       "YU eq. 12: turns to the path's first node before it drives"},
      {"start_yaw_rad", printed.start_yaw_rad ? text_of(*printed.start_yaw_rad) : kTowardsGoal,
       std::string(kTowardsGoal) + ", or -3.141592 to 3.141592", Scope::kAsPrinted, "initial azimuth"},
  };
}

std::string set_parameter(Variant& variant, const std::string& name, double value) {
  const std::vector<Parameter> all = parameters_of(variant);
  const auto found = named(all, name);
  if (found == all.end()) return unknown(variant, name);

  if (!(value >= found->least && value <= found->most))
    return variant.name + "." + name + " is a number from " + text_of(found->least) + " to " + text_of(found->most);
  *found->value = value;
  return {};
}

std::string set_parameter(Variant& variant, const std::string& name, const std::string& text) {
  const std::vector<RuleParameter> rules = rules_of(variant);
  const auto rule = named(rules, name);
  if (rule == rules.end()) return set_parameter(variant, name, number_of(text));

  return set_rule(variant, name, text) ? "" : variant.name + "." + name + ": '" + text + "' is not " + rule->range;
}

}  // namespace aisle::local_planner
