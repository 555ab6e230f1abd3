#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <unordered_map>
#include <vector>

#include "services/map/core/journal.hpp"
#include "services/map/core/site_map.hpp"

namespace aisle::map {

/// The site's map with its edits: each is applied once, is in the journal before it is applied, and raises the revision
/// by one. Without a journal edits last until the process ends.
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
  };

  /// Applies what the journal holds to `base`, the map of the file at revision 1.
  /// @param journal null: edits are kept in memory only
  /// @throws config::BadInput when the journal's edits do not fit the map
  MapStore(SiteMap base, std::unique_ptr<Journal> journal, const Limits& limits);

  /// Applies the edit once. An edit_id that was applied before changes nothing and gets its first revision again; an
  /// edit that does not fit the map, or that the journal cannot keep, is refused with a reason and changes nothing.
  /// `source_id`: the client; `stamp_ns`: now, nanoseconds since the Unix epoch.
  Answer take(const fleet::MapEdit& edit, const std::string& source_id, std::int64_t stamp_ns);

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

  /// Of action, shape, radius and points: tells a repetition from another edit under the same id.
  static std::uint64_t content_hash(const fleet::MapEdit& edit);

  SiteMap map_;
  std::unique_ptr<Journal> journal_;
  Limits limits_;
  std::unordered_map<std::string, Applied> applied_;
};

}  // namespace aisle::map
