#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace aisle::fleet {

/// Not yet running; lacks something (see waits_for); works; works, but not as it should; its last word.
enum class ServiceState { kStarting, kWaiting, kReady, kDegraded, kStopping };

/// What a service's process says of itself, every second and when it changes.
struct ServiceHealth {
  std::string instance_id;  // "local-planner-agv-1"
  std::string service;      // "local-planner"
  std::string software_version;
  std::uint32_t idl_version{0};
  std::string host;
  std::uint32_t process_id{0};
  std::string agv_id;  // of a service for one vehicle, else empty
  std::string map_id;  // of the map that it uses; empty: none
  std::uint64_t map_revision{0};
  std::uint64_t map_hash{0};
  ServiceState state{ServiceState::kStarting};
  std::string waits_for;  // for people; empty: nothing
  std::string last_error;
  std::int64_t wall_clock_ns{0};  // Unix epoch
  double cpu_percent{0.0};        // of one core, since the sample before
  double resident_mb{0.0};
  std::map<std::string, std::uint64_t> counters;  // by name, at most 32
};

/// "degraded"
const char* name(ServiceState state);

}  // namespace aisle::fleet
