#include "common/fleet/health.hpp"

namespace aisle::fleet {

const char* name(ServiceState state) {
  switch (state) {
    case ServiceState::kStarting:
      return "starting";
    case ServiceState::kWaiting:
      return "waiting";
    case ServiceState::kReady:
      return "ready";
    case ServiceState::kDegraded:
      return "degraded";
    case ServiceState::kStopping:
      return "stopping";
  }

  return "unknown";
}

}  // namespace aisle::fleet
