#pragma once
#include <cstdint>
#include <functional>
#include <string>

#include "common/bus/bus.hpp"

namespace CLI {
class App;
}

namespace aisle::service {

/// Stamps the samples of one writer: source, boot, epoch, sequence number from 1, wall clock.
class OriginStamper {
 public:
  OriginStamper(std::string source_id, std::uint64_t boot_id, std::uint32_t epoch = 1);
  aisle::Origin next();
  void set_epoch(std::uint32_t epoch);
  std::uint32_t epoch() const;
};

/// What the shell says on `service_health`, every second and at once when the state changes.
struct Health {
  aisle::ServiceState state{};          // STARTING until the service says otherwise
  std::string waits_for;                // e.g. "map_info, vehicle_state"; empty when nothing
  std::string last_error;
  std::string map_id;
  std::uint64_t map_revision{0};
  std::uint64_t map_hash{0};
  void count(const std::string& name, std::uint64_t by = 1);   // counters, at most 32 names
};

/// What every service process has in common: flags (--domain, --partition, --interface, --peer, --discovery-server,
/// --shared-memory, --config, --instance, --log-level, --version, --help), environment, logging, signals, one Bus,
/// `service_health` with its 2 s manual lease asserted every 500 ms from the loop (so a hang shows), exit codes
/// (0 stopped by signal, 2 bad input, 3 environment), and naming of a second process with the same instance id.
class Shell {
 public:
  struct About {
    std::string service;        // "global-planner": the program is aisle-global-planner
    std::string purpose;        // one line for --help
    std::string agv_id_flag;    // "--agv" for services of one vehicle, else empty
  };

  const std::string& instance_id() const;
  const std::string& agv_id() const;
  std::uint64_t boot_id() const;
  bus::Bus& bus();
  Health& health();
  OriginStamper stamper() const;
  /// Runs the loop until SIGINT or SIGTERM.
  void run();
};

/// The whole of a main(): `options` adds flags of this service to the CLI11 app; after parsing (and after --config was read
/// strictly into what `options` bound to it by Shell::config), `body` makes the service and calls shell.run().
/// Turns config::BadInput into one line and exit code 2, config::BadEnvironment into 3, anything else into 1.
int run_service(int argc, char** argv, const Shell::About& about, const std::function<void(CLI::App&)>& options,
                const std::function<void(Shell&)>& body);

}  // namespace aisle::service
