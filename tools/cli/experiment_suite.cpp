// aisle experiment suite: drives the suite's scenarios with one local planner, a line a family.

#include <fmt/format.h>

#include <cstdint>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "common/config/reader.hpp"
#include "common/process/exit_code.hpp"
#include "services/local-planner/core/critic.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/json.hpp"
#include "tools/cli/known_names.hpp"
#include "tools/cli/progress_line.hpp"
#include "tools/cli/text.hpp"
#include "tools/sim/suite.hpp"

namespace aisle::cli {
namespace {

/// The options of the command, with their defaults. The runs of a family have the seeds from `seed` on.
struct SuiteOrders {
  std::vector<std::string> families{sim::suite_families()};
  std::string local{"wang"};
  int seed{1};
  int runs{30};
};

/// Sums over the runs for counts, means a run for time and distance; the clearance is null when nothing
/// came near.
Json to_json(const std::string& name, const sim::Totals& totals) {
  const bool has_least = totals.least_clearance_m < sim::kNothingNearM;
  return {{"family", name},
          {"runs", totals.runs},
          {"goals_assigned", totals.goals_assigned},
          {"goals_reached", totals.goals_reached},
          {"contacts", totals.contacts},
          {"contacts_moving_vehicle", totals.contacts_moving_vehicle},
          {"least_clearance_m", has_least ? Json(totals.least_clearance_m) : Json(nullptr)},
          {"mean_time_s", totals.runs > 0 ? totals.driven_s / totals.runs : 0.0},
          {"mean_distance_m", totals.runs > 0 ? totals.distance_m / totals.runs : 0.0},
          {"omega_sign_changes", totals.omega_sign_changes},
          {"jerk_rms", totals.jerk_rms},
          {"trace_hash", fmt::format("{:016x}", totals.trace_hash)}};
}

/// One row of the printed table: sums of goals and contacts, means a run of time, length and changes of
/// turn.
std::vector<std::string> cells(const std::string& name, const sim::Totals& t) {
  const double runs = t.runs > 0 ? t.runs : 1;
  return {name,
          std::to_string(t.runs),
          fmt::format("{} of {}", t.goals_reached, t.goals_assigned),
          std::to_string(t.contacts),
          std::to_string(t.contacts_moving_vehicle),
          t.least_clearance_m < sim::kNothingNearM ? fmt::format("{:.3f}", t.least_clearance_m) : "-",
          fmt::format("{:.1f}", t.driven_s / runs),
          fmt::format("{:.1f}", t.distance_m / runs),
          fmt::format("{:.1f}", t.omega_sign_changes / runs),
          fmt::format("{:.2f}", t.jerk_rms)};
}

/// As JSON or as a table, a row for each family and one for all of them together.
void print(const Cli& cli, const SuiteOrders& orders, const std::vector<sim::SuiteRow>& rows, const sim::Totals& all) {
  if (cli.json) {
    Json families = Json::array();
    for (const sim::SuiteRow& row : rows) {
      families.push_back(to_json(row.family, row.totals));
      families.back()["bad"] = row.bad;
    }

    std::printf("%s\n",
                write_json({{"local", orders.local}, {"all", to_json("all", all)}, {"families", families}}).c_str());
    return;
  }

  std::vector<std::vector<std::string>> table{{"family", "runs", "goals", "contacts", "of a moving vehicle", "least m",
                                               "time s", "length m", "turn signs", "jerk"}};
  for (const sim::SuiteRow& row : rows) table.push_back(cells(row.family, row.totals));
  table.push_back(cells("all", all));
  std::printf("local %s\n%s", orders.local.c_str(), text_of_table(table).c_str());
}

/// Stops between two runs when the user says so, and prints what there is.
int drive_suite(const Cli& cli, const SuiteOrders& orders) {
  check_name("--local", orders.local, names_of(local_planner::all_variants()));
  for (const std::string& family : orders.families) check_name("--family", family, sim::suite_families());

  ProgressLine progress;
  std::vector<sim::SuiteRow> rows;
  sim::Totals all;

  for (const std::string& family : orders.families) {
    int begun = 0;

    rows.push_back(sim::run_family(family, orders.local, static_cast<std::uint64_t>(orders.seed), orders.runs, [&] {
      progress.tell(fmt::format("{}: run {} of {}", family, ++begun, orders.runs));
      return is_interrupted();
    }));

    all.add(rows.back().totals);
    progress.clear();

    for (const std::string& bad : rows.back().bad)
      std::fprintf(stderr, "%s, seed %s\n", family.c_str(), printable(bad).c_str());

    if (is_interrupted()) break;
  }

  progress.clear();

  if (is_interrupted()) std::fprintf(stderr, "aisle experiment suite: stopped after %d runs\n", all.runs);
  print(cli, orders, rows, all);

  return all.is_good() && !is_interrupted() ? process::kDone : process::kNegative;
}

}  // namespace

void add_experiment_suite(CLI::App& parent, Cli& cli) {
  auto orders = std::make_shared<SuiteOrders>();
  Verb(parent, cli, "suite",
       "drive the suite's scenarios with one local planner, each goal within five times its free run; exit code 1 when "
       "a goal was missed or a moving vehicle touched something")
      .list("--family", orders->families, "of " + listed(sim::suite_families()) + "; default: all")
      .option("--local", orders->local,
              "local planner: " + local_planner::variant_names() + "; default: " + orders->local)
      .option("--seed", orders->seed, 0, 1'000'000'000, "of each family's first run; the next one has the next seed")
      .option("--runs", orders->runs, 1, 100'000, "of each family")
      .runs([&cli, orders] { return drive_suite(cli, *orders); });
}

}  // namespace aisle::cli
