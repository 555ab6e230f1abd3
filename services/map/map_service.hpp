#pragma once
#include <functional>

#include "common/service/shell.hpp"
#include "services/map/core/publication.hpp"

namespace aisle::map {

/// Publishes the map at the start; answers edits with the tiles that changed, then map_info, then the result; writes
/// tiles again for mirrors that miss them.
class MapService {
 public:
  MapService(service::Shell& shell, MapStore store);
  MapService(const MapService&) = delete;
  MapService& operator=(const MapService&) = delete;

  const MapStore& store() const { return publication_.store(); }

 private:
  void take(const fleet::MapRequest& request);
  void answer(const fleet::MapEditResult& result);
  void write(const Batch& batch);

  service::Shell& shell_;
  Publication publication_;
  service::Outbox<topics::MapTile> tiles_;
  service::Outbox<topics::MapInfo> info_;
  service::Outbox<topics::MapEditResult> results_;
  int lines_left_;                      // of the log, for edits, in this second
  std::function<void()> publish_soon_;  // once for all edits that wait
};

}  // namespace aisle::map
