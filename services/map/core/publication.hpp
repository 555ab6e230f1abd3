#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/fleet/map_edit.hpp"
#include "common/fleet/map_request.hpp"
#include "services/map/core/map_store.hpp"

namespace aisle::map {

/// What is written at once, in this order: the summary after its tiles, so that it completes a mirror; results last.
struct Batch {
  std::vector<int> tiles;  // indices
  bool has_zones{false};
  bool has_summary{false};
  std::vector<fleet::MapEditResult> results;
};

/// The name of the counter in service_health under which an edit's outcome is counted.
const char* counter_of(fleet::MapEditResult::Outcome outcome);

/// The line of the log about an edit's outcome; of a repeated edit, with the revision that it led to.
std::string log_text(const fleet::MapEditResult& result);

/// "points" of "points has 0 elements, not 1 to 64": reasons begin with the field. At most 32 characters.
std::string first_word(const std::string& reason);

/// The map and what is still to be published of it: the tiles that edits changed with the edits' results, and the tiles
/// that mirrors asked for. Collects between two writes, so that a tile changed by ten edits is written once.
class Publication {
 public:
  explicit Publication(MapStore store) : store_(std::move(store)) {}

  /// The map as it is now.
  const MapStore& store() const { return store_; }

  /// The whole map, for the start.
  Batch whole() const;

  /// Applies the edit, or not; the result is also in the next changes(). See MapStore::take().
  fleet::MapEditResult take(const fleet::MapEdit& edit, const std::string& source_id, std::int64_t stamp_ns);

  fleet::MapEditResult take(const fleet::ZoneEdit& edit, const std::string& source_id, std::int64_t stamp_ns);

  /// Answers an edit whose sample could not be decoded; `reason` goes to its sender. Nothing changes.
  fleet::MapEditResult refuse(const std::string& edit_id, const std::string& reason);

  /// Tiles and results of all edits since the last call; the summary when the revision rose, the zones
  /// when they changed.
  Batch changes();

  /// Notes what a mirror asks for; returns what was wrong with it, one reason each.
  std::vector<std::string> ask(const fleet::MapRequest& request);

  /// At most `most_tiles` of what was asked for, so that asking holds up no edit; the summary after the last of them.
  Batch requested(int most_tiles);

 private:
  /// Notes what is to be published of an edit's answer.
  fleet::MapEditResult note(const MapStore::Answer& answer);

  MapStore store_;

  // For changes().
  std::set<int> changed_tiles_;
  bool has_new_revision_{false};
  bool has_new_zones_{false};
  std::vector<fleet::MapEditResult> results_;

  // For requested().
  std::set<int> requested_tiles_;
  bool is_summary_requested_{false};
};

}  // namespace aisle::map
