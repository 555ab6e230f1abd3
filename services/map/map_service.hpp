#pragma once
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/service/origin_stamper.hpp"
#include "common/service/shell.hpp"
#include "services/map/core/map_store.hpp"

namespace aisle::map {

/// The shell around MapStore: publishes the map at the start; answers edits with the tiles that changed, then map_info,
/// then the result; writes tiles again for mirrors that miss them. Lives on the bus's loop.
class MapService {
 public:
  MapService(bus::Bus& bus, const std::string& instance_id, std::uint64_t boot_id, service::Health& health,
             MapStore store);
  MapService(const MapService&) = delete;
  MapService& operator=(const MapService&) = delete;

  const MapStore& store() const { return store_; }

 private:
  /// Stamps what it writes.
  template <class Topic>
  struct Output {
    bus::Writer<Topic> writer;
    service::OriginStamper stamper;
  };

  void take(const aisle::MapEdit& sample);
  void take(const aisle::MapRequest& sample);
  void write_tile(int index);
  void write_info();
  /// All that edits changed since the last call: tiles first, so that the summary completes a mirror, results last.
  void publish_changes();
  /// A part of what mirrors asked for, so that their asking holds up no edit.
  void write_requested();
  void note_revision();
  void drop(const char* topic, const std::string& reason);

  bus::Bus& bus_;
  service::Health& health_;
  MapStore store_;
  bus::Writer<topics::MapTile> tiles_;
  Output<topics::MapInfo> info_;
  Output<topics::MapEditResult> results_;
  std::set<int> changed_tiles_;
  std::vector<fleet::MapEditResult> answers_;
  bool is_publishing_{false};
  std::set<std::uint32_t> requested_tiles_;
  bool is_info_requested_{false};
  int lines_left_{0};  // of log, in this second
};

}  // namespace aisle::map
