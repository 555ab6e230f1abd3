#include <CLI/CLI.hpp>
#include <memory>

#include "common/service/run_service.hpp"
#include "services/global-planner/global_planner_service.hpp"

int main(int argc, char** argv) {
  using namespace aisle;
  global_planner::ServiceConfig config;

  const auto options = [&](CLI::App& app) {
    service::bind_config(config);
    app.add_option("--planner", config.planner, "name of a planner, e.g. direct, wang or theta");
    app.add_option("--strength", config.strength, "among planners of one epoch, the highest is heard")
        ->check(CLI::Range(0, 999));
    app.add_flag("--standby", config.standby, "takes over when the leading planner is gone");
  };

  return service::run_service(
      argc, argv, {"global-planner", "Plans a path for each vehicle with a goal", ""}, options,
      [&](service::Shell& shell) { return std::make_unique<global_planner::GlobalPlannerService>(shell, config); });
}
