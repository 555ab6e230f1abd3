#include "services/map/core/publication.hpp"

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <numeric>
#include <utility>

namespace aisle::map {

using fleet::MapEditResult;

const char* counter_of(MapEditResult::Outcome outcome) {
  switch (outcome) {
    case MapEditResult::Outcome::kApplied:
      return "edits_applied";
    case MapEditResult::Outcome::kAlreadyApplied:
      return "edits_repeated";
    case MapEditResult::Outcome::kRefused:
      break;
  }

  return "edits_refused";
}

std::string log_text(const MapEditResult& result) {
  const std::string edit = "edit=" + result.edit_id;
  if (result.outcome == MapEditResult::Outcome::kRefused) return edit + " refused reason=\"" + result.detail + "\"";
  return edit + (result.outcome == MapEditResult::Outcome::kApplied ? " applied" : " was applied before") +
         " revision=" + std::to_string(result.revision) + " changed_cells=" + std::to_string(result.changed_cells);
}

std::string first_word(const std::string& reason) { return reason.substr(0, reason.find(' ')).substr(0, 32); }

Batch Publication::whole() const {
  Batch batch;
  batch.tiles.resize(static_cast<std::size_t>(store_.map().tiles()));
  std::iota(batch.tiles.begin(), batch.tiles.end(), 0);

  batch.has_zones = true;
  batch.has_summary = true;
  return batch;
}

MapEditResult Publication::take(const fleet::MapEdit& edit, const std::string& source_id, std::int64_t stamp_ns) {
  return note(store_.take(edit, source_id, stamp_ns));
}

MapEditResult Publication::take(const fleet::ZoneEdit& edit, const std::string& source_id, std::int64_t stamp_ns) {
  return note(store_.take(edit, source_id, stamp_ns));
}

/// Only an edit that was applied now raised the revision.
MapEditResult Publication::note(const MapStore::Answer& answer) {
  changed_tiles_.insert(answer.changed_tiles.begin(), answer.changed_tiles.end());
  has_new_revision_ |= answer.result.outcome == MapEditResult::Outcome::kApplied;
  has_new_zones_ |= answer.zones_changed;
  results_.push_back(answer.result);

  return answer.result;
}

MapEditResult Publication::refuse(const std::string& edit_id, const std::string& reason) {
  results_.push_back(
      {edit_id, store_.map().map_id(), MapEditResult::Outcome::kRefused, reason, store_.map().revision(), 0});
  return results_.back();
}

Batch Publication::changes() {
  Batch batch;
  batch.tiles.assign(changed_tiles_.begin(), changed_tiles_.end());
  changed_tiles_.clear();
  batch.has_zones = std::exchange(has_new_zones_, false);
  batch.has_summary = std::exchange(has_new_revision_, false);
  batch.results = std::exchange(results_, {});

  return batch;
}

std::vector<std::string> Publication::ask(const fleet::MapRequest& request) {
  if (!request.map_id.empty() && request.map_id != store_.map().map_id()) return {"map_id is of another map"};
  is_summary_requested_ = true;

  std::vector<std::string> wrong;
  for (const std::uint32_t tile : request.tiles) {
    if (tile < static_cast<std::uint32_t>(store_.map().tiles())) {
      requested_tiles_.insert(static_cast<int>(tile));
    } else {
      wrong.push_back("tiles beyond the map");
    }
  }

  return wrong;
}

Batch Publication::requested(int most_tiles) {
  Batch batch;

  // The lowest indices first; the rest waits for the next call.
  const auto count = std::min<std::size_t>(static_cast<std::size_t>(most_tiles), requested_tiles_.size());

  const auto end = std::next(requested_tiles_.begin(), static_cast<std::ptrdiff_t>(count));
  batch.tiles.assign(requested_tiles_.begin(), end);
  requested_tiles_.erase(requested_tiles_.begin(), end);
  if (requested_tiles_.empty()) batch.has_summary = std::exchange(is_summary_requested_, false);

  return batch;
}

}  // namespace aisle::map
