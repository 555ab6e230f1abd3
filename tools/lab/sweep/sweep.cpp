#include "tools/lab/sweep/sweep.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "common/config/nearest_name.hpp"
#include "common/config/reader.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tools/lab/planning/paper_maps.hpp"

namespace aisle::lab {
namespace {

constexpr std::size_t kMostSeeds = 1'000'000;
constexpr std::size_t kMostTrials = 10'000'000;

void check_name(const char* what, const std::string& name, const std::vector<std::string>& known) {
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  const std::string nearest = config::nearest_name(name, known);
  throw config::BadInput(fmt::format("{}: '{}' is unknown; {}there are {}", what, name,
                                     nearest.empty() ? "" : "did you mean '" + nearest + "'? ",
                                     fmt::join(known, ", ")));
}

template <class All>
std::vector<std::string> names_of(const All& all) {
  std::vector<std::string> names;
  for (const auto& one : all) names.emplace_back(one.name);
  return names;
}

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::size_t from = 0;
  for (std::size_t end = text.find(at); end != std::string::npos; from = end + 1, end = text.find(at, from))
    parts.push_back(text.substr(from, end - from));
  parts.push_back(text.substr(from));
  return parts;
}

/// Does the parameter vary for these planners?
bool applies(const NamedParameter& parameter, const std::string& planner, const std::string& local) {
  if (parameter.planner == kGlobalSettings || parameter.planner == kLocalSettings) return true;
  return parameter.planner == (parameter.side == Side::kGlobal ? planner : local);
}

/// Every combination of the values that apply, the last parameter fastest.
std::vector<std::vector<ParameterValue>> combinations(const Sweep& sweep, const std::string& planner,
                                                      const std::string& local) {
  std::vector<std::vector<ParameterValue>> all{{}};
  for (const Variation& variation : sweep.vary) {
    if (!applies(variation.parameter, planner, local)) continue;

    std::vector<std::vector<ParameterValue>> longer;
    for (const std::vector<ParameterValue>& values : all) {
      for (const std::string& value : variation.values) {
        longer.push_back(values);
        longer.back().push_back(
            {variation.parameter.side, variation.parameter.planner, variation.parameter.name, value});
      }
    }
    all = std::move(longer);
  }

  return all;
}

/// A path over a file's map is the same for every seed.
std::vector<std::uint64_t> seeds_of(const Sweep& sweep, std::size_t subject) {
  const bool depends = sweep.drives || subject >= sweep.maps.size();
  return depends ? sweep.seeds : std::vector<std::uint64_t>{sweep.seeds.front()};
}

void check_where(const Sweep& sweep) {
  if (subject_count(sweep) == 0)
    throw config::BadInput("nothing to sweep over: give --map FILE, --kind NAME, or with --drive --scenario NAME");
  if (!sweep.drives && !sweep.scenarios.empty())
    throw config::BadInput("--scenario is driven, not planned: give --drive too");
  if (sweep.as_printed && !sweep.scenarios.empty())
    throw config::BadInput("--as-printed drives over maps: --scenario has a fleet and drives of our own");
  if ((sweep.as_printed || sweep.paper_limits) && !sweep.drives)
    throw config::BadInput("--as-printed and --paper-limits are of drives: give --drive too");
  if (!sweep.drives && sweep.seeds.size() > 1 && sweep.kinds.empty())
    throw config::BadInput(
        "--seeds: a path over a file's map is the same for every seed; seeds draw the maps of a --kind, and drives");
  for (const std::string& kind : sweep.kinds) check_name("--kind", kind, names_of(paper_map_kinds()));
}

void check_planners(const Sweep& sweep) {
  if (sweep.planners.empty()) throw config::BadInput("give --planner NAME, one or more, or 'all'");
  for (const std::string& planner : sweep.planners)
    check_name("--planner", planner, names_of(global_planner::all_variants()));
  for (const std::string& local : sweep.locals) check_name("--local", local, names_of(local_planner::all_variants()));
  if (sweep.drives && sweep.locals.empty()) throw config::BadInput("give --local NAME, one or more");
}

}  // namespace

std::size_t subject_count(const Sweep& sweep) {
  return sweep.maps.size() + sweep.kinds.size() + sweep.scenarios.size();
}

std::string subject_name(const Sweep& sweep, std::size_t subject) {
  if (subject < sweep.maps.size()) return sweep.maps[subject].map.string();
  subject -= sweep.maps.size();
  return subject < sweep.kinds.size() ? sweep.kinds[subject] : sweep.scenarios[subject - sweep.kinds.size()];
}

std::vector<Trial> trials_of(const Sweep& sweep, const std::vector<std::size_t>& queries) {
  const std::vector<std::string> no_local{""};
  std::vector<Trial> trials;
  const auto add = [&](Trial trial) {
    for (const std::vector<ParameterValue>& values : combinations(sweep, trial.planner, trial.local)) {
      if (trials.size() >= kMostTrials) throw config::BadInput("a sweep has at most 10000000 trials: make it smaller");
      trial.index = trials.size();
      trial.values = values;
      trials.push_back(trial);
    }
  };

  for (std::size_t subject = 0; subject < queries.size(); ++subject)
    for (std::size_t query = 0; query < queries[subject]; ++query)
      for (const std::uint64_t seed : seeds_of(sweep, subject))
        for (const std::string& planner : sweep.planners)
          for (const std::string& local : sweep.drives ? sweep.locals : no_local)
            add({0, subject, query, seed, planner, local, {}});

  return trials;
}

void check(const Sweep& sweep) {
  check_where(sweep);
  check_planners(sweep);

  InUse in_use{sweep.planners, {}, sweep.paper_limits, sweep.as_printed};
  if (sweep.drives) in_use.local = sweep.locals;
  check_in_use("--set", sweep.set, in_use);

  for (const Variation& variation : sweep.vary) {
    const NamedParameter& it = variation.parameter;
    check_in_use("--vary", {{it.side, it.planner, it.name, it.default_value}}, in_use);
    for (const ParameterValue& value : sweep.set)
      if (value.full_name() == it.full_name())
        throw config::BadInput("--vary: " + it.full_name() + " is also given by --set: give it once");
  }
}

std::vector<std::uint64_t> parse_seeds(const std::string& flag, const std::string& text) {
  const auto fail = [&] {
    throw config::BadInput(
        fmt::format("{}: '{}' is not a list of seeds from 0 to 1000000000; write e.g. 1-30 or 1,2,5", flag, text));
  };
  const auto number = [&](const std::string& digits) {
    std::uint64_t value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (error != std::errc{} || end != digits.data() + digits.size() || value > 1'000'000'000) fail();
    return value;
  };

  std::vector<std::uint64_t> seeds;
  for (const std::string& part : split(text, ',')) {
    const std::vector<std::string> ends = split(part, '-');
    if (ends.size() > 2) fail();
    const std::uint64_t first = number(ends.front()), last = number(ends.back());
    if (last < first || last - first >= kMostSeeds) fail();
    for (std::uint64_t seed = first; seed <= last; ++seed) seeds.push_back(seed);
  }

  return seeds;
}

Variation parse_variation(const std::string& flag, const std::string& text, std::optional<Side> only) {
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos)
    throw config::BadInput(
        fmt::format("{}: '{}' is not NAME.PARAMETER=VALUE/VALUE/..., for example wang.alpha=0.05/0.1", flag, text));

  Variation variation{find_parameter(flag, text.substr(0, equals), only), split(text.substr(equals + 1), '/')};
  const NamedParameter& it = variation.parameter;
  for (const std::string& value : variation.values) check_value(flag, {it.side, it.planner, it.name, value});

  return variation;
}

}  // namespace aisle::lab
