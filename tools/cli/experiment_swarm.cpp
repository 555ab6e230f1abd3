// aisle experiment swarm: small fleets under faults of all kinds, each run drawn by its seed.

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <memory>
#include <string>

#include "common/process/exit_code.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/json.hpp"
#include "tools/cli/progress_line.hpp"
#include "tools/cli/text.hpp"
#include "tools/sim/swarm.hpp"

namespace aisle::cli {
namespace {

/// Runs have the seeds from `seed` on, until so many seconds are simulated.
struct SwarmOrders {
  int seed{1};
  double simulated_s{1000.0};
  bool verbose{false};
};

/// Sums over the runs.
struct SwarmTotals {
  int runs{0}, bad{0}, dead{0}, goals{0}, reached{0}, closed_off{0};
  double simulated_s{0.0}, longest_stood_s{0.0};
  std::map<std::string, std::uint64_t> faults;

  void add(const sim::SwarmCase& swarm, const sim::SwarmVerdict& verdict) {
    ++runs;
    bad += verdict.failures.empty() ? 0 : 1;
    dead += static_cast<int>(swarm.dead.size());
    goals += verdict.goals;
    reached += verdict.reached;
    closed_off += verdict.closed_off;
    simulated_s += verdict.outcome.result.time_s;
    longest_stood_s = std::max(longest_stood_s, verdict.stood_s);
    for (const auto& [kind, count] : verdict.outcome.faults) faults[kind] += count;
  }
};

void print(const Cli& cli, const SwarmTotals& totals) {
  if (cli.json) {
    std::printf("%s\n", write_json(Json{{"runs", totals.runs},
                                        {"bad_runs", totals.bad},
                                        {"simulated_s", totals.simulated_s},
                                        {"dead_vehicles", totals.dead},
                                        {"goals", totals.goals},
                                        {"goals_reached", totals.reached},
                                        {"goals_closed_off", totals.closed_off},
                                        {"longest_stood_after_faults_s", totals.longest_stood_s},
                                        {"faults", totals.faults}})
                            .c_str());
    return;
  }

  std::printf("%d runs of %.0f s in all, %d bad; %d vehicles died\n", totals.runs, totals.simulated_s, totals.bad,
              totals.dead);
  std::printf(
      "goals of the living: %d of %d reached, %d closed off by the dead; moving again %.1f s after the last "
      "fault at the latest\n",
      totals.reached, totals.goals, totals.closed_off, totals.longest_stood_s);

  std::string faults;
  for (const auto& [kind, count] : totals.faults)
    faults += fmt::format("{}{} {}", faults.empty() ? "" : ", ", kind, count);
  std::printf("faults: %s\n", faults.c_str());
}

/// Names each bad run with its seed and all that was wrong with it.
int drive_swarm(const Cli& cli, const SwarmOrders& orders) {
  SwarmTotals totals;
  ProgressLine progress;

  for (auto seed = static_cast<std::uint64_t>(orders.seed); totals.simulated_s < orders.simulated_s; ++seed) {
    progress.tell(fmt::format("seed {}: {:.0f} s of {:.0f} s simulated, {} bad runs", seed, totals.simulated_s,
                              orders.simulated_s, totals.bad));

    const sim::SwarmCase swarm = sim::swarm_case(seed);
    if (orders.verbose)
      std::fprintf(stderr, "# seed %llu\n%s", static_cast<unsigned long long>(seed), sim::to_yaml(swarm.plan).c_str());

    sim::Hooks hooks;
    hooks.goes_on = [](double) { return !is_interrupted(); };
    if (orders.verbose)
      hooks.says = [](const std::string& line) { std::fprintf(stderr, "%s\n", printable(line).c_str()); };

    const sim::SwarmVerdict verdict = sim::drive_swarm_case(swarm, hooks);
    if (is_interrupted()) break;

    totals.add(swarm, verdict);
    progress.clear();
    for (const std::string& failure : verdict.failures)
      std::fprintf(stderr, "seed %llu: %s\n", static_cast<unsigned long long>(seed), printable(failure).c_str());
  }

  progress.clear();
  if (is_interrupted()) std::fprintf(stderr, "aisle experiment swarm: stopped after %d runs\n", totals.runs);
  print(cli, totals);

  return totals.bad == 0 && !is_interrupted() ? process::kDone : process::kNegative;
}

}  // namespace

void add_experiment_swarm(CLI::App& parent, Cli& cli) {
  auto orders = std::make_shared<SwarmOrders>();
  Verb(
      parent, cli, "swarm",
      "drive small fleets while services crash, hang and are cut off, packets are lost and late, and vehicles die, all "
      "drawn by seed; exit code 1 when a moving vehicle touched something, two held the same floor, a goal was lost, "
      "or "
      "nothing moved within 5 s of the last fault")
      .option("--seed", orders->seed, 0, 1'000'000'000, "of the first run; the next one has the next seed")
      .option("--simulated-s", orders->simulated_s, 1.0, 1e7, "runs begin until so many seconds are simulated")
      .flag("--verbose", orders->verbose, "fault plans, what happened, and what services log, on stderr")
      .runs([&cli, orders] { return drive_swarm(cli, *orders); });
}

}  // namespace aisle::cli
