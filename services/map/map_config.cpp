#include "services/map/map_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <utility>
#include <vector>

#include "common/config/reader.hpp"
#include "common/grid/formats/map_file.hpp"
#include "common/scenario/scenario.hpp"
#include "common/scenario/zone_file.hpp"

namespace aisle::map {
namespace {

/// The file to read and how to read it.
struct Source {
  std::filesystem::path file;
  grid::MapFileOptions options;
  std::vector<fleet::Zone> zones;
};

/// The zones that go with the map; a file that was named wins. @throws config::BadInput
std::vector<fleet::Zone> zones_of(const MapConfig& config) {
  return config.zones.empty() ? scenario::read_zones_beside(config.map) : scenario::read_zone_file(config.zones);
}

/// From `--map`, or from the scenario file, which names its map itself. @throws config::BadInput unless one is given
Source source_of(const MapConfig& config) {
  if (config.map.empty() == config.scenario.empty()) {
    throw config::BadInput(config.map.empty() ? "--map FILE or --scenario FILE is missing: which map is to be served?"
                                              : "--map and --scenario name two maps: give one of them");
  }

  if (!config.map.empty()) return {config.map, {config.cell_m, config.subdivide}, zones_of(config)};

  scenario::Scenario scenario = scenario::read_scenario(config.scenario);
  return {scenario.map_file, scenario.map_options,
          config.zones.empty() ? std::move(scenario.zones) : scenario::read_zone_file(config.zones)};
}

/// The id that was given, else the file's name without its ending.
/// @throws config::BadInput unless it has 1 to 64 letters, digits, '-', '_' and '.'
std::string id_of(const MapConfig& config, const std::filesystem::path& file) {
  const std::string id = config.map_id.empty() ? file.stem().string() : config.map_id;

  const auto is_fit = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
           c == '.';
  };

  if (id.empty() || id.size() > 64 || !std::all_of(id.begin(), id.end(), is_fit)) {
    throw config::BadInput("--map-id: '" + id + "' is not an id; use 1 to 64 letters, digits, '-', '_' and '.'");
  }

  return id;
}

}  // namespace

MapStore open_map(const MapConfig& config, std::int64_t now_ns) {
  Source source = source_of(config);
  const std::string id = id_of(config, source.file);
  const MapStore::Limits limits{{config.max_cells_per_edit}, config.max_edits};
  grid::OccupancyGrid grid = grid::read_map_file(source.file, source.options);

  // Without a journal: the Unix time in milliseconds as revision. With one: the file is revision 1, and each entry of
  // the journal is one more.
  if (config.journal.empty())
    return {SiteMap(id, std::move(grid), static_cast<std::uint64_t>(now_ns / 1000000)), nullptr, limits,
            std::move(source.zones)};

  SiteMap base(id, std::move(grid));
  auto journal =
      std::make_unique<Journal>(config.journal, id, base.summary().hash,
                                Journal::Options{std::int64_t{config.journal_max_mb} << 20, hash_of(source.zones)});

  return {std::move(base), std::move(journal), limits, std::move(source.zones)};
}

std::string start_text(const MapConfig& config, const MapStore& store) {
  const SiteMap& map = store.map();
  const grid::Geometry& g = map.grid().geometry();

  return fmt::format("map={} cells={}x{} resolution_m={} tiles={} revision={} zones={} edits={} journal={}",
                     map.map_id(), g.width, g.height, g.resolution_m, map.tiles(), map.revision(),
                     store.zones().zones.size(), store.edits(),
                     config.journal.empty() ? "none: edits last until this process ends" : config.journal);
}

}  // namespace aisle::map
