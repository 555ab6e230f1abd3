#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "common/config/yaml_reader.hpp"
#include "common/fleet/zone.hpp"

namespace aisle::scenario {

/// Reads the list under `key` and appends its zones, each with one shape:
///   - {id: dock, kind: one-vehicle, rectangle: [1, 2, 4, 5]}                  two opposite corners
///   - {id: bend, kind: speed, max_speed_mps: 0.4, polygon: [[0, 0], [4, 0], [2, 3]]}
///   - {id: lane, kind: one-way, direction_rad: 1.57, disc: [4, 2.5, 0.6]}     centre and radius
/// @throws config::BadInput with file:line and the limit; also for two zones with one id, or more than kMostZones
void read_zones(config::YamlReader& r, const char* key, std::vector<fleet::Zone>& zones);

/// Reads a file of its own, `zones: [...]`. @throws config::BadInput as read_zones
std::vector<fleet::Zone> read_zone_file(const std::filesystem::path& file);

/// The file beside a map that holds its zones: "site.zones.yaml" beside "site.yaml" or "site.map".
std::filesystem::path zone_file_beside(const std::filesystem::path& map_file);

/// The zones of the file beside the map; none without that file. @throws config::BadInput as read_zones
std::vector<fleet::Zone> read_zones_beside(const std::filesystem::path& map_file);

/// As such a file; read_zone_file() reads the same zones from it.
std::string text_of_zones(const std::vector<fleet::Zone>& zones);

}  // namespace aisle::scenario
