#pragma once
#include <cstdint>
#include <map>
#include <string>

#include "common/bus/topics.hpp"

namespace aisle::service {

/// What a shell says of its service on `service_health`, every second and soon after state, waits_for or last_error
/// change.
struct Health {
  aisle::ServiceState state{};  // STARTING until the service reports
  std::string waits_for;        // e.g. "map_info, vehicle_state"; empty when nothing
  std::string last_error;
  std::string map_id;
  std::uint64_t map_revision{0};
  std::uint64_t map_hash{0};
  std::map<std::string, std::uint64_t> counters;
  bool is_degraded{false};  // works, but not as it should: SERVICE_DEGRADED

  /// At most 32 names; further ones are left out.
  void count(const std::string& name, std::uint64_t by = 1);
  /// Adds to waits_for, separated by commas, while it is shorter than 200 characters.
  void wait_for(const std::string& what);
};

}  // namespace aisle::service
