#pragma once

#include <string>
#include <vector>

#include "common/fleet/map_edit.hpp"
#include "common/scenario/scenario.hpp"
#include "common/time/stamp.hpp"

namespace aisle::dispatcher {

/// The map edits of a scenario at their times. Each is written again under the same id until aisle-map answers, so that
/// it is applied once however often it is sent.
class EditSchedule {
 public:
  /// `done`: ids of edits that were answered before a restart, as done() gave them; they are not sent again.
  EditSchedule(const scenario::Scenario& scenario, const std::vector<std::string>& done);

  /// The edits to write now. None while `map_id` is empty, as the map is not known yet.
  /// @param seconds since the scenario's second zero
  /// @param now of the clock by which edits are repeated
  std::vector<fleet::MapEdit> due(double seconds, const std::string& map_id, time::Stamp now);

  /// Notes the answer to an edit, whatever it says. True when it was an edit of this schedule and still open.
  bool answered(const std::string& edit_id);

  /// Every edit was answered.
  bool all_done() const;

  /// Ids of the answered edits, for a restart.
  std::vector<std::string> done() const;

  static constexpr std::chrono::milliseconds kRepeat{500};

 private:
  /// An edit, the second at which it is due, and what became of it.
  struct Entry {
    double at_s;
    fleet::MapEdit edit;
    bool done{false};
    bool sent{false};
    time::Stamp sent_at{};
  };

  std::vector<Entry> entries_;
};

}  // namespace aisle::dispatcher
