#include "tools/lab/parameters/parameter_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "common/config/nearest_name.hpp"
#include "common/config/reader.hpp"
#include "common/config/yaml_reader.hpp"
#include "services/global-planner/core/variant.hpp"
#include "services/local-planner/core/parameters.hpp"

namespace aisle::lab {
namespace {

constexpr const char* kForm = "NAME.PARAMETER=VALUE, for example wang.alpha=0.1";

bool has_head(const std::string& text, const std::string& head) { return text.rfind(head, 0) == 0; }

/// "did you mean 'x'? " where a name is near enough.
std::string hint(const std::string& name, const std::vector<std::string>& known) {
  const std::string nearest = config::nearest_name(name, known);
  return nearest.empty() ? "" : "did you mean '" + nearest + "'? ";
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// What stands for a name that is no parameter of `side`'s planners.
[[noreturn]] void reject_name(const std::string& flag, const std::string& text, std::optional<Side> side) {
  const std::size_t dot = text.find('.');
  const std::string planner = text.substr(0, dot), name = dot == std::string::npos ? "" : text.substr(dot + 1);
  std::vector<std::string> planners, names;
  for (const NamedParameter& it : named_parameters()) {
    if (side && it.side != *side) continue;
    if (!contains(planners, it.planner)) planners.push_back(it.planner);
    if (it.planner == planner && !contains(names, it.name)) names.push_back(it.name);
  }

  if (dot == std::string::npos) throw config::BadInput(fmt::format("{}: '{}' is not {}", flag, text, kForm));
  if (names.empty())
    throw config::BadInput(fmt::format("{}: no planner '{}' has parameters; {}there are {}", flag, planner,
                                       hint(planner, planners), fmt::join(planners, ", ")));
  throw config::BadInput(fmt::format("{}: {} has no parameter '{}'; {}there are {}", flag, planner, name,
                                     hint(name, names), fmt::join(names, ", ")));
}

/// Why the value is refused; empty: it is not.
std::string refusal_of(const ParameterValue& value) {
  if (value.side == Side::kGlobal && value.planner == kGlobalSettings) {
    global_planner::FleetSettings settings;
    return set_setting(settings, value.name, value.value);
  }

  if (value.side == Side::kLocal && value.planner == kLocalSettings) {
    local_planner::Settings settings;
    return set_setting(settings, value.name, value.value);
  }

  if (value.side == Side::kLocal) {
    local_planner::Variant variant = *local_planner::find_variant(value.planner);
    return local_planner::set_parameter(variant, value.name, value.value);
  }

  try {
    global_planner::find_variant(value.planner)->make(global_parameters({value}, value.planner));
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return {};
}

/// One planner's section of a parameter file: each key that is there becomes a value.
struct PlannerSection {
  Side side;
  const std::string& planner;
  std::vector<ParameterValue>& values;

  template <class Reader>
  void describe(Reader& r) {
    for (const NamedParameter& it : named_parameters()) {
      if (it.side != side || it.planner != planner) continue;
      std::string text;
      r.field(it.name.c_str(), text);
      if (!r.has(it.name.c_str())) continue;

      values.push_back({side, planner, it.name, text});
      const std::string refusal = refusal_of(values.back());
      if (!refusal.empty()) r.reject(it.name.c_str(), refusal);
    }
  }
};

/// One side's section: a planner's section each.
struct SideSection {
  Side side;
  std::vector<ParameterValue>& values;

  template <class Reader>
  void describe(Reader& r) {
    std::vector<std::string> planners;
    for (const NamedParameter& it : named_parameters())
      if (it.side == side && !contains(planners, it.planner)) planners.push_back(it.planner);

    for (const std::string& planner : planners) {
      PlannerSection section{side, planner, values};
      r.section(planner.c_str(), section);
    }
  }
};

struct ParameterFile {
  std::vector<ParameterValue> values;

  template <class Reader>
  void describe(Reader& r) {
    SideSection global{Side::kGlobal, values}, local{Side::kLocal, values};
    r.section("global", global).section("local", local);
  }
};

/// Which of the two a parameter's condition asks for.
bool counts(const NamedParameter& parameter, const InUse& in_use) {
  if (parameter.condition.empty() || in_use.as_printed) return true;
  return in_use.paper_limits && has_head(parameter.condition, "--paper-limits");
}

}  // namespace

NamedParameter find_parameter(const std::string& flag, const std::string& text, std::optional<Side> only) {
  std::optional<Side> side = only;
  std::string rest = text;
  for (const Side one : {Side::kGlobal, Side::kLocal}) {
    const std::string head = std::string(name(one)) + ".";
    if (!has_head(text, head)) continue;
    if (only && one != *only)
      throw config::BadInput(fmt::format("{}: '{}': only {} planners are used here", flag, text, name(*only)));
    side = one;
    rest = text.substr(head.size());
  }

  std::vector<NamedParameter> found;
  for (const NamedParameter& it : named_parameters())
    if (it.planner + "." + it.name == rest && (!side || it.side == *side)) found.push_back(it);

  if (found.empty()) reject_name(flag, rest, side);
  if (found.size() > 1)
    throw config::BadInput(fmt::format("{}: the global and the local planner both have {}: write global.{} or local.{}",
                                       flag, rest, rest, rest));
  return found.front();
}

ParameterValue parse_parameter(const std::string& flag, const std::string& text, std::optional<Side> only) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) throw config::BadInput(fmt::format("{}: '{}' is not {}", flag, text, kForm));

  const NamedParameter parameter = find_parameter(flag, text.substr(0, equals), only);
  ParameterValue value{parameter.side, parameter.planner, parameter.name, text.substr(equals + 1)};
  check_value(flag, value);
  return value;
}

void check_value(const std::string& flag, const ParameterValue& value) {
  const std::string refusal = refusal_of(value);
  if (refusal.empty()) return;

  const bool names_itself = has_head(refusal, value.planner + ".") || has_head(refusal, value.planner + " ");
  throw config::BadInput(flag + ": " + (names_itself ? "" : value.planner + ".") + refusal);
}

std::vector<ParameterValue> read_parameter_file(const std::filesystem::path& file) {
  ParameterFile read;
  config::read_yaml_file(file, read);
  return read.values;
}

global_planner::Parameters global_parameters(const std::vector<ParameterValue>& values, const std::string& planner) {
  global_planner::Parameters parameters;
  for (const ParameterValue& value : values)
    if (value.side == Side::kGlobal && value.planner == planner) parameters.set(value.name, value.value);
  return parameters;
}

local_planner::Variant local_variant(const std::vector<ParameterValue>& values, const std::string& planner) {
  local_planner::Variant variant = *local_planner::find_variant(planner);
  for (const ParameterValue& value : values)
    if (value.side == Side::kLocal && value.planner == planner)
      local_planner::set_parameter(variant, value.name, value.value);
  return variant;
}

void set_settings(const std::vector<ParameterValue>& values, global_planner::FleetSettings& fleet,
                  local_planner::Settings& local) {
  for (const ParameterValue& value : values) {
    if (value.planner == kGlobalSettings) set_setting(fleet, value.name, value.value);
    if (value.planner == kLocalSettings) set_setting(local, value.name, value.value);
  }
}

void check_in_use(const std::string& flag, const std::vector<ParameterValue>& values, const InUse& in_use) {
  for (const ParameterValue& value : values) {
    const bool is_setting = value.planner == kGlobalSettings || value.planner == kLocalSettings;
    const std::vector<std::string>& planners = value.side == Side::kGlobal ? in_use.global : in_use.local;
    if (!is_setting && !contains(planners, value.planner))
      throw config::BadInput(fmt::format("{}: {} is of another {} planner than is used here: {}", flag,
                                         value.full_name(), name(value.side),
                                         planners.empty() ? "none" : fmt::format("{}", fmt::join(planners, ", "))));
    if (is_setting && in_use.local.empty())
      throw config::BadInput(fmt::format("{}: {} counts in drives only", flag, value.full_name()));

    const NamedParameter parameter = find_parameter(flag, value.full_name());
    if (!counts(parameter, in_use))
      throw config::BadInput(fmt::format("{}: {} counts only with {}", flag, value.full_name(), parameter.condition));
  }
}

}  // namespace aisle::lab
