// aisle experiment: writes its section of docs/experiments.md anew.
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <system_error>

#include "common/config/reader.hpp"
#include "common/process/exit_code.hpp"
#include "common/process/output_file.hpp"
#include "common/scenario/data_path.hpp"
#include "tools/cli/cli.hpp"
#include "tools/lab/driving/local_experiment.hpp"
#include "tools/lab/planning/global_experiment.hpp"
#include "tools/lab/planning/markdown.hpp"
#include "tools/lab/tracking/tracking_experiment.hpp"

namespace aisle::cli {
namespace {

namespace fs = std::filesystem;

struct ExperimentOrders {
  std::string page{"docs/experiments.md"};
  std::string maps{"deploy/experiments"};
  int random_maps{1000};
  int queries{50};
  int seeds{30};
  std::string empty_place{"deploy/scenarios/depot-pedestrians.yaml"};
  double longest_s{3600.0};
  double empty_s{600.0};
  int detour_seeds{8};
};

/// Empty when the reference data is not there.
fs::path reference_data(const std::string& maps) {
  try {
    return scenario::find_named_file("data:queries/den520d.q", fs::path(maps) / "any.yaml").parent_path().parent_path();
  } catch (const config::BadInput&) {
    return {};
  }
}

/// Before the work, which takes minutes. @throws config::BadEnvironment
void make_place(const fs::path& page, const fs::path& pictures) {
  std::error_code failure;
  fs::create_directories(pictures, failure);
  if (failure) throw config::BadEnvironment(pictures.string() + ": cannot be made: " + failure.message());
  process::check_writable(page);
}

void say(const std::string& what) { std::fprintf(stderr, "%s\n", what.c_str()); }

/// Replaces one section of the page and leaves the others as they are.
void write_section(const fs::path& page, const std::string& name, const std::string& section) {
  std::ifstream in(page);
  const std::string before{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  in.close();
  process::write_output_file(page, lab::with_section(before, name, section));
  std::printf("%s\n", page.c_str());
}

int run_global(const ExperimentOrders& orders) {
  const fs::path page(orders.page);
  lab::GlobalExperiment experiment;
  experiment.maps = orders.maps;
  experiment.pictures = page.parent_path() / "experiments";
  experiment.pictures_from_page = "experiments";
  experiment.data = reference_data(orders.maps);
  experiment.random_maps = orders.random_maps;
  experiment.queries = orders.queries;
  make_place(page, experiment.pictures);
  const std::string section = lab::global_section(experiment, say);
  write_section(page, "global planning", section);
  return process::kDone;
}

int run_local(const ExperimentOrders& orders) {
  const fs::path page(orders.page);
  lab::LocalExperiment experiment;
  experiment.maps = orders.maps;
  experiment.pictures = page.parent_path() / "experiments";
  experiment.pictures_from_page = "experiments";
  experiment.seeds = orders.seeds;
  make_place(page, experiment.pictures);
  write_section(page, "local planning", lab::local_section(experiment, say));
  return process::kDone;
}

int run_tracking(const ExperimentOrders& orders) {
  const fs::path page(orders.page);
  lab::TrackingExperiment experiment;
  experiment.people = reference_data(orders.maps) / "pedestrians";
  experiment.empty_place = orders.empty_place;
  experiment.pictures = page.parent_path() / "experiments";
  experiment.pictures_from_page = "experiments";
  experiment.longest_s = orders.longest_s;
  experiment.empty_s = orders.empty_s;
  experiment.detour_seeds = orders.detour_seeds;
  make_place(page, experiment.pictures);
  write_section(page, "obstacle tracking", lab::tracking_section(experiment, say));
  return process::kDone;
}

}  // namespace

void add_experiment_global(CLI::App& parent, Cli& cli) {
  auto orders = std::make_shared<ExperimentOrders>();
  Verb(parent, cli, "global", "global planners: the papers' tables, random maps, real maps")
      .option("--page", orders->page, "the page whose section is written anew; pictures go to experiments/ beside it")
      .option("--maps", orders->maps, "folder of the papers' maps")
      .option("--random-maps", orders->random_maps, 1, 100000, "a density")
      .option("--queries", orders->queries, 1, 200, "a real map")
      .runs([orders] { return run_global(*orders); });
}

void add_experiment_local(CLI::App& parent, Cli& cli) {
  auto orders = std::make_shared<ExperimentOrders>();
  Verb(parent, cli, "local", "local planners: the suite of scenarios, the papers' fused drives and speed curves")
      .option("--page", orders->page, "the page whose section is written anew; pictures go to experiments/ beside it")
      .option("--maps", orders->maps, "folder of the papers' maps")
      .option("--seeds", orders->seeds, 0, 1000, "of each of the suite's ten families; 0: no suite")
      .runs([orders] { return run_local(*orders); });
}

void add_experiment_tracking(CLI::App& parent, Cli& cli) {
  auto orders = std::make_shared<ExperimentOrders>();
  Verb(parent, cli, "tracking",
       "the obstacle tracker and a baseline on recorded people; what several vehicles see; ghosts in an empty place")
      .option("--page", orders->page, "the page whose section is written anew; pictures go to experiments/ beside it")
      .option("--empty-place", orders->empty_place,
              "scenario whose people and hidden blocks are left out to count ghosts")
      .option("--seconds", orders->longest_s, 10.0, 1e6, "of each recording, at most")
      .option("--empty-seconds", orders->empty_s, 1.0, 1e6, "in the empty place, at least")
      .option("--detour-seeds", orders->detour_seeds, 0, 1000,
              "drives of each family with prediction and without; 0: none")
      .runs([orders] { return run_tracking(*orders); });
}

}  // namespace aisle::cli
