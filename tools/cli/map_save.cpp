// aisle map save: writes the site's map, with its edits, as a ROS map file.

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <vector>

#include "common/config/reader.hpp"
#include "common/grid/formats/map_file.hpp"
#include "common/process/exit_code.hpp"
#include "common/process/output_file.hpp"
#include "common/scenario/zone_file.hpp"
#include "common/service/map_client.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/json.hpp"

namespace aisle::cli {
namespace {

constexpr Seconds kUntilZonesAreSaid{1.0};

struct SaveOptions {
  std::string file;
  std::string map_id;
  double timeout_s{10.0};
};

/// Before waiting for a map: a name that cannot be written is told at once.
void check_name(const std::filesystem::path& file) {
  if (file.extension() != ".yaml")
    throw config::BadInput(file.string() + ": the name must end in .yaml; the cells go to a .pgm beside it");

  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  if (!std::filesystem::is_directory(folder))
    throw config::BadInput(folder.string() + ": no such folder; make it first");
}

/// Beside the map's file; a file of zones that was there before is never left to a map without zones.
void write_zones(const std::filesystem::path& map_file, const std::vector<fleet::Zone>& zones) {
  const std::filesystem::path file = scenario::zone_file_beside(map_file);
  if (!zones.empty() || std::filesystem::exists(file))
    process::write_output_file(file.string(), scenario::text_of_zones(zones));
}

/// Waits for the whole map and writes it, with its zones.
int save(const Cli& cli, const SaveOptions& options) {
  check_name(options.file);

  const std::unique_ptr<bus::Bus> bus = join(cli, "aisle-map-save");

  // The cells alone; no clearances are needed.
  service::MapClient::Options client_options;

  client_options.map_id = options.map_id;
  client_options.with_clearance = false;

  service::MapClient map(*bus, unique_id("aisle-map-save"), client_options);
  if (!run_until(*bus, Seconds(options.timeout_s), [&] { return map.has_map() && map.is_complete(); })) {
    throw config::BadEnvironment(
        fmt::format("no whole map within {:g} s in {}; is aisle-map running? aisle doctor looks for the cause",
                    options.timeout_s, place_of(cli.settings)));
  }

  // A map service from before there were zones says none.
  run_until(*bus, kUntilZonesAreSaid, [&] { return map.has_zones(); });

  try {
    grid::write_ros_map(map.grid(), options.file);
  } catch (const std::system_error& error) {
    throw config::BadEnvironment(std::string(error.what()) + "; check free space and permissions");
  }

  write_zones(options.file, map.zones());

  if (cli.json) {
    std::printf(
        "%s\n",
        write_json(Json{{"file", options.file}, {"map_id", map.map_id()}, {"revision", map.revision()}}).c_str());
  } else {
    std::printf("%s: map '%s' at revision %llu\n", options.file.c_str(), map.map_id().c_str(),
                static_cast<unsigned long long>(map.revision()));
  }

  return process::kDone;
}

}  // namespace

void add_map_save(CLI::App& parent, Cli& cli) {
  auto options = std::make_shared<SaveOptions>();
  Verb(parent, cli, "save",
       "write the map, with its edits, as ROS map_server YAML and PGM, and its zones as FILE.zones.yaml")
      .argument("file", options->file, "FILE.yaml")
      .option("--map", options->map_id, "id of the map; the one that is seen when not given")
      .option("--timeout", options->timeout_s, 0.1, 1e6, "give up after so many seconds")
      .runs([&cli, options] { return save(cli, *options); });
}

}  // namespace aisle::cli
