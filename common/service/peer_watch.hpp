#pragma once

#include <cstdint>
#include <string>
#include <unordered_map>
#include <vector>

#include "common/time/stamp.hpp"

namespace aisle::service {

/// The part of a `service_health` by which other processes judge its sender.
struct PeerHealth {
  std::string instance_id;
  std::string host;
  std::uint32_t process_id{0};
  std::uint64_t boot_id{0};
  std::uint32_t idl_version{0};
  std::string software_version;
  std::int64_t wall_clock_ns{0};
  bool is_stopping{false};
  std::string service{};
  std::string agv_id{};  // of a service for one vehicle, else empty
};

/// A contradiction between processes, in words.
struct Finding {
  enum class Kind { kDuplicateInstance, kDuplicateVehicle, kOtherIdlVersion, kClockSkew };

  Kind kind;
  std::string instance_id;
  std::string text;
};

/// Notices two processes with one instance id, two of one service for one vehicle, another IDL version,
/// and clocks more than a second apart. Says each once for each start of the other process. Pure: times
/// come in as arguments. Remembers at most 512 instances.
class PeerWatch {
 public:
  /// `own_instance_id` and `own_boot_id`: of the process that watches; empty and 0 for an observer without a health of
  /// its own. `own_service` and `own_agv_id`: of a process for one vehicle, which then is the only one of its kind.
  PeerWatch(std::string own_instance_id, std::uint64_t own_boot_id, std::uint32_t own_idl_version,
            std::string own_service = {}, std::string own_agv_id = {});

  /// A sample that arrived at `now`, when this host's wall clock showed `wall_clock_ns`.
  std::vector<Finding> take(const PeerHealth& peer, time::Stamp now, std::int64_t wall_clock_ns);

 private:
  /// What is known of one instance, and what was already said of it.
  struct Seen {
    PeerHealth newest;            // of the start with the highest boot id
    time::Stamp first_arrival{};  // of that start
    double last_skew_s{0.0};
    int samples{0};
    bool said_duplicate{false}, said_twin{false}, said_version{false}, said_skew{false};
  };

  /// Another process of our service for our vehicle?
  bool is_twin(const PeerHealth& peer) const;

  /// Another process with the instance id of this one, or of a peer that started later?
  bool is_duplicate(const PeerHealth& peer, const Seen* seen, time::Stamp now) const;

  std::string own_instance_id_;
  std::uint64_t own_boot_id_;
  std::uint32_t own_idl_version_;
  std::string own_service_;
  std::string own_agv_id_;
  std::unordered_map<std::string, Seen> seen_;
};

}  // namespace aisle::service
