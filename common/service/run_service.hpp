#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/config/yaml_reader.hpp"
#include "common/service/shell.hpp"

namespace CLI {
class App;
}

namespace aisle::service {

/// A program, as --help and run_process() need to know it.
struct About {
  std::string service;      // "global-planner": the program is aisle-global-planner
  std::string purpose;      // one line for --help
  std::string agv_id_flag;  // "--agv" for services of vehicles (then it must be given), else empty
};

/// The surroundings of a service in a running program: one bus, one loop, and one shell for each
/// vehicle of --agv, or a single one.
class Process {
 public:
  ~Process();
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  /// The one that all shells share.
  bus::Bus& bus();
  const std::vector<std::unique_ptr<Shell>>& shells() const;

  /// The only one, or the first.
  Shell& shell() { return *shells().front(); }

  /// Runs the loop until SIGINT or SIGTERM, then says goodbye.
  void run();

 private:
  struct State;

  explicit Process(std::unique_ptr<State> state);

  friend int run_process(int argc, char** argv, const About& about, const std::function<void(CLI::App&)>& options,
                         const std::function<void(Process&)>& body);

  std::unique_ptr<State> state_;
};

/// Lets the keys that `describe` names stand at the top of the --config file, beside `instance`,
/// `log_level` and `site`. Call it in `options`, before adding flags that are bound to the same
/// members: flags win over environment, environment over the file.
void bind_config(std::function<void(config::YamlReader&)> describe);

/// The keys of `value.describe()`. @pre `value` lives until the command line is parsed
template <class T>
void bind_config(T& value) {
  bind_config(std::function<void(config::YamlReader&)>([&value](config::YamlReader& r) { value.describe(r); }));
}

/// What every program has in common: flags (--domain, --partition, --interface, --peer, --discovery-server,
/// --shared-memory, --config, --instance, --log-level, --health-file, --version, --help, and --agv ID,ID,... where
/// `about` says so), environment, logging, signals, the bus, and exit codes: config::BadInput is one line and 2,
/// config::BadEnvironment 3, anything else 1. `options` adds the program's own flags; `body` runs after parsing.
///
/// With several vehicles each has the instance id "<service>-<agv>" ("<--instance>-<agv>" where that is given), its own
/// health and its own lease.
int run_process(int argc, char** argv, const About& about, const std::function<void(CLI::App&)>& options,
                const std::function<void(Process&)>& body);

/// The whole of a main(): `make(shell)` returns a service by unique_ptr, and the program runs until a
/// signal comes. @returns the exit code
template <class Make>
int run_service(int argc, char** argv, const About& about, const std::function<void(CLI::App&)>& options, Make make) {
  return run_process(argc, argv, about, options, [&make](Process& process) {
    std::vector<decltype(make(process.shell()))> services;
    for (const std::unique_ptr<Shell>& shell : process.shells()) services.push_back(make(*shell));
    process.run();
  });
}

}  // namespace aisle::service
