#pragma once

// What the doctor thinks of what it saw. No DDS calls, clocks or sockets: doctor.cpp gathers, this judges.

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/fleet/health.hpp"
#include "common/fleet/origin.hpp"
#include "common/fleet/vehicle_state.hpp"
#include "tools/cli/topic_table.hpp"

namespace aisle::cli {

/// One thing that is wrong, with words that say what to do.
struct Problem {
  std::string about;  // "discovery", "qos", "type", "partition", "network", "clock", "version", "service", "vehicle",
                      // "shared memory"
  std::string text;
  bool is_past{false};  // worth to know, but over
};

/// One IPv4 address of this host.
struct NetworkInterface {
  std::string name;
  std::string address;
  bool is_loopback{false};
  bool multicast_works{false};  // a datagram sent to a group came back
};

/// The folder in which the shared-memory transport keeps its segments.
struct SharedMemory {
  std::string folder;
  bool exists{false};
  bool is_writable{false};
  std::uint64_t capacity_bytes{0};
  std::uint64_t available_bytes{0};
  int left_over_files{0};  // segments of Fast DDS that no live process has
  std::uint64_t left_over_bytes{0};
};

/// `participants`: other processes seen. `other_domains`: those where one was seen, when none was seen
/// in ours.
std::vector<Problem> judge_discovery(const bus::Settings& settings, std::size_t participants,
                                     const std::set<int>& other_domains);

/// Addresses that this host does not have, and interfaces on which multicast is needed and does not
/// work.
std::vector<Problem> judge_network(const bus::Settings& settings, const std::vector<NetworkInterface>& interfaces);

/// Too little room for segments, and segments that killed processes left behind. Empty unless the
/// settings ask for shared memory.
std::vector<Problem> judge_shared_memory(const bus::Settings& settings, const SharedMemory& memory);

/// Compares types and QoS on the wire with the table of topics, and the partitions in which Aisle's
/// topics are used with ours.
std::vector<Problem> judge_endpoints(const bus::Settings& settings, const std::vector<bus::Endpoint>& endpoints);

/// Services that are not ready; an error that a ready one had counts as past. `gone`: those that fell
/// silent.
std::vector<Problem> judge_services(const std::map<std::string, fleet::ServiceHealth>& newest,
                                    const std::set<std::string>& gone);

/// Finds out whether several processes write one vehicle's state.
class VehicleWatch {
 public:
  /// One sample; `by` tells which process wrote it.
  void take(const fleet::VehicleState& state, const fleet::Origin& by);

  /// Two processes with one vehicle's id, and vehicles that hold.
  std::vector<Problem> judge() const;
  std::size_t vehicles() const { return writers_.size(); }

 private:
  /// One start of a process that writes a vehicle's state.
  struct Writer {
    std::string source_id;
    int samples{0};
  };

  std::map<std::string, std::map<std::uint64_t, Writer>> writers_;  // by agv id, by boot id
  std::map<std::string, std::string> holds_;                        // newest hold reason, when there is one
};

}  // namespace aisle::cli
