#include <CLI/CLI.hpp>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "common/config/reader.hpp"
#include "common/scenario/scenario.hpp"
#include "common/service/run_service.hpp"
#include "services/fake-world/fake_world_service.hpp"

int main(int argc, char** argv) {
  using namespace aisle;
  std::string scenario_file;
  std::optional<std::uint64_t> seed;
  fake_world::ServiceConfig config;

  const auto options = [&](CLI::App& app) {
    app.add_option("--scenario", scenario_file, "what moves and stands in the world")->envname("AISLE_SCENARIO");
    app.add_option("--seed", seed, "of speeds and phases; default: the scenario's")->envname("AISLE_SEED");
    app.add_option(
        "--start-at", config.start_at_ns,
        "second zero of the scenario, nanoseconds since the Unix epoch; default: when all vehicles are heard");
    app.add_option("--state-file", config.state_file, "keeps the world's progress over a restart");
  };

  return service::run_service(argc, argv, {"fake-world", "Simulates what moves and stands beside the vehicles", ""},
                              options, [&](service::Shell& shell) {
                                if (scenario_file.empty())
                                  throw config::BadInput("--scenario FILE is missing (or AISLE_SCENARIO)");
                                config.scenario = scenario::read_scenario(scenario_file);
                                config.seed = seed.value_or(config.scenario.seed);

                                return std::make_unique<fake_world::FakeWorldService>(shell, config);
                              });
}
