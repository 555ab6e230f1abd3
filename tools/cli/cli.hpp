#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/bus/settings.hpp"

namespace CLI {
class App;
}

namespace aisle::cli {

/// What all verbs share: the site, the form of the output, and what the chosen verb does.
struct Cli {
  bus::Settings settings;
  bool json{false};
  std::function<int()> action;
};

using Seconds = std::chrono::duration<double>;

/// A verb of the command line with its own --help and --json, below `parent`. Its arguments are read
/// into values that must live until the verb has run; what a value holds before is its default. (The
/// parser's headers take seconds to compile, so only cli.cpp and main.cpp include them.)
class Verb {
 public:
  /// Adds the verb, without arguments, below `parent`.
  Verb(CLI::App& parent, Cli& cli, const std::string& name, const std::string& purpose);

  Verb& argument(const std::string& name, std::string& value, const std::string& help);  // by its place; must be given
  Verb& optional_argument(const std::string& name, std::string& value, const std::string& help);  // may be left out

  /// True when the flag is there.
  Verb& flag(const std::string& name, bool& value, const std::string& help);

  /// A value after the flag; numbers must lie within `low` and `high`, both included.
  Verb& option(const std::string& name, std::string& value, const std::string& help);
  Verb& option(const std::string& name, double& value, double low, double high, const std::string& help);
  Verb& option(const std::string& name, int& value, int low, int high, const std::string& help);

  /// One or more values after the flag.
  Verb& list(const std::string& name, std::vector<std::string>& values, const std::string& help);

  /// What the verb does when it is chosen. `action` returns the exit code.
  void runs(std::function<int()> action);

 private:
  CLI::App* app_;
  Cli& cli_;
};

/// Joins the site under `name`, as a super client behind a discovery server. Incompatible QoS and foreign types on
/// topics that the verb uses become warnings on stderr. @throws config::BadEnvironment
std::unique_ptr<bus::Bus> join(const Cli& cli, const std::string& name);

/// Runs the loop until `done` returns true (it is asked after each event), for at most `limit` or until
/// a signal. @returns whether it was done
bool run_until(bus::Bus& bus, Seconds limit, const std::function<bool()>& done);

/// Did SIGINT or SIGTERM come?
bool is_interrupted();

/// "domain 3, partition 'hall-2', interface 127.0.0.1", for messages about what was not found there.
std::string place_of(const bus::Settings& settings);

/// The id under which a verb writes, different in each run: "aisle-1762154102113042".
std::string unique_id(const std::string& prefix);

/// Puts a blank before arguments like "-4,5", which the parser would take for a flag otherwise.
std::vector<std::string> protect_negative_numbers(int argc, const char* const* argv);

// The verbs, each in its own file. They add themselves below `parent`.
void add_topic_list(CLI::App& parent, Cli& cli);
void add_topic_info(CLI::App& parent, Cli& cli);
void add_topic_echo(CLI::App& parent, Cli& cli);
void add_topic_hz(CLI::App& parent, Cli& cli);
void add_topic_bw(CLI::App& parent, Cli& cli);
void add_fleet(CLI::App& parent, Cli& cli);
void add_fleet_sign_off(CLI::App& parent, Cli& cli);
void add_traffic(CLI::App& parent, Cli& cli);
void add_goal_send(CLI::App& parent, Cli& cli);
void add_goal_cancel(CLI::App& parent, Cli& cli);
void add_map_info(CLI::App& parent, Cli& cli);
void add_map_block(CLI::App& parent, Cli& cli);
void add_map_unblock(CLI::App& parent, Cli& cli);
void add_map_overlay(CLI::App& parent, Cli& cli);
void add_map_accept(CLI::App& parent, Cli& cli);
void add_map_save(CLI::App& parent, Cli& cli);
void add_map_zone_list(CLI::App& parent, Cli& cli);
void add_map_zone_add(CLI::App& parent, Cli& cli);
void add_map_zone_remove(CLI::App& parent, Cli& cli);
void add_experiment_all(CLI::App& parent, Cli& cli);
void add_experiment_papers(CLI::App& parent, Cli& cli);
void add_experiment_global(CLI::App& parent, Cli& cli);
void add_experiment_local(CLI::App& parent, Cli& cli);
void add_experiment_suite(CLI::App& parent, Cli& cli);
void add_experiment_swarm(CLI::App& parent, Cli& cli);
void add_experiment_tracking(CLI::App& parent, Cli& cli);
void add_experiment_traffic(CLI::App& parent, Cli& cli);
void add_lab_list(CLI::App& parent, Cli& cli);
void add_lab_parameters(CLI::App& parent, Cli& cli);
void add_lab_sweep(CLI::App& parent, Cli& cli);
void add_lab_reproduce(CLI::App& parent, Cli& cli);
void add_lab_compare(CLI::App& parent, Cli& cli);
void add_plan(CLI::App& parent, Cli& cli);
void add_doctor(CLI::App& parent, Cli& cli);
void add_health(CLI::App& parent, Cli& cli);
void add_drive(CLI::App& parent, Cli& cli);
void add_track(CLI::App& parent, Cli& cli);

}  // namespace aisle::cli
