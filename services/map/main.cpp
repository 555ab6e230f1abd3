#include <spdlog/logger.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <utility>

#include "common/service/run_service.hpp"
#include "services/map/map_config.hpp"
#include "services/map/map_service.hpp"

int main(int argc, char** argv) {
  using namespace aisle;
  map::MapConfig config;

  // Flags win over the config file, which has the same keys.
  const auto options = [&](CLI::App& app) {
    service::bind_config(config);
    app.add_option("--map", config.map, "map file: ROS .yaml, Moving AI .map, or a text grid .txt");
    app.add_option("--map-id", config.map_id,
                   "name of the map on the site; by default the file's name without its ending");
    app.add_option("--scenario", config.scenario, "serve the map of this scenario file");
    app.add_option("--zones", config.zones,
                   "file of zones; by default NAME.zones.yaml beside the map file, and the scenario's");
    app.add_option("--journal", config.journal,
                   "SQLite file that keeps edits; without it they last until the process ends")
        ->envname("AISLE_MAP_JOURNAL");
    app.add_option("--cell-m", config.cell_m, "edge of a Moving AI or text cell in metres")
        ->check(CLI::Range(1e-3, 1e3));
    app.add_option("--subdivide", config.subdivide, "cut each cell of the file into N x N")->check(CLI::Range(1, 64));
  };

  return service::run_service(argc, argv, {"map", "Serves the site's map and its edits", ""}, options,
                              [&](service::Shell& shell) {
                                map::MapStore store = map::open_map(config, shell.wall_clock_ns());
                                shell.log().info(map::start_text(config, store));
                                return std::make_unique<map::MapService>(shell, std::move(store));
                              });
}
