#include "tools/sim/suite.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <utility>

#include "tools/sim/scenarios/families.hpp"
#include "tools/sim/scenarios/suite_scenarios.hpp"
#include "tools/sim/site.hpp"

namespace aisle::sim {
namespace {

constexpr double kStartUpS = 2.0;  // a site gives its goals sooner

}  // namespace

const std::vector<std::string>& suite_families() {
  static const std::vector<std::string> names{"static-clutter", "hidden-blocks", "person-crossing", "person-oncoming",
                                              "overtaking",     "door",          "corridor",        "crowd",
                                              "two-vehicles",   "four-vehicles"};
  return names;
}

Result run_in_time(Setup setup, const std::string& local) {
  setup.local = local;

  const std::vector<double> alone_s = free_run_s(setup);
  const double longest_s = kFreeRuns * *std::max_element(alone_s.begin(), alone_s.end());

  setup.scenario.duration_s = kStartUpS + longest_s;

  Result result = drive(setup).result;

  for (std::size_t i = 0; i < alone_s.size(); ++i) {
    const double took_s = result.done_s[i] - result.first_goal_s;
    if (result.done_s[i] < 0.0 || took_s <= kFreeRuns * alone_s[i]) continue;

    --result.goals_reached;
    result.log.push_back(
        fmt::format("{} is too late: {:.2f} s, alone {:.2f} s", setup.scenario.vehicles[i].id, took_s, alone_s[i]));
  }

  result.driven_s = std::min(result.driven_s, longest_s);
  return result;
}

SuiteRow run_family(const std::string& family, const std::string& local, std::uint64_t first, int seeds,
                    const std::function<bool()>& is_stopped) {
  SuiteRow row{family, {}, {}};
  for (std::uint64_t seed = first; seed < first + static_cast<std::uint64_t>(seeds); ++seed) {
    if (is_stopped && is_stopped()) break;

    const Result result = run_in_time(make_setup(family, seed), local);
    row.totals.add(result);

    const bool is_good = result.goals_reached == result.goals_assigned && result.contacts_moving_vehicle == 0;
    if (!is_good) row.bad.push_back(std::to_string(seed) + (result.log.empty() ? "" : ": " + result.log.back()));
  }

  return row;
}

}  // namespace aisle::sim
