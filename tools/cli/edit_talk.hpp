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

/// Sends one edit to aisle-map and waits for what became of it.
class EditTalk {
 public:
  struct Answer {
    fleet::MapEditResult result;
    fleet::Origin by;
  };

  /// On a bus that must outlive it.
  explicit EditTalk(bus::Bus& bus);

  /// Sends it to the map with this id, or to the one that is seen when `map_id` is empty. The edit is repeated, and
  /// applied once, until its result comes. @throws config::BadEnvironment when there is no map, or no answer, within
  /// `timeout_s` each
  Answer apply(fleet::MapEdit edit, const std::string& map_id, double timeout_s);

 private:
  /// Empty when no map is seen in time.
  std::string find_map(Seconds limit);
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
