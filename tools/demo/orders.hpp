#pragma once

#include <string>
#include <vector>

namespace aisle::demo {

/// Kill a service (SIGKILL) at a second of the run, and start it again after a while.
struct KillOrder {
  std::string service;  // an instance ("local-planner-agv-1"), or all of a service ("local-planner")
  double at_s{0.0};
  double restart_after_s{1.0};
};

/// "SERVICE@SECONDS[:RESTART_AFTER_S]". @throws config::BadInput
KillOrder parse_kill(const std::string& text);

/// Start a service only at a second of the run: a late joiner.
struct DelayOrder {
  std::string service;
  double until_s{0.0};
};

/// "SERVICE@SECONDS". @throws config::BadInput
DelayOrder parse_delay(const std::string& text);

/// Does `service` mean this instance: the instance itself, or all of a service ("local-planner" means
/// "local-planner-agv-1")?
bool means(const std::string& service, const std::string& instance);

/// @throws config::BadInput when no instance is meant, with the nearest name
void require_known(const std::string& service, const std::vector<std::string>& instances);

}  // namespace aisle::demo
