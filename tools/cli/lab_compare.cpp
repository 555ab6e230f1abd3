// aisle lab compare: planners beside each other on the papers' maps, OMPL's among them.
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "common/config/reader.hpp"
#include "common/process/exit_code.hpp"
#include "common/process/signals.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/progress_line.hpp"
#include "tools/cli/text.hpp"
#include "tools/lab/papers/comparison.hpp"

namespace aisle::cli {
namespace {

struct CompareOrders {
  std::string maps;
  std::vector<std::string> planners{"astar", "theta", "li", "wu", "qu", "yu", "wang"};
  int seed{1};
  int count{200};
};

int compare(const Cli& cli, const CompareOrders& orders) {
  process::end_on_signals();
  lab::Comparison comparison;
  const auto seed = static_cast<unsigned>(orders.seed);
  comparison.map_kinds = lab::map_kinds_named(orders.maps);
  comparison.planners = lab::contestants_named(orders.planners);
  comparison.maps = {orders.count, seed};
  if (comparison.planners.empty()) throw config::BadInput("--planners names no planner");

  ProgressLine progress;
  const std::vector<lab::ComparedPlanner> rows =
      lab::compare(comparison, [&](const std::string& what) { progress.tell(what); });
  progress.clear();

  std::printf("%s",
              cli.json ? (lab::json_of(rows, seed).dump() + "\n").c_str() : text_of_table(lab::rows_of(rows)).c_str());
  return process::kDone;
}

}  // namespace

void add_lab_compare(CLI::App& parent, Cli& cli) {
  auto orders = std::make_shared<CompareOrders>();
  Verb(parent, cli, "compare",
       "planners beside each other on maps of the papers' kinds, also OMPL's rrtstar, informed-rrtstar, bitstar and "
       "rrtconnect where it is built in; the first is the one that the others are compared with")
      .argument("MAPS", orders->maps, "a kind of maps (wang-1, qu-maze), a paper (wang), or all")
      .list("--planners", orders->planners, "names, with blanks or commas between")
      .option("--maps", orders->count, 2, 100000, "of each kind")
      .option("--seed", orders->seed, 1, 1000000, "draws other maps")
      .runs([&cli, orders] { return compare(cli, *orders); });
}

}  // namespace aisle::cli
