#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "common/service/run_service.hpp"
#include "services/local-planner/local_planner_service.hpp"

int main(int argc, char** argv) {
  using namespace aisle;
  local_planner::ServiceConfig config;

  const auto options = [&](CLI::App& app) {
    service::bind_config(config);
    const auto choose = [&](const std::string& name) { config.variant = local_planner::chosen_variant(name); };
    app.add_option_function<std::string>("--planner", choose, "one of " + local_planner::variant_names())
        ->default_str(config.variant.name);
  };

  return service::run_service(
      argc, argv, {"local-planner", "Drives vehicles along their plans without touching anything", "--agv"}, options,
      [&](service::Shell& shell) { return std::make_unique<local_planner::LocalPlannerService>(shell, config); });
}
