#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "common/bus/topics.hpp"
#include "common/fleet/map_edit.hpp"
#include "common/fleet/origin.hpp"
#include "common/service/origin_stamper.hpp"
#include "tools/cli/cli.hpp"

namespace aisle::cli {

/// Sends one edit to aisle-map and waits for its result.
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
  Answer apply(fleet::MapEdit edit, const std::string& map_id, double timeout_s);

 private:
  /// The id of the first map that is seen; empty when none is in time.
  std::string find_map(Seconds limit);

  /// Repeats the edit until its result comes; none when it does not in time.
  std::optional<Answer> send(const fleet::MapEdit& edit, Seconds limit);

  bus::Bus& bus_;
  bus::Writer<topics::MapEdit> writer_;
  service::OriginStamper stamper_;
  std::string map_id_;
  std::string edit_id_;
  std::optional<Answer> result_;
};

/// Prints the result, as JSON if asked for. Returns the exit code: 1 when it was refused.
int print_result(const Cli& cli, const EditTalk::Answer& answer);

}  // namespace aisle::cli
