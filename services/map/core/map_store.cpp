#include "services/map/core/map_store.hpp"

#include <cstring>
#include <limits>
#include <utility>

#include "common/config/reader.hpp"

namespace aisle::map {

using fleet::MapEdit;
using fleet::MapEditResult;

MapStore::MapStore(SiteMap base, std::unique_ptr<Journal> journal, const Limits& limits)
    : map_(std::move(base)), journal_(std::move(journal)), limits_(limits) {
  if (!journal_) return;

  // Replay: each entry goes through the same checks and the same rasteriser as when it was accepted.
  for (const JournalEntry& entry : journal_->entries()) {
    // Limits may have been lowered since; what was acknowledged is kept.
    std::string reason = refusal_of(entry.edit, map_, {std::numeric_limits<int>::max()});
    if (reason.empty() && entry.revision != map_.revision() + 1)
      reason = "has revision " + std::to_string(entry.revision);

    if (!reason.empty()) {
      throw config::BadInput("journal " + journal_->file().string() + ": edit '" + entry.edit.edit_id +
                             "' does not fit the map: " + reason);
    }

    map_.apply(rasterise(entry.edit, map_.grid().geometry()), entry.edit.action);
    applied_[entry.edit.edit_id] = {entry.revision, entry.changed_cells, content_hash(entry.edit)};
  }
}

MapStore::Answer MapStore::take(const MapEdit& edit, const std::string& source_id, std::int64_t stamp_ns) {
  Answer answer;
  answer.result = {edit.edit_id, edit.map_id, MapEditResult::Outcome::kRefused, {}, map_.revision(), 0};

  const auto refused = [&](const std::string& reason) {
    answer.result.detail = reason;
    return answer;
  };

  // 1. Is it an edit that this map can take?
  std::string reason = refusal_of(edit, map_, limits_.edit);
  if (!reason.empty()) return refused(reason);

  // 2. Is it a repetition? Clients repeat an edit until they hear its result; the first result is given again.
  if (const auto known = applied_.find(edit.edit_id); known != applied_.end()) {
    if (known->second.content_hash != content_hash(edit))
      return refused("edit_id was used before, for another edit: give each edit its own");

    answer.result.outcome = MapEditResult::Outcome::kAlreadyApplied;
    answer.result.revision = known->second.revision;
    answer.result.changed_cells = known->second.changed_cells;

    return answer;
  }

  // 3. Keep it on the disk, then apply it: after a crash between the two the journal applies it at the next start.
  if (applied_.size() >= static_cast<std::size_t>(limits_.max_edits)) {
    return refused("the map holds " + std::to_string(limits_.max_edits) +
                   " edits, the most allowed: save it and start with a new journal");
  }

  const std::vector<CellRun> runs = rasterise(edit, map_.grid().geometry());
  const JournalEntry entry{map_.revision() + 1, edit, map_.count_changes(runs, edit.action), source_id, stamp_ns};
  try {
    if (journal_) journal_->append(entry);
  } catch (const JournalError& error) {
    return refused(error.what());
  }

  answer.changed_tiles = map_.apply(runs, edit.action);
  applied_[edit.edit_id] = {entry.revision, entry.changed_cells, content_hash(edit)};
  answer.result.outcome = MapEditResult::Outcome::kApplied;
  answer.result.revision = entry.revision;
  answer.result.changed_cells = entry.changed_cells;

  return answer;
}

std::uint64_t MapStore::content_hash(const MapEdit& edit) {
  // FNV-1a, 64 bits (Fowler, Noll, Vo): hash = (hash xor byte) * prime, byte by byte.
  std::uint64_t hash = 14695981039346656037ULL;
  const auto mix = [&hash](const auto& value) {
    unsigned char bytes[sizeof(value)];
    std::memcpy(bytes, &value, sizeof(value));
    for (const unsigned char byte : bytes) hash = (hash ^ byte) * 1099511628211ULL;
  };

  mix(edit.action);
  mix(edit.shape);
  mix(edit.radius_m);

  for (const geometry::Point2 point : edit.points_in_map) {
    mix(point.x);
    mix(point.y);
  }

  return hash;
}

}  // namespace aisle::map
