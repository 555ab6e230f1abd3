// A service that does nothing, in the shell of them all. With --hold it waits for SIGUSR1 before it is ready.
#include <CLI/CLI.hpp>
#include <cmath>
#include <csignal>
#include <string>

#include "common/service/run_service.hpp"

namespace {

struct Parameters {
  double radius_m{0.5};
  std::string fail;
  bool hold{false};
  template <class Reader>
  void describe(Reader& r) {
    r.field("radius_m", radius_m, 0.0, 10.0).field("fail", fail);
  }
};

volatile std::sig_atomic_t may_be_ready = 1;

void serve(aisle::service::Shell& shell, const Parameters& parameters) {
  if (parameters.fail == "environment") throw aisle::config::BadEnvironment("no disk");
  shell.health().waits_for = "radius " + std::to_string(parameters.radius_m);
  shell.health().state = aisle::fleet::ServiceState::kWaiting;
  shell.health().count("radius_mm", static_cast<std::uint64_t>(std::lround(1000.0 * parameters.radius_m)));
  if (parameters.hold) {
    may_be_ready = 0;
    std::signal(SIGUSR1, [](int) { may_be_ready = 1; });
  }
  shell.every(std::chrono::milliseconds(200), [&shell] {
    if (may_be_ready == 0) return;
    shell.health().state = aisle::fleet::ServiceState::kReady;
    shell.health().waits_for.clear();
  });
}

}  // namespace

int main(int argc, char** argv) {
  Parameters parameters;
  return aisle::service::run_process(
      argc, argv, {"idle", "Does nothing.", argc > 1 && std::string(argv[1]) == "--agv" ? "--agv" : ""},
      [&](CLI::App& app) {
        aisle::service::bind_config(parameters);
        app.add_option("--radius", parameters.radius_m, "radius in metres");
        app.add_flag("--hold", parameters.hold, "not ready before SIGUSR1");
      },
      [&](aisle::service::Process& process) {
        serve(process.shell(), parameters);
        process.run();
      });
}
