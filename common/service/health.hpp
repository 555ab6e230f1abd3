#pragma once

#include <cstdint>
#include <string>

#include "common/fleet/health.hpp"

namespace aisle::service {

/// What a shell says of its service on `service_health`. The shell fills in its identity and its map;
/// the service says what it waits for, its last error and its counters.
struct Health : fleet::ServiceHealth {
  bool is_degraded{false};  // works, but not as it should: ServiceState::kDegraded

  /// Adds `by` to the counter. There are at most 32 names; further ones are left out.
  void count(const std::string& name, std::uint64_t by = 1);

  /// The map that the service uses, or keeps.
  void tell_map(const std::string& id, std::uint64_t revision, std::uint64_t hash);

  /// Adds to waits_for, separated by commas, while it is shorter than 200 characters.
  void wait_for(const std::string& what);
};

}  // namespace aisle::service
