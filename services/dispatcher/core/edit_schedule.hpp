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
  /// `done`: ids that were answered before a restart.
  EditSchedule(const scenario::Scenario& scenario, const std::vector<std::string>& done);

  /// Edits to write at this second of the scenario. Nothing before the id of the map is known.
  std::vector<fleet::MapEdit> due(double seconds, const std::string& map_id, time::Stamp now);

  /// True when the answer is to an edit of ours that was open.
  bool answered(const std::string& edit_id);

  bool all_done() const;
  std::vector<std::string> done() const;

  static constexpr std::chrono::milliseconds kRepeat{500};

 private:
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
