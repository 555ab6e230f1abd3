#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "common/bus/topics.hpp"
#include "common/fleet/map_edit.hpp"
#include "common/fleet/origin.hpp"
#include "common/fleet/zone.hpp"
#include "common/service/origin_stamper.hpp"
#include "tools/cli/cli.hpp"

namespace aisle::cli {

/// Sends one edit, of cells or of a zone, to aisle-map and waits for its result.
class EditTalk {
 public:
  /// The result, and which map service it is from.
  struct Answer {
    fleet::MapEditResult result;
    fleet::Origin by;
  };

  /// @pre `bus` outlives it
  explicit EditTalk(bus::Bus& bus);

  /// Sends the edit to the map with this id, or to the first one that is seen when `map_id` is empty.
  /// Repeats it until its result comes; the map applies it once. @throws config::BadEnvironment when
  /// there is no map, or no answer, within `timeout_s` seconds each
  Answer apply(const fleet::MapEdit& edit, const std::string& map_id, double timeout_s);
  Answer apply(const fleet::ZoneEdit& edit, const std::string& map_id, double timeout_s);

 private:
  /// The id of the first map that is seen; empty when none is in time.
  std::string find_map(Seconds limit);

  /// apply() for both kinds of edits.
  template <class Topic, class Edit>
  Answer apply_by(bus::Writer<Topic>& writer, Edit edit, const std::string& map_id, double timeout_s);

  /// Repeats the edit until its result comes; none when it does not in time.
  template <class Topic, class Edit>
  std::optional<Answer> send(bus::Writer<Topic>& writer, const Edit& edit, Seconds limit);

  bus::Bus& bus_;
  bus::Writer<topics::MapEdit> cell_edits_;
  bus::Writer<topics::ZoneEdit> zone_edits_;
  service::OriginStamper stamper_;
  std::string map_id_;
  std::string edit_id_;
  std::optional<Answer> result_;
};

/// Prints the result, as JSON if asked for. Returns the exit code: 1 when it was refused. `what`: was applied; empty:
/// so many cells changed.
int print_result(const Cli& cli, const EditTalk::Answer& answer, const std::string& what = "");

}  // namespace aisle::cli
