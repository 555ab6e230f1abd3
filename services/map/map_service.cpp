#include "services/map/map_service.hpp"

#include <spdlog/logger.h>

#include <chrono>
#include <utility>

namespace aisle::map {
namespace {

constexpr std::chrono::milliseconds kRequestPeriod{10};
constexpr int kTilesPerPeriod = 128;    // 4 kB each: 50 MB/s at most
constexpr int kLogLinesPerSecond = 20;  // about edits; counters tell of all

}  // namespace

MapService::MapService(service::Shell& shell, MapStore store)
    : shell_(shell),
      publication_(std::move(store)),
      tiles_(shell.outbox<topics::MapTile>()),
      zones_(shell.outbox<topics::MapZones>()),
      info_(shell.outbox<topics::MapInfo>()),
      results_(shell.outbox<topics::MapEditResult>()),
      lines_left_(kLogLinesPerSecond),
      publish_soon_(shell.soon([this] { write(publication_.changes()); })) {
  // Edits of cells and of zones are answered alike.
  const auto take_edit = [this](const auto& edit, const service::Sender& from) {
    answer(publication_.take(edit, from.by.source_id, shell_.wall_clock_ns()));
  };
  const auto refuse = [this](const std::string& edit_id, const std::string& reason) {
    answer(publication_.refuse(edit_id, reason));
  };

  shell.inbox<topics::MapEdit>(take_edit).on_refused(refuse);
  shell.inbox<topics::ZoneEdit>(take_edit).on_refused(refuse);

  shell.inbox<topics::MapRequest>([this](const fleet::MapRequest& request) { take(request); });

  shell.every(kRequestPeriod, [this] { write(publication_.requested(kTilesPerPeriod)); });
  shell.every(std::chrono::seconds(1), [this] { lines_left_ = kLogLinesPerSecond; });

  shell.report([](service::Health&) {});  // ready from the start
  write(publication_.whole());
}

void MapService::take(const fleet::MapRequest& request) {
  shell_.count("map_requests");

  // What is wrong with a request is the mirror's fault, and no reason to fail.
  for (const std::string& reason : publication_.ask(request)) {
    shell_.count("bad_map_request." + first_word(reason));
    shell_.warn("map_request", "map_request of " + request.requester_id + ": " + reason);
  }
}

void MapService::answer(const fleet::MapEditResult& result) {
  shell_.count(counter_of(result.outcome));
  const bool is_refused = result.outcome == fleet::MapEditResult::Outcome::kRefused;

  if (is_refused) shell_.health().last_error = "edit " + result.edit_id + " refused: " + result.detail;
  if (--lines_left_ >= 0) shell_.log().log(is_refused ? spdlog::level::err : spdlog::level::info, log_text(result));

  publish_soon_();
}

void MapService::write(const Batch& batch) {
  // The order is the contract: tiles and zones, then the summary that completes them, then the results.
  const SiteMap& map = store().map();

  for (const int tile : batch.tiles) tiles_.write(map.tile(tile));
  shell_.count("tiles_written", batch.tiles.size());

  if (batch.has_zones) zones_.write(store().zones());

  if (batch.has_summary) {
    info_.write(map.summary());
    shell_.health().tell_map(map.map_id(), map.revision(), map.summary().hash);
  }

  for (const fleet::MapEditResult& result : batch.results) results_.write(result);
}

}  // namespace aisle::map
