#pragma once

#include <cstdint>
#include <string>

#include "services/map/core/map_store.hpp"

namespace aisle::map {

/// What aisle-map takes from its flags and its config file.
struct MapConfig {
  std::string map;       // map file
  std::string map_id;    // empty: the stem of the map file
  std::string scenario;  // scenario file; its map is served, with its options
  std::string zones;     // file of zones; empty: NAME.zones.yaml beside the map when it is there, and the scenario's
  std::string journal;   // SQLite file; empty: edits last until the process ends
  double cell_m{1.0};    // edge of a Moving AI or text cell
  int subdivide{1};      // cells of the grid along a cell of the file
  int max_cells_per_edit{1000000};
  int max_edits{200000};  // ever, of one journal
  int journal_max_mb{256};

  template <class Reader>
  void describe(Reader& r) {
    r.field("map", map)
        .field("map_id", map_id)
        .field("scenario", scenario)
        .field("zones", zones)
        .field("journal", journal)
        .field("cell_m", cell_m, 1e-3, 1e3)
        .field("subdivide", subdivide, 1, 64)
        .field("max_cells_per_edit", max_cells_per_edit, 1, 67108864)
        .field("max_edits", max_edits, 1, 10000000)
        .field("journal_max_mb", journal_max_mb, 1, 65536);
  }
};

/// Reads the map and its journal. `now_ns`: nanoseconds since the Unix epoch.
/// Without a journal the revision starts at the Unix time in milliseconds, not at 1: so it does not go back when the
/// process starts again without the edits, and mirrors take the fresh map for the newer one.
/// @throws config::BadInput, config::BadEnvironment
MapStore open_map(const MapConfig& config, std::int64_t now_ns);

/// The line of the log at the start: what is served, and where its edits are kept.
std::string start_text(const MapConfig& config, const MapStore& store);

}  // namespace aisle::map
