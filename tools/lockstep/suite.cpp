#include "tools/lockstep/suite.hpp"

#include <algorithm>
#include <utility>

#include "tools/sim/scenarios/families.hpp"
#include "tools/sim/scenarios/suite_scenarios.hpp"

namespace aisle::lockstep {

const std::vector<std::string>& suite_families() {
  static const std::vector<std::string> names{"static-clutter", "hidden-blocks", "person-crossing", "person-oncoming",
                                              "overtaking",     "door",          "corridor",        "crowd",
                                              "two-vehicles",   "four-vehicles"};
  return names;
}

Result run_in_time(Setup setup, const std::string& local) {
  setup.local = local;
  const std::vector<double> alone_s = sim::free_run_s(setup);
  setup.scenario.duration_s = kFreeRuns * *std::max_element(alone_s.begin(), alone_s.end());
  Result result = run(setup);
  for (std::size_t i = 0; i < alone_s.size(); ++i)
    if (result.done_s[i] > kFreeRuns * alone_s[i]) {
      --result.goals_reached;
      result.log.push_back(setup.scenario.vehicles[i].id + " is too late: " + std::to_string(result.done_s[i]) +
                           " s, alone " + std::to_string(alone_s[i]));
    }
  return result;
}

SuiteRow run_family(const std::string& family, const std::string& local, std::uint64_t first, int seeds,
                    const std::function<bool()>& is_stopped) {
  SuiteRow row{family, {}, {}};
  for (std::uint64_t seed = first; seed < first + static_cast<std::uint64_t>(seeds); ++seed) {
    if (is_stopped && is_stopped()) break;
    const Result result = run_in_time(sim::make_setup(family, seed), local);
    row.totals.add(result);
    const bool is_good = result.goals_reached == result.goals_assigned && result.contacts_moving_vehicle == 0;
    if (!is_good) row.bad.push_back(std::to_string(seed) + (result.log.empty() ? "" : ": " + result.log.back()));
  }
  return row;
}

}  // namespace aisle::lockstep
