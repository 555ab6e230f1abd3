// A service that does nothing, in the shell of them all.
#include <CLI/CLI.hpp>
#include <string>

#include "common/service/shell.hpp"

namespace {

struct Parameters {
  double radius_m{0.5};
  std::string fail;
  template <class Reader>
  void describe(Reader& r) {
    r.field("radius_m", radius_m, 0.0, 10.0).field("fail", fail);
  }
};

void serve(aisle::service::Shell& shell, const Parameters& parameters) {
  if (parameters.fail == "environment") throw aisle::config::BadEnvironment("no disk");
  shell.health().waits_for = "radius " + std::to_string(parameters.radius_m);
  shell.health().state = aisle::ServiceState::SERVICE_WAITING;
  shell.bus().every(std::chrono::milliseconds(200), [&shell] {
    shell.health().count("ticks");
    shell.health().state = aisle::ServiceState::SERVICE_READY;
    shell.health().waits_for.clear();
  });
  shell.run();
}

}  // namespace

int main(int argc, char** argv) {
  Parameters parameters;
  return aisle::service::run_service(
      argc, argv, {"idle", "Does nothing.", argc > 1 && std::string(argv[1]) == "--agv" ? "--agv" : ""},
      [&](CLI::App& app) {
        aisle::service::Shell::config(app, parameters);
        app.add_option("--radius", parameters.radius_m, "radius in metres");
      },
      [&](aisle::service::Shell& shell) { serve(shell, parameters); });
}
