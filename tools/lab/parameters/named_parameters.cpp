#include "tools/lab/parameters/named_parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "common/config/nearest_name.hpp"
#include "common/config/reader.hpp"
#include "services/global-planner/core/variant.hpp"
#include "services/local-planner/core/parameters.hpp"

namespace aisle::lab {
namespace {

/// By the ending of the name, where units stand in this program.
std::string unit_of(const std::string& name) {
  static const std::pair<const char*, const char*> kUnits[] = {
      {"_radps2", "rad/s^2"}, {"_radps", "rad/s"}, {"_mps2", "m/s^2"}, {"_mps", "m/s"},
      {"_rad", "rad"},        {"_m", "m"},         {"_s", "s"}};
  for (const auto& [ending, unit] : kUnits) {
    const std::string end = ending;
    if (name.size() > end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0) return unit;
  }
  return "-";
}

const char* condition_of(local_planner::ParameterScope scope) {
  switch (scope) {
    case local_planner::ParameterScope::kPaperVehicle:
      return "--paper-limits or --as-printed";
    case local_planner::ParameterScope::kAsPrinted:
      return "--as-printed";
    case local_planner::ParameterScope::kAlways:
      break;
  }
  return "";
}

void add_global(std::vector<NamedParameter>& all) {
  for (const global_planner::Variant& variant : global_planner::all_variants())
    for (const global_planner::Parameter& it : variant.parameters())
      all.push_back({Side::kGlobal, variant.name, it.name, it.value, unit_of(it.name), it.range, "", it.meaning});
}

void add_local(std::vector<NamedParameter>& all) {
  for (local_planner::Variant variant : local_planner::all_variants()) {
    for (const local_planner::Parameter& it : local_planner::parameters_of(variant))
      all.push_back({Side::kLocal, variant.name, it.name, fmt::format("{}", *it.value), unit_of(it.name),
                     fmt::format("{} to {}", it.least, it.most), condition_of(it.scope), it.meaning});
    for (const local_planner::RuleParameter& it : local_planner::rules_of(variant))
      all.push_back({Side::kLocal, variant.name, it.name, it.value, unit_of(it.name), it.range, condition_of(it.scope),
                     it.meaning});
  }
}

/// Takes the fields of a settings struct as its describe() names them: lists them.
class Listing {
 public:
  Listing(Side side, const char* planner, std::vector<NamedParameter>& all)
      : side_(side), planner_(planner), all_(all) {}

  Listing& field(const char* key, double& value, double low, double high) {
    return add(key, fmt::format("{}", value), fmt::format("{} to {}", low, high));
  }
  Listing& field(const char* key, int& value, int low, int high) {
    return add(key, std::to_string(value), fmt::format("{} to {}, whole", low, high));
  }
  Listing& field(const char* key, bool& value) { return add(key, value ? "true" : "false", "one of true, false"); }

 private:
  Listing& add(const char* key, std::string value, std::string range) {
    all_.push_back({side_, planner_, key, std::move(value), unit_of(key), std::move(range), "",
                    fmt::format("as in deploy/config/{}.yaml", planner_)});
    return *this;
  }

  Side side_;
  const char* planner_;
  std::vector<NamedParameter>& all_;
};

/// Takes the fields likewise: sets the one of this name.
class Setting {
 public:
  Setting(const std::string& name, const std::string& text) : name_(name), text_(text) {}

  Setting& field(const char* key, double& value, double low, double high) {
    return set(key, value, low, high, "a number");
  }
  Setting& field(const char* key, int& value, int low, int high) {
    return set(key, value, low, high, "a whole number");
  }
  Setting& field(const char* key, bool& value) {
    if (name_ != key) return *this;
    refusal_ = text_ == "true" || text_ == "false" ? "" : fmt::format("{}: '{}' is not true or false", key, text_);
    if (refusal_.empty()) value = text_ == "true";
    return *this;
  }

  /// Empty: it is set.
  const std::string& refusal() const { return refusal_; }

 private:
  template <class Number>
  Setting& set(const char* key, Number& value, Number low, Number high, const char* kind) {
    if (name_ != key) return *this;
    Number read{};
    const char* end = text_.data() + text_.size();
    const auto [stopped, error] = std::from_chars(text_.data(), end, read);
    const bool fits = error == std::errc{} && stopped == end && read >= low && read <= high;
    refusal_ = fits ? "" : fmt::format("{}: '{}' is not {} from {} to {}", key, text_, kind, low, high);
    if (fits) value = read;
    return *this;
  }

  const std::string& name_;
  const std::string& text_;
  std::string refusal_{"there is no such setting"};
};

std::vector<NamedParameter> listed() {
  std::vector<NamedParameter> all;
  add_global(all);
  add_local(all);

  global_planner::FleetSettings fleet;
  Listing global_settings(Side::kGlobal, kGlobalSettings, all);
  fleet.describe(global_settings);

  local_planner::Settings local;
  Listing local_settings(Side::kLocal, kLocalSettings, all);
  local.describe(local_settings);

  return all;
}

template <class Settings>
std::string set(Settings& settings, const std::string& name, const std::string& text) {
  Setting setting(name, text);
  settings.describe(setting);
  return setting.refusal();
}

}  // namespace

const char* name(Side side) { return side == Side::kGlobal ? "global" : "local"; }

std::string NamedParameter::full_name() const { return std::string(lab::name(side)) + "." + planner + "." + name; }

const std::vector<NamedParameter>& named_parameters() {
  static const std::vector<NamedParameter> all = listed();
  return all;
}

std::vector<NamedParameter> parameters_of_planner(const std::string& planner) {
  std::vector<NamedParameter> found;
  std::vector<std::string> planners;
  for (const NamedParameter& it : named_parameters()) {
    if (planner.empty() || it.planner == planner) found.push_back(it);
    if (std::find(planners.begin(), planners.end(), it.planner) == planners.end()) planners.push_back(it.planner);
  }
  if (!found.empty()) return found;

  const std::string nearest = config::nearest_name(planner, planners);
  throw config::BadInput(fmt::format("no planner '{}' has parameters; {}there are {}", planner,
                                     nearest.empty() ? "" : "did you mean '" + nearest + "'? ",
                                     fmt::join(planners, ", ")));
}

std::string set_setting(global_planner::FleetSettings& settings, const std::string& name, const std::string& text) {
  return set(settings, name, text);
}

std::string set_setting(local_planner::Settings& settings, const std::string& name, const std::string& text) {
  return set(settings, name, text);
}

}  // namespace aisle::lab
