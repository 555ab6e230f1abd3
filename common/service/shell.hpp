#pragma once
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>

#include "common/bus/bus.hpp"
#include "common/config/yaml_reader.hpp"
#include "common/service/origin_stamper.hpp"

namespace CLI {
class App;
}

namespace aisle::service {

/// What the shell says on `service_health`, every second and at once when state, waits_for or last_error change.
struct Health {
  aisle::ServiceState state{};  // STARTING until the service says otherwise
  std::string waits_for;        // e.g. "map_info, vehicle_state"; empty when nothing
  std::string last_error;
  std::string map_id;
  std::uint64_t map_revision{0};
  std::uint64_t map_hash{0};
  std::map<std::string, std::uint64_t> counters;
  /// At most 32 names; further ones are left out.
  void count(const std::string& name, std::uint64_t by = 1);
};

/// What every service process has in common: flags (--domain, --partition, --interface, --peer, --discovery-server,
/// --shared-memory, --config, --instance, --log-level, --health-file, --version, --help), environment, logging,
/// signals, one Bus, `service_health` with its 2 s manual lease asserted every 500 ms from the loop (so a hang shows),
/// exit codes (0 stopped by signal, 2 bad input, 3 environment), and naming of a second process with the same instance
/// id. Everything happens on the thread that calls run().
class Shell {
 public:
  struct About {
    std::string service;      // "global-planner": the program is aisle-global-planner
    std::string purpose;      // one line for --help
    std::string agv_id_flag;  // "--agv" for services of one vehicle (then it must be given), else empty
  };

  ~Shell();
  Shell(const Shell&) = delete;
  Shell& operator=(const Shell&) = delete;

  /// "global-planner", or "local-planner-agv-1" for a service of one vehicle, unless --instance says otherwise.
  const std::string& instance_id() const;
  const std::string& agv_id() const;
  /// Microseconds since the Unix epoch at the start: a later start has a higher one.
  std::uint64_t boot_id() const;
  bus::Bus& bus();
  Health& health();
  /// A new one for each writer: it counts that writer's samples.
  OriginStamper stamper() const;
  /// Runs the loop until SIGINT or SIGTERM.
  void run();

  /// Call it in `options`, before adding flags that are bound to members of `value`: the keys of `value.describe()` may
  /// then stand at the top of the --config file, beside `instance`, `log_level` and `site`. Flags win over environment,
  /// environment over the file.
  template <class T>
  static void config(CLI::App& app, T& value) {
    bind_config(app, [&value](config::YamlReader& reader) { value.describe(reader); });
  }

 private:
  struct State;
  explicit Shell(std::unique_ptr<State> state);
  static void bind_config(CLI::App& app, std::function<void(config::YamlReader&)> describe);
  friend int run_service(int argc, char** argv, const About& about, const std::function<void(CLI::App&)>& options,
                         const std::function<void(Shell&)>& body);
  std::unique_ptr<State> state_;
};

/// The whole of a main(): `options` adds flags of this service to the CLI11 app (and binds its config, see
/// Shell::config); after parsing, `body` makes the service and calls shell.run(). Turns config::BadInput into one line
/// and exit code 2, config::BadEnvironment into 3, anything else into 1.
int run_service(int argc, char** argv, const Shell::About& about, const std::function<void(CLI::App&)>& options,
                const std::function<void(Shell&)>& body);

}  // namespace aisle::service
