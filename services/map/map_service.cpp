#include "services/map/map_service.hpp"

#include <spdlog/spdlog.h>

#include <chrono>
#include <utility>

#include "common/wire/map.hpp"

namespace aisle::map {

using fleet::MapEditResult;
using Outcome = MapEditResult::Outcome;
using std::chrono::milliseconds;

namespace {
constexpr milliseconds kRequestPeriod{10};
constexpr int kTilesPerPeriod = 128;  // 4 kB each: 50 MB/s at most
constexpr int kLogLinesPerSecond = 20;
}  // namespace

MapService::MapService(bus::Bus& bus, const std::string& instance_id, std::uint64_t boot_id, service::Health& health,
                       MapStore store)
    : bus_(bus),
      health_(health),
      store_(std::move(store)),
      tiles_(bus.writer<topics::MapTile>()),
      info_{bus.writer<topics::MapInfo>(), service::OriginStamper(bus, instance_id, boot_id)},
      results_{bus.writer<topics::MapEditResult>(), service::OriginStamper(bus, instance_id, boot_id)},
      lines_left_(kLogLinesPerSecond) {
  bus_.on<topics::MapEdit>([this](const aisle::MapEdit& sample, const bus::SampleInfo& info) {
    if (info.kind == bus::SampleKind::kData) take(sample);
  });
  bus_.on<topics::MapRequest>([this](const aisle::MapRequest& sample, const bus::SampleInfo& info) {
    if (info.kind == bus::SampleKind::kData) take(sample);
  });
  for (int i = 0; i < store_.map().tiles(); ++i) write_tile(i);
  write_info();
  note_revision();
  health_.state = fleet::ServiceState::kReady;
  bus_.every(kRequestPeriod, [this] { write_requested(); });
  bus_.every(std::chrono::seconds(1), [this] { lines_left_ = kLogLinesPerSecond; });
}

void MapService::take(const aisle::MapEdit& sample) {
  const auto edit = wire::decode(sample);
  MapEditResult result;
  if (edit) {
    MapStore::Answer answer = store_.take(*edit, sample.by().source_id().to_string(), bus_.wall_clock_ns());
    changed_tiles_.insert(answer.changed_tiles.begin(), answer.changed_tiles.end());
    result = std::move(answer.result);
  } else {
    drop("map_edit", edit.reason());
    result = {sample.edit_id().to_string(),
              sample.map_id().to_string(),
              Outcome::kRefused,
              edit.reason(),
              store_.map().revision(),
              0};
  }
  const char* counter = result.outcome == Outcome::kApplied   ? "edits_applied"
                        : result.outcome == Outcome::kRefused ? "edits_refused"
                                                              : "edits_repeated";
  health_.count(counter);
  if (result.outcome == Outcome::kRefused) health_.last_error = "edit " + result.edit_id + " refused: " + result.detail;
  if (lines_left_ > 0) {
    --lines_left_;
    if (result.outcome == Outcome::kRefused) {
      spdlog::error("edit={} refused reason=\"{}\"", result.edit_id, result.detail);
    } else {
      spdlog::info("edit={} {} revision={} changed_cells={}", result.edit_id,
                   result.outcome == Outcome::kApplied ? "applied" : "was applied before", result.revision,
                   result.changed_cells);
    }
  }
  answers_.push_back(std::move(result));
  if (is_publishing_) return;
  is_publishing_ = true;  // once for all edits that wait
  bus_.post([this] { publish_changes(); });
}

void MapService::take(const aisle::MapRequest& sample) {
  const auto request = wire::decode(sample);
  if (!request) return drop("map_request", request.reason());
  if (!request->map_id.empty() && request->map_id != store_.map().map_id())
    return drop("map_request", "map_id is of another map");
  health_.count("map_requests");
  is_info_requested_ = true;
  for (const std::uint32_t tile : request->tiles) {
    if (tile < static_cast<std::uint32_t>(store_.map().tiles())) {
      requested_tiles_.insert(tile);
    } else {
      drop("map_request", "tiles beyond the map");
    }
  }
}

void MapService::write_tile(int index) {
  tiles_.write(wire::encode(store_.map().tile(index)));
  health_.count("tiles_written");
}

void MapService::write_info() {
  aisle::MapInfo sample = wire::encode(store_.map().summary());
  sample.by(info_.stamper.next());
  info_.writer.write(sample);
}

void MapService::publish_changes() {
  is_publishing_ = false;
  for (const int tile : changed_tiles_) write_tile(tile);
  changed_tiles_.clear();
  if (health_.map_revision != store_.map().revision()) {
    write_info();
    note_revision();
  }
  for (const MapEditResult& answer : answers_) {
    aisle::MapEditResult sample = wire::encode(answer);
    sample.by(results_.stamper.next());
    if (!results_.writer.write(sample)) health_.count("results_not_written");
  }
  answers_.clear();
}

void MapService::write_requested() {
  for (int i = 0; i < kTilesPerPeriod && !requested_tiles_.empty(); ++i) {
    write_tile(static_cast<int>(*requested_tiles_.begin()));
    requested_tiles_.erase(requested_tiles_.begin());
  }
  if (is_info_requested_ && requested_tiles_.empty()) {
    is_info_requested_ = false;
    write_info();
  }
}

void MapService::note_revision() {
  health_.map_id = store_.map().map_id();
  health_.map_revision = store_.map().revision();
  health_.map_hash = store_.map().summary().hash;
}

void MapService::drop(const char* topic, const std::string& reason) {
  health_.count(std::string("bad_") + topic + "." + reason.substr(0, reason.find(' ')).substr(0, 32));
  if (lines_left_ > 0) {
    --lines_left_;
    spdlog::warn("topic={} dropped reason=\"{}\"", topic, reason);
  }
}

}  // namespace aisle::map
