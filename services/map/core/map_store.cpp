#include "services/map/core/map_store.hpp"

#include <limits>
#include <utility>

#include "common/config/reader.hpp"
#include "services/map/core/content_hash.hpp"

namespace aisle::map {
namespace {

using fleet::MapEdit;
using fleet::MapEditResult;
using fleet::ZoneEdit;

/// Of what the edit does: tells a repetition from another edit under the same id.
std::uint64_t content_hash(const MapEdit& edit) {
  return ContentHash().mix(edit.action).mix(edit.shape).mix(edit.radius_m).mix(edit.points_in_map).value();
}

/// A removal names its zone and nothing else.
std::uint64_t content_hash(const ZoneEdit& edit) {
  ContentHash hash;
  hash.mix(std::string("zone")).mix(edit.action);
  if (edit.action == ZoneEdit::Action::kRemove) return hash.mix(edit.zone.id).value();

  return hash.mix(edit.zone).value();
}

}  // namespace

MapStore::MapStore(SiteMap base, std::unique_ptr<Journal> journal, const Limits& limits, std::vector<fleet::Zone> zones)
    : map_(std::move(base)),
      zones_(map_.map_id(), std::move(zones), map_.revision()),
      journal_(std::move(journal)),
      limits_(limits) {
  if (!journal_) return;

  for (const JournalEntry& entry : journal_->entries()) {
    const std::string reason =
        entry.revision == map_.revision() + 1 ? replay(entry) : "has revision " + std::to_string(entry.revision);
    if (!reason.empty()) {
      throw config::BadInput("journal " + journal_->file().string() + ": edit '" +
                             (entry.zone_edit ? entry.zone_edit->edit_id : entry.edit.edit_id) +
                             "' does not fit the map: " + reason);
    }
  }
}

/// Each entry goes through the same checks and the same rasteriser as when it was accepted.
std::string MapStore::replay(const JournalEntry& entry) {
  if (entry.zone_edit) {
    const ZoneEdit& edit = *entry.zone_edit;
    std::string reason = zones_.refusal_of(edit, map_.grid().geometry());
    if (!reason.empty()) return reason;

    map_.apply({}, MapEdit::Action::kBlock);
    zones_.apply(edit, map_.revision());
    applied_[edit.edit_id] = {entry.revision, 0, content_hash(edit)};

    return {};
  }

  // Limits may have been lowered since; what was acknowledged is kept.
  std::string reason = refusal_of(entry.edit, map_, {std::numeric_limits<int>::max()});
  if (!reason.empty()) return reason;

  map_.apply(rasterise(entry.edit, map_.grid().geometry()), entry.edit.action);
  applied_[entry.edit.edit_id] = {entry.revision, entry.changed_cells, content_hash(entry.edit)};

  return {};
}

MapStore::Answer MapStore::refused(const std::string& edit_id, const std::string& map_id,
                                   const std::string& reason) const {
  Answer answer;
  answer.result = {edit_id, map_id, MapEditResult::Outcome::kRefused, reason, map_.revision(), 0};
  return answer;
}

/// Clients repeat an edit until they hear its result; the first result is given again.
std::optional<MapStore::Answer> MapStore::repeated(const std::string& edit_id, std::uint64_t content_hash) const {
  const auto known = applied_.find(edit_id);
  if (known == applied_.end()) return std::nullopt;

  if (known->second.content_hash != content_hash)
    return refused(edit_id, map_.map_id(), "edit_id was used before, for another edit: give each edit its own");

  Answer answer;
  answer.result = {edit_id, map_.map_id(),          MapEditResult::Outcome::kAlreadyApplied,
                   {},      known->second.revision, known->second.changed_cells};

  return answer;
}

std::string MapStore::keep(const JournalEntry& entry) {
  if (applied_.size() >= static_cast<std::size_t>(limits_.max_edits)) {
    return "the map holds " + std::to_string(limits_.max_edits) +
           " edits, the most allowed: save it and start with a new journal";
  }

  try {
    if (journal_) journal_->append(entry);
  } catch (const JournalError& error) {
    return error.what();
  }

  return {};
}

MapStore::Answer MapStore::take(const MapEdit& edit, const std::string& source_id, std::int64_t stamp_ns) {
  // 1. Is it an edit that this map can take?
  std::string reason = refusal_of(edit, map_, limits_.edit);
  if (!reason.empty()) return refused(edit.edit_id, edit.map_id, reason);

  // 2. Is it a repetition?
  const std::uint64_t hash = content_hash(edit);
  if (std::optional<Answer> known = repeated(edit.edit_id, hash)) return *std::move(known);

  // 3. Keep it on the disk, then apply it: after a crash between the two the journal applies it at the next start.
  const std::vector<CellRun> runs = rasterise(edit, map_.grid().geometry());
  const JournalEntry entry{map_.revision() + 1, edit, map_.count_changes(runs, edit.action), source_id, stamp_ns, {}};
  reason = keep(entry);
  if (!reason.empty()) return refused(edit.edit_id, edit.map_id, reason);

  Answer answer;
  answer.changed_tiles = map_.apply(runs, edit.action);
  answer.result = {edit.edit_id, edit.map_id,    MapEditResult::Outcome::kApplied,
                   {},           entry.revision, entry.changed_cells};
  applied_[edit.edit_id] = {entry.revision, entry.changed_cells, hash};

  return answer;
}

MapStore::Answer MapStore::take(const ZoneEdit& edit, const std::string& source_id, std::int64_t stamp_ns) {
  // A repetition first: the zone that it added, or removed, would speak against it.
  const std::uint64_t hash = content_hash(edit);
  if (edit.map_id == map_.map_id()) {
    if (std::optional<Answer> known = repeated(edit.edit_id, hash)) return *std::move(known);
  }

  std::string reason = zones_.refusal_of(edit, map_.grid().geometry());
  if (!reason.empty()) return refused(edit.edit_id, edit.map_id, reason);

  const JournalEntry entry{map_.revision() + 1, {}, 0, source_id, stamp_ns, edit};
  reason = keep(entry);
  if (!reason.empty()) return refused(edit.edit_id, edit.map_id, reason);

  // No cell changes, but the revision is the map's.
  map_.apply({}, MapEdit::Action::kBlock);
  zones_.apply(edit, map_.revision());

  Answer answer;
  answer.zones_changed = true;
  answer.result = {edit.edit_id, edit.map_id, MapEditResult::Outcome::kApplied, {}, entry.revision, 0};
  applied_[edit.edit_id] = {entry.revision, 0, hash};

  return answer;
}

}  // namespace aisle::map
