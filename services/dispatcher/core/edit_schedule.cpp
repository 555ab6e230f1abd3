#include "services/dispatcher/core/edit_schedule.hpp"

#include <algorithm>
#include <utility>

namespace aisle::dispatcher {

EditSchedule::EditSchedule(const scenario::Scenario& scenario, const std::vector<std::string>& done) {
  for (const scenario::MapEdit& planned : scenario.map_edits) {
    Entry entry{planned.at_s, {}, false, false, {}};
    entry.edit.edit_id = scenario.name.substr(0, 40) + "/edit/" + std::to_string(entries_.size());
    entry.edit.action = planned.block ? fleet::MapEdit::Action::kBlock : fleet::MapEdit::Action::kUnblock;
    entry.edit.shape = fleet::MapEdit::Shape::kRectangle;
    entry.edit.points_in_map = {planned.low_in_map, planned.high_in_map};

    entry.done = std::find(done.begin(), done.end(), entry.edit.edit_id) != done.end();
    entries_.push_back(std::move(entry));
  }
}

std::vector<fleet::MapEdit> EditSchedule::due(double seconds, const std::string& map_id, time::Stamp now) {
  std::vector<fleet::MapEdit> edits;
  if (map_id.empty()) return edits;

  // Due and not yet answered: written at once, and again after each kRepeat.
  for (Entry& entry : entries_) {
    if (entry.done || seconds < entry.at_s || (entry.sent && now - entry.sent_at < kRepeat)) continue;

    entry.sent = true;
    entry.sent_at = now;
    entry.edit.map_id = map_id;
    edits.push_back(entry.edit);
  }

  return edits;
}

bool EditSchedule::answered(const std::string& edit_id) {
  for (Entry& entry : entries_) {
    if (entry.edit.edit_id == edit_id && !entry.done) return entry.done = true;
  }

  return false;
}

bool EditSchedule::all_done() const {
  return std::all_of(entries_.begin(), entries_.end(), [](const Entry& entry) { return entry.done; });
}

std::vector<std::string> EditSchedule::done() const {
  std::vector<std::string> ids;
  for (const Entry& entry : entries_) {
    if (entry.done) ids.push_back(entry.edit.edit_id);
  }

  return ids;
}

}  // namespace aisle::dispatcher
