#pragma once

#include <functional>

#include "common/service/shell.hpp"
#include "services/map/core/publication.hpp"

namespace aisle::map {

/// Serves the site's map. At the start it writes all tiles, then `map_info`. An edit is answered with the tiles that it
/// changed, then `map_info`, then its result, in this order (an edit of a zone with all zones instead of tiles):
/// whoever reads the result finds the map already changed. Mirrors which miss tiles ask for them by `map_request` and
/// get them again. Runs in the shell's loop only.
class MapService {
 public:
  /// Registers topics and timers with `shell`, which must outlive this object, and writes the whole map.
  MapService(service::Shell& shell, MapStore store);
  MapService(const MapService&) = delete;
  MapService& operator=(const MapService&) = delete;

  /// The map as it is now, with its edits.
  const MapStore& store() const { return publication_.store(); }

 private:
  /// Notes the tiles that a mirror asks for; they are written at the next period. Counts requests that make no sense.
  void take(const fleet::MapRequest& request);

  /// Counts and logs the result of an edit (at most 20 lines a second) and has it written with its tiles.
  void answer(const fleet::MapEditResult& result);

  /// Tiles, then zones, then map_info, then results.
  void write(const Batch& batch);

  service::Shell& shell_;
  Publication publication_;
  service::Outbox<topics::MapTile> tiles_;
  service::Outbox<topics::MapZones> zones_;
  service::Outbox<topics::MapInfo> info_;
  service::Outbox<topics::MapEditResult> results_;
  int lines_left_;                      // that the log takes for edits within this second
  std::function<void()> publish_soon_;  // writes once for all edits that arrived together
};

}  // namespace aisle::map
