#include <CLI/CLI.hpp>

#include "common/service/shell.hpp"
#include "services/obstacle-tracker/obstacle_tracker_service.hpp"

int main(int argc, char** argv) {
  using namespace aisle;
  obstacle_tracker::ServiceParams params;
  const auto options = [&](CLI::App& app) { service::Shell::config(app, params); };
  return service::run_service(argc, argv,
                              {"obstacle-tracker", "Turns the scans of all vehicles into one set of tracks", ""},
                              options, [&](service::Shell& shell) {
                                obstacle_tracker::ObstacleTrackerService tracker(
                                    shell.bus(), shell.instance_id(), shell.boot_id(), shell.health(), params);
                                shell.run();
                              });
}
