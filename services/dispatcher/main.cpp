#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "common/config/reader.hpp"
#include "common/scenario/scenario.hpp"
#include "common/service/run_service.hpp"
#include "services/dispatcher/dispatcher_service.hpp"

int main(int argc, char** argv) {
  using namespace aisle;
  std::string scenario_file;
  dispatcher::ServiceConfig config;

  const auto options = [&](CLI::App& app) {
    service::bind_config(config);
    app.add_option("--scenario", scenario_file, "missions and map edits")->envname("AISLE_SCENARIO");
    app.add_option(
        "--start-at", config.start_at_ns,
        "second zero of the scenario, nanoseconds since the Unix epoch; default: when all vehicles are heard");
    app.add_option("--state-file", config.state_file, "keeps the missions' progress over a restart");
  };

  return service::run_service(argc, argv, {"dispatcher", "Gives each vehicle the goals of its mission", ""}, options,
                              [&](service::Shell& shell) {
                                if (scenario_file.empty())
                                  throw config::BadInput("--scenario FILE is missing (or AISLE_SCENARIO)");
                                config.scenario = scenario::read_scenario(scenario_file);
                                return std::make_unique<dispatcher::DispatcherService>(shell, config);
                              });
}
