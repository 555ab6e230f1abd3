#include <CLI/CLI.hpp>

#include "common/service/shell.hpp"
#include "services/local-planner/local_planner_service.hpp"

int main(int argc, char** argv) {
  using namespace aisle;
  local_planner::ServiceConfig config;
  const auto options = [&](CLI::App& app) {
    service::Shell::config(app, config);
    app.add_option("--planner", config.planner, "one of " + local_planner::variant_names())->capture_default_str();
  };
  return service::run_service(argc, argv,
                              {"local-planner", "Drives one vehicle along its plan without touching anything", "--agv"},
                              options, [&](service::Shell& shell) {
                                local_planner::LocalPlannerService planner(shell.bus(), shell.agv_id(), shell.stamper(),
                                                                           shell.health(), shell.instance_id(), config);
                                shell.run();
                              });
}
