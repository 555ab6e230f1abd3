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

/// @returns `count`. @throws config::BadInput where it is more than a sweep may have
std::size_t checked_count(std::size_t count) {
  if (count > kMostTrials)
    throw config::BadInput(fmt::format("a sweep has at most {} trials: make it smaller", kMostTrials));
  return count;
}

/// How many combinations() there are.
std::size_t combination_count(const Sweep& sweep, const std::string& planner, const std::string& local) {
  std::size_t count = 1;
  for (const Variation& variation : sweep.vary)
    if (applies(variation.parameter, planner, local)) count = checked_count(count * variation.values.size());
  return count;
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

const std::vector<std::string>& locals_of(const Sweep& sweep) {
  static const std::vector<std::string> no_local{""};
  return sweep.drives ? sweep.locals : no_local;
}

/// Of trials_of(), counted before memory is taken for them.
std::size_t trial_count(const Sweep& sweep, const std::vector<std::size_t>& queries) {
  std::size_t per_query_and_seed = 0;
  for (const std::string& planner : sweep.planners)
    for (const std::string& local : locals_of(sweep))
      per_query_and_seed = checked_count(per_query_and_seed + combination_count(sweep, planner, local));

  std::size_t count = 0;
  for (std::size_t subject = 0; subject < queries.size(); ++subject) {
    const std::size_t seeds = checked_count(seeds_of(sweep, subject).size());
    count = checked_count(count + checked_count(checked_count(queries[subject]) * seeds) * per_query_and_seed);
  }
  return count;
}

/// What is listed twice would be run twice, and counted twice in every mean.
template <class T>
void refuse_repeats(const std::string& what, std::vector<T> listed) {
  std::sort(listed.begin(), listed.end());
  const auto twice = std::adjacent_find(listed.begin(), listed.end());
  if (twice != listed.end()) throw config::BadInput(fmt::format("{}: {} is given twice: give it once", what, *twice));
}

void check_repeats(const Sweep& sweep) {
  refuse_repeats("--kind", sweep.kinds);
  refuse_repeats("--scenario", sweep.scenarios);
  refuse_repeats("--planner", sweep.planners);
  refuse_repeats("--local", sweep.locals);
  refuse_repeats("--seeds", sweep.seeds);

  std::vector<std::string> varied;
  for (const Variation& variation : sweep.vary) {
    varied.push_back(variation.parameter.full_name());
    refuse_repeats("--vary: " + varied.back(), variation.values);
  }
  refuse_repeats("--vary", varied);
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
  std::vector<Trial> trials;
  trials.reserve(trial_count(sweep, queries));
  const auto add = [&](Trial trial) {
    for (const std::vector<ParameterValue>& values : combinations(sweep, trial.planner, trial.local)) {
      trial.index = trials.size();
      trial.values = values;
      trials.push_back(trial);
    }
  };

  for (std::size_t subject = 0; subject < queries.size(); ++subject)
    for (std::size_t query = 0; query < queries[subject]; ++query)
      for (const std::uint64_t seed : seeds_of(sweep, subject))
        for (const std::string& planner : sweep.planners)
          for (const std::string& local : locals_of(sweep)) add({0, subject, query, seed, planner, local, {}});

  return trials;
}

void check(const Sweep& sweep) {
  check_where(sweep);
  check_planners(sweep);
  check_repeats(sweep);

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
    throw config::BadInput(fmt::format(
        "{}: '{}' is not a list of at most 1000000 seeds from 0 to 1000000000; write e.g. 1-30 or 1,2,5", flag, text));
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
    if (last < first || seeds.size() + (last - first) >= kMostSeeds) fail();
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
