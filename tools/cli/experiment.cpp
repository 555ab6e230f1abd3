// aisle experiment: writes docs/experiments.md anew, one section or the whole page.

#include <cstdio>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/process/exit_code.hpp"
#include "common/process/signals.hpp"
#include "tools/cli/cli.hpp"
#include "tools/lab/experiments.hpp"

namespace aisle::cli {
namespace {

using lab::Experiments;
using lab::Section;
using Sentences = std::vector<std::string>;

/// What is read from the flags, beside the experiments' own numbers.
struct ExperimentOrders {
  std::string page{"docs/experiments.md"};
  std::string maps{"deploy/experiments"};
  std::string empty_place{"deploy/scenarios/depot-pedestrians.yaml"};
  Experiments experiments;
};

using Orders = std::shared_ptr<ExperimentOrders>;

void say(const std::string& what) { std::fprintf(stderr, "%s\n", what.c_str()); }

/// Flags that all experiments share.
void add_places(Verb& verb, const Orders& orders, const char* what) {
  verb.option("--page", orders->page, std::string(what) + "; pictures go to experiments/ beside it")
      .option("--maps", orders->maps, "folder of the papers' maps");
}

void add_papers_options(Verb& verb, const Orders& orders) {
  verb.option("--paper-maps", orders->experiments.papers.maps, 2, 100000, "of each kind, for paths")
      .option("--paper-drives", orders->experiments.papers.drives, 0, 10000, "of each of the papers' scenes")
      .option("--seed", orders->experiments.papers.seed, 1, 1000000, "of these maps");
}

void add_global_options(Verb& verb, const Orders& orders) {
  verb.option("--random-maps", orders->experiments.global.random_maps, 1, 100000, "a density")
      .option("--queries", orders->experiments.global.queries, 1, 200, "a real map");
}

void add_local_options(Verb& verb, const Orders& orders) {
  verb.option("--seeds", orders->experiments.local.seeds, 0, 1000, "of each of the suite's ten families; 0: no suite");
}

void add_tracking_options(Verb& verb, const Orders& orders) {
  lab::TrackingExperiment& tracking = orders->experiments.tracking;
  verb.option("--empty-place", orders->empty_place,
              "scenario whose people and hidden blocks are left out to count ghosts")
      .option("--seconds", tracking.longest_s, 10.0, 1e6, "of each recording, at most")
      .option("--empty-seconds", tracking.empty_s, 1.0, 1e6, "in the empty place, at least")
      .option("--detour-seeds", tracking.detour_seeds, 0, 1000,
              "drives of each family with prediction and without; 0: none");
}

/// Runs the experiments and writes the page. Sentences that the figures do not bear out are left out of
/// it, and named. Nothing is written before all is measured: a signal ends it at once.
int run(const Orders& orders, const std::function<Sentences(const Experiments&)>& write) {
  process::end_on_signals();

  Experiments& experiments = orders->experiments;
  experiments.page = orders->page;
  experiments.maps = orders->maps;
  experiments.tracking.empty_place = orders->empty_place;

  for (const std::string& sentence : write(experiments))
    say("left out, since the figures do not bear it out: " + sentence);

  std::printf("%s\n", orders->page.c_str());
  return process::kDone;
}

/// The verb writes one section of the page anew.
void runs_section(Verb& verb, const Orders& orders, Section section) {
  verb.runs([orders, section] {
    return run(orders, [&](const Experiments& all) { return lab::write_section(all, section, say); });
  });
}

constexpr const char* kSectionOfPage = "the page whose section is written anew";

}  // namespace

void add_experiment_all(CLI::App& parent, Cli& cli) {
  auto orders = std::make_shared<ExperimentOrders>();
  Verb verb(parent, cli, "all", "all of them: the whole page");

  add_places(verb, orders, "the page, written anew");
  add_papers_options(verb, orders);
  add_global_options(verb, orders);
  add_local_options(verb, orders);
  add_tracking_options(verb, orders);
  verb.runs([orders] { return run(orders, [](const Experiments& all) { return lab::write_page(all, say); }); });
}

void add_experiment_papers(CLI::App& parent, Cli& cli) {
  auto orders = std::make_shared<ExperimentOrders>();
  Verb verb(parent, cli, "papers", "the five papers' tables row by row, with a verdict each, and their maps");
  add_places(verb, orders, kSectionOfPage);
  add_papers_options(verb, orders);
  runs_section(verb, orders, Section::kPapers);
}

void add_experiment_global(CLI::App& parent, Cli& cli) {
  auto orders = std::make_shared<ExperimentOrders>();
  Verb verb(parent, cli, "global", "global planners: the papers' tables, random maps, real maps");

  add_places(verb, orders, kSectionOfPage);
  add_global_options(verb, orders);
  runs_section(verb, orders, Section::kGlobalPlanning);
}

void add_experiment_local(CLI::App& parent, Cli& cli) {
  auto orders = std::make_shared<ExperimentOrders>();
  Verb verb(parent, cli, "local", "local planners: the suite of scenarios, the papers' fused drives and speed curves");

  add_places(verb, orders, kSectionOfPage);
  add_local_options(verb, orders);
  runs_section(verb, orders, Section::kLocalPlanning);
}

void add_experiment_tracking(CLI::App& parent, Cli& cli) {
  auto orders = std::make_shared<ExperimentOrders>();

  Verb verb(parent, cli, "tracking",
            "the obstacle tracker and a baseline on recorded people; what several vehicles see; ghosts in an empty "
            "place");

  add_places(verb, orders, kSectionOfPage);
  add_tracking_options(verb, orders);
  runs_section(verb, orders, Section::kObstacleTracking);
}

}  // namespace aisle::cli
