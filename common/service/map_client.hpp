#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/fleet/zone.hpp"
#include "common/grid/clearance.hpp"
#include "common/grid/map_mirror.hpp"

namespace aisle::service {

/// The site's map as a service uses it: follows `map_info`, `map_tile` and `map_zones`, asks aisle-map for tiles
/// that do not come, and calls back when a whole map of a new revision is there, or its zones changed. Runs in the
/// bus's loop; make it before the loop runs and keep it while the loop runs.
///
///     service::MapClient map(bus, "mirror", {});  // a tool; services have Shell::map()
///     map.on_map([&](const grid::OccupancyGrid& grid, const grid::ClearanceField& clearance, grid::Cell low,
///                    grid::Cell high) { ... });
class MapClient {
 public:
  struct Options {
    std::string map_id;         // empty: the first map that is heard
    bool with_clearance{true};  // false: no field is computed, the handler gets an empty one
    double clearance_max_m{5.0};
    std::chrono::milliseconds ask_after{300};  // without progress

    bool operator==(const Options& other) const {
      return std::tie(map_id, with_clearance, clearance_max_m, ask_after) ==
             std::tie(other.map_id, other.with_clearance, other.clearance_max_m, other.ask_after);
    }
  };

  /// `low` to `high`, both included, are the cells that changed: the whole grid at first, none (high below low) when a
  /// revision changed nothing. The references stay valid, and their content the same, until the next call.
  using OnMap =
      std::function<void(const grid::OccupancyGrid&, const grid::ClearanceField&, grid::Cell low, grid::Cell high)>;

  /// All zones of the map, by id. The reference stays valid, and its content the same, until the next call.
  using OnZones = std::function<void(const std::vector<fleet::Zone>&)>;

  /// `requester_id`: of this process, e.g. the shell's instance id.
  MapClient(bus::Bus& bus, const std::string& requester_id, const Options& options);
  MapClient(const MapClient&) = delete;
  MapClient& operator=(const MapClient&) = delete;

  /// Called in the loop after each revision that became complete; for the first time when the map's zones were heard as
  /// well, so that no vehicle drives through a zone that is about to be heard, or a second later: a map service from
  /// before there were zones says none. Several handlers are called in turn.
  void on_map(OnMap handler) { on_map_.push_back(std::move(handler)); }

  /// Called in the loop when the map's zones change, for the first time when they are heard first and are not empty.
  /// Several handlers are called in turn.
  void on_zones(OnZones handler) { on_zones_.push_back(std::move(handler)); }

  /// Of the newest revision that was heard; empty before the first.
  const std::vector<fleet::Zone>& zones() const { return zones_.zones; }

  /// The same with the revision at which they changed last.
  const fleet::MapZones& all_zones() const { return zones_; }

  /// True once the map's zones were heard, be it that it has none.
  bool has_zones() const { return zones_.revision > 0; }

  /// True once a whole map was there; from then on grid() and clearance() hold the newest whole map.
  bool has_map() const { return mirror_.revision() > 0; }

  /// True when that map is also the newest that aisle-map announced.
  bool is_complete() const { return mirror_.is_complete(); }

  /// Of the newest whole map; 0 before the first.
  std::uint64_t revision() const { return mirror_.revision(); }
  const std::string& map_id() const { return map_id_; }

  /// Of the newest whole map.
  std::uint64_t hash() const { return hash_; }

  /// @pre has_map()
  const grid::OccupancyGrid& grid() const { return mirror_.grid(); }

  /// Empty with Options::with_clearance false.
  const grid::ClearanceField& clearance() const { return clearance_; }

  /// Samples that were not used, by reason; "map of another id: NAME" among them.
  const std::map<std::string, std::uint64_t>& dropped() const { return dropped_; }

 private:
  void take(const aisle::MapInfo& sample);
  void take(const aisle::MapTile& sample);
  void take(const aisle::MapZones& sample);

  /// Calls the map's handlers.
  void tell_map(grid::Cell low, grid::Cell high);

  /// The first map, unless it is not complete, was told already, or its zones may still come.
  void tell_first_map();

  /// Calls the handlers when the zones are others than before.
  void set_zones(fleet::MapZones zones);

  /// Of the id that was asked for, or of the first that was heard.
  bool is_ours(const std::string& map_id);

  /// Notes progress, and calls the handlers when a map is complete.
  void note(grid::MapMirror::Change change);

  /// Asks aisle-map when there was no progress for a while.
  void ask_for_missing();
  void drop(const std::string& reason);

  bus::Bus& bus_;
  Options options_;
  std::string requester_id_;
  std::string map_id_;
  bus::Writer<topics::MapRequest> requests_;
  std::uint64_t requests_sent_{0};
  time::Stamp progress_;
  grid::MapMirror mirror_;
  grid::ClearanceField clearance_;
  std::uint64_t hash_{0};
  std::optional<time::Stamp> whole_since_;  // when the first map was complete
  bool has_told_map_{false};
  std::deque<OnMap> on_map_;  // a handler may add one: those before it stay where they are
  std::deque<OnZones> on_zones_;
  std::string map_source_;  // which wrote map_info; empty before the first
  std::string zones_source_;
  fleet::MapZones zones_;
  std::map<std::string, std::uint64_t> dropped_;
};

}  // namespace aisle::service
