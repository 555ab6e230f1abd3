#include "common/service/map_client.hpp"

#include <utility>

#include "common/wire/map.hpp"

namespace aisle::service {

using std::chrono::milliseconds;

namespace {
constexpr milliseconds kLookEvery{100};
constexpr milliseconds kAskForInfoAfter{1000};
constexpr milliseconds kZonesWithin{1000};
constexpr std::size_t kMaxReasons = 16;
}  // namespace

/// Ends of instances mean nothing here: the map's cells stay valid without its service.
MapClient::MapClient(bus::Bus& bus, const std::string& requester_id, const Options& options)
    : bus_(bus), options_(options), requester_id_(requester_id), map_id_(options.map_id), progress_(bus_.now()) {
  requests_ = bus_.writer<topics::MapRequest>();
  bus_.on<topics::MapInfo>([this](const aisle::MapInfo& sample, const bus::SampleInfo& info) {
    if (info.kind == bus::SampleKind::kData) take(sample);
  });
  bus_.on<topics::MapTile>([this](const aisle::MapTile& sample, const bus::SampleInfo& info) {
    if (info.kind == bus::SampleKind::kData) take(sample);
  });

  bus_.on<topics::MapZones>([this](const aisle::MapZones& sample, const bus::SampleInfo& info) {
    if (info.kind == bus::SampleKind::kData) take(sample);
  });

  bus_.every(kLookEvery, [this] {
    ask_for_missing();
    tell_first_map();
  });
}

void MapClient::take(const aisle::MapInfo& sample) {
  auto summary = wire::decode(sample);
  if (!summary) return drop("map_info: " + summary.reason());
  if (!is_ours(summary->map_id)) return;

  map_id_ = summary->map_id;
  map_source_ = sample.by().source_id().to_string();

  // Zones that came first may be of another map, or of another source.
  if (has_zones() && (zones_source_ != map_source_ || zones_.map_id != map_id_)) set_zones({});

  note(mirror_.take(*summary));
}

void MapClient::take(const aisle::MapTile& sample) {
  auto tile = wire::decode(sample);
  if (!tile) return drop("map_tile: " + tile.reason());
  if (is_ours(tile->map_id)) note(mirror_.take(*tile));
}

/// Only the service that says the map says its zones, and an older word does not replace a newer one.
void MapClient::take(const aisle::MapZones& sample) {
  auto zones = wire::decode(sample);
  if (!zones) return drop("map_zones: " + zones.reason());
  if (!is_ours(zones->map_id)) return;

  const std::string source_id = sample.by().source_id().to_string();
  if (!map_source_.empty() && source_id != map_source_) return drop("map_zones: of another source: " + source_id);
  if (zones->revision < zones_.revision) return drop("map_zones: of an older revision");

  zones_source_ = source_id;
  set_zones(*std::move(zones));
  tell_first_map();
}

void MapClient::set_zones(fleet::MapZones zones) {
  const bool is_change = zones.zones != zones_.zones;
  zones_ = std::move(zones);
  if (!is_change) return;

  const std::size_t count = on_zones_.size();  // as for on_map_
  for (std::size_t i = 0; i < count; ++i) on_zones_[i](zones_.zones);
}

bool MapClient::is_ours(const std::string& map_id) {
  if (map_id_.empty() || map_id == map_id_) return true;
  drop("map of another id: " + map_id);
  return false;
}

/// An edit recomputes the clearances around the changed cells only.
void MapClient::note(grid::MapMirror::Change change) {
  if (change == grid::MapMirror::Change::kNone) return;

  progress_ = bus_.now();

  if (change != grid::MapMirror::Change::kComplete) return;

  hash_ = mirror_.summary()->hash;

  if (options_.with_clearance) {
    if (clearance_.geometry() == mirror_.grid().geometry()) {
      clearance_.update(mirror_.grid(), mirror_.changed_low(), mirror_.changed_high());
    } else {
      clearance_ = grid::ClearanceField(mirror_.grid(), options_.clearance_max_m);
    }
  }

  if (has_told_map_) return tell_map(mirror_.changed_low(), mirror_.changed_high());

  if (!whole_since_) whole_since_ = bus_.now();
  tell_first_map();
}

/// Revisions may have come while it was held back: all of the grid is new.
void MapClient::tell_first_map() {
  if (has_told_map_ || !whole_since_) return;
  if (!has_zones() && bus_.now() - *whole_since_ < kZonesWithin) return;

  has_told_map_ = true;
  tell_map({0, 0}, {grid().geometry().width - 1, grid().geometry().height - 1});
}

void MapClient::tell_map(grid::Cell low, grid::Cell high) {
  const std::size_t count = on_map_.size();  // what a handler adds is called from the next map on
  for (std::size_t i = 0; i < count; ++i) on_map_[i](mirror_.grid(), clearance_, low, high);
}

/// Asking counts as progress, so that requests keep their distance.
void MapClient::ask_for_missing() {
  if (mirror_.is_complete()) return;

  const bool knows_what = mirror_.summary().has_value();
  if (bus_.now() - progress_ < (knows_what ? options_.ask_after : kAskForInfoAfter)) return;
  if (requests_.matched_readers() == 0) return;

  progress_ = bus_.now();
  requests_.write(wire::encode(fleet::MapRequest{requester_id_, map_id_, ++requests_sent_, mirror_.missing_tiles()}));
}

void MapClient::drop(const std::string& reason) {
  if (dropped_.size() < kMaxReasons || dropped_.count(reason) > 0) ++dropped_[reason];
}

}  // namespace aisle::service
