#include <CLI/CLI.hpp>
#include <csignal>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "common/config/reader.hpp"
#include "common/process/exit_code.hpp"
#include "common/process/signals.hpp"
#include "common/process/version.hpp"
#include "common/service/arguments.hpp"
#include "common/service/site_options.hpp"
#include "tools/cli/cli.hpp"

namespace {

CLI::App* add_group(CLI::App& parent, const char* name, const char* purpose) {
  CLI::App* group = parent.add_subcommand(name, purpose);
  group->require_subcommand(1)->fallthrough();
  return group;
}

/// All verbs, in the order of --help.
void add_verbs(CLI::App& app, aisle::cli::Cli& cli) {
  using namespace aisle::cli;

  CLI::App& topic = *add_group(app, "topic", "what is said on the site's topics");
  add_topic_list(topic, cli);
  add_topic_info(topic, cli);
  add_topic_echo(topic, cli);
  add_topic_hz(topic, cli);
  add_topic_bw(topic, cli);

  add_fleet(app, cli);
  add_fleet_sign_off(*app.get_subcommand("fleet"), cli);
  add_traffic(app, cli);

  CLI::App& goal = *add_group(app, "goal", "send a vehicle somewhere, or stop it");
  add_goal_send(goal, cli);
  add_goal_cancel(goal, cli);

  CLI::App& map = *add_group(app, "map", "the site's map: look, edit, save");
  add_map_info(map, cli);
  add_map_block(map, cli);
  add_map_unblock(map, cli);
  add_map_overlay(map, cli);
  add_map_accept(map, cli);
  add_map_save(map, cli);

  CLI::App& zone = *add_group(map, "zone", "keep-out, speed and other zones of the map");
  add_map_zone_list(zone, cli);
  add_map_zone_add(zone, cli);
  add_map_zone_remove(zone, cli);

  add_plan(app, cli);

  CLI::App& experiment =
      *add_group(app, "experiment", "compare with what is published; write docs/experiments.md anew");
  add_experiment_all(experiment, cli);
  add_experiment_papers(experiment, cli);
  add_experiment_global(experiment, cli);
  add_experiment_local(experiment, cli);
  add_experiment_suite(experiment, cli);
  add_experiment_swarm(experiment, cli);
  add_experiment_tracking(experiment, cli);
  add_experiment_traffic(experiment, cli);

  CLI::App& lab = *add_group(app, "lab", "the five papers' tables and figures made again; parameters; sweeps");
  add_lab_list(lab, cli);
  add_lab_reproduce(lab, cli);
  add_lab_compare(lab, cli);
  add_lab_parameters(lab, cli);
  add_lab_sweep(lab, cli);

  add_doctor(app, cli);
  add_health(app, cli);
  add_drive(app, cli);
  add_track(app, cli);
}

}  // namespace

int main(int argc, char** argv) {
  return aisle::process::run_guarded("aisle", [&]() -> int {
    aisle::process::stop_on_signals();
    std::signal(SIGPIPE, SIG_DFL);  // end quietly when the reader of a pipe does

    aisle::cli::Cli cli;

    CLI::App app(
        "Looks at a fleet of AGVs and gives it orders.\nExit codes: 0 done, 1 the answer is no, 2 bad input, 3 "
        "environment.",
        "aisle");

    app.set_version_flag("--version", std::string("aisle ") + aisle::process::software_version());
    app.require_subcommand(1);
    aisle::service::add_site_options(app, cli.settings);
    add_verbs(app, cli);

    const std::vector<std::string> arguments = aisle::cli::protect_negative_numbers(argc, argv);
    std::vector<const char*> pointers;

    for (const std::string& argument : arguments) pointers.push_back(argument.c_str());
    if (const std::optional<int> code = aisle::service::parse_arguments(app, argc, pointers.data())) return *code;

    const int code = cli.action();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw aisle::config::BadEnvironment("stdout cannot be written; is the disk full?");

    return code;
  });
}
