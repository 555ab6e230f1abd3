#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "services/map/core/journal.hpp"
#include "services/map/core/site_map.hpp"
#include "services/map/core/zone_set.hpp"

namespace aisle::map {

/// The site's map and its zones with their edits: each is applied once, is in the journal before it is applied, and
/// raises the revision by one. Without a journal edits last until the process ends.
class MapStore {
 public:
  /// What is accepted from now on; entries of the journal are kept whatever the limits are.
  struct Limits {
    EditLimits edit;
    int max_edits{200000};  // of this map, ever; beyond, save the map and start a new journal
  };

  /// The result for the client, and the tiles to publish (indices, ascending).
  struct Answer {
    fleet::MapEditResult result;
    std::vector<int> changed_tiles;
    bool zones_changed{false};
  };

  /// Applies what the journal holds to `base`, the map of the file at revision 1.
  /// @param journal null: edits are kept in memory only
  /// @param zones those of the map's file of zones, at the same revision
  /// @throws config::BadInput when the journal's edits do not fit the map
  MapStore(SiteMap base, std::unique_ptr<Journal> journal, const Limits& limits, std::vector<fleet::Zone> zones = {});

  /// Applies the edit once. An edit_id that was applied before changes nothing and gets its first revision again; an
  /// edit that does not fit the map, or that the journal cannot keep, is refused with a reason and changes nothing.
  /// `source_id`: the client; `stamp_ns`: now, nanoseconds since the Unix epoch.
  Answer take(const fleet::MapEdit& edit, const std::string& source_id, std::int64_t stamp_ns);

  /// The same for an edit of a zone; no tile changes.
  Answer take(const fleet::ZoneEdit& edit, const std::string& source_id, std::int64_t stamp_ns);

  /// All zones, by id, and the revision at which they changed last.
  const fleet::MapZones& zones() const { return zones_.all(); }

  /// The map with all edits applied.
  const SiteMap& map() const { return map_; }

  /// Edits that were applied, those of the journal included.
  std::size_t edits() const { return applied_.size(); }

 private:
  /// What is remembered of an edit, so that its repetition gets the same answer.
  struct Applied {
    std::uint64_t revision;
    std::uint32_t changed_cells;
    std::uint64_t content_hash;
  };

  /// Applies an entry of the journal. Returns why it does not fit; empty when it was applied.
  std::string replay(const JournalEntry& entry);

  /// The answer to an edit under an id that was used before; none for a new one.
  std::optional<Answer> repeated(const std::string& edit_id, std::uint64_t content_hash) const;

  /// Puts the entry on the disk. Returns why it cannot be kept; empty when it is.
  std::string keep(const JournalEntry& entry);

  /// Nothing changed, for this reason.
  Answer refused(const std::string& edit_id, const std::string& map_id, const std::string& reason) const;

  SiteMap map_;
  ZoneSet zones_;
  std::unique_ptr<Journal> journal_;
  Limits limits_;
  std::unordered_map<std::string, Applied> applied_;
};

}  // namespace aisle::map
