#include "common/service/peer_watch.hpp"

#include <spdlog/fmt/fmt.h>

#include <cmath>
#include <utility>

namespace aisle::service {
namespace {

constexpr std::size_t kMostInstances = 512;
constexpr double kMostSkewS = 1.0;

// An older process's last sample may still be on its way when a restarted one speaks; after this it is a second
// process.
constexpr time::Stamp kHandover = std::chrono::milliseconds(500);

/// For messages.
std::string name_of(const PeerHealth& peer) { return fmt::format("process {} on host {}", peer.process_id, peer.host); }

/// `other`: the process that has the same id; null: it is this one.
Finding duplicate_instance(const PeerHealth& peer, const PeerHealth* other) {
  return {Finding::Kind::kDuplicateInstance, peer.instance_id,
          fmt::format("instance id '{}' is used twice: also by {}{}; give one of them another --instance",
                      peer.instance_id, name_of(peer), other == nullptr ? "" : " beside " + name_of(*other))};
}

/// Another process of this one's service for the same vehicle.
Finding duplicate_vehicle(const PeerHealth& peer) {
  return {Finding::Kind::kDuplicateVehicle, peer.instance_id,
          fmt::format("'{}' has two processes of the service {}: '{}' ({}) beside this one; stop one of "
                      "them, or give it another vehicle's id",
                      peer.agv_id, peer.service, peer.instance_id, name_of(peer))};
}

Finding other_idl_version(const PeerHealth& peer, std::uint32_t own_idl_version) {
  return {Finding::Kind::kOtherIdlVersion, peer.instance_id,
          fmt::format("{} ({}) speaks IDL version {} (software {}), this process {}; install the same release on both",
                      peer.instance_id, name_of(peer), peer.idl_version, peer.software_version, own_idl_version)};
}

/// `skew_s`: how much the peer's wall clock shows more than ours.
Finding clock_skew(const PeerHealth& peer, double skew_s) {
  return {Finding::Kind::kClockSkew, peer.instance_id,
          fmt::format("the clock of host {} ({}) is {:.1f} s {} ours; synchronise both, e.g. with chrony", peer.host,
                      peer.instance_id, std::abs(skew_s), skew_s > 0 ? "ahead of" : "behind")};
}

}  // namespace

PeerWatch::PeerWatch(std::string own_instance_id, std::uint64_t own_boot_id, std::uint32_t own_idl_version,
                     std::string own_service, std::string own_agv_id)
    : own_instance_id_(std::move(own_instance_id)),
      own_boot_id_(own_boot_id),
      own_idl_version_(own_idl_version),
      own_service_(std::move(own_service)),
      own_agv_id_(std::move(own_agv_id)) {}

bool PeerWatch::is_twin(const PeerHealth& peer) const {
  return !peer.is_stopping && !own_agv_id_.empty() && peer.agv_id == own_agv_id_ && peer.service == own_service_ &&
         peer.instance_id != own_instance_id_;
}

/// A sample of an earlier start than the newest one known: the older process still lives, unless the
/// newer has only just come.
bool PeerWatch::is_duplicate(const PeerHealth& peer, const Seen* seen, time::Stamp now) const {
  if (peer.is_stopping) return false;
  if (!own_instance_id_.empty() && peer.instance_id == own_instance_id_) return peer.boot_id != own_boot_id_;
  return seen != nullptr && peer.boot_id < seen->newest.boot_id && now - seen->first_arrival > kHandover;
}

/// Judged by the newest start of the instance. An older start that still speaks is a duplicate; a newer
/// one is judged anew.
std::vector<Finding> PeerWatch::take(const PeerHealth& peer, time::Stamp now, std::int64_t wall_clock_ns) {
  std::vector<Finding> findings;
  if (peer.boot_id == own_boot_id_ && peer.instance_id == own_instance_id_) return findings;

  auto position = seen_.find(peer.instance_id);
  const bool duplicate = is_duplicate(peer, position == seen_.end() ? nullptr : &position->second, now);

  if (position == seen_.end()) {
    if (seen_.size() >= kMostInstances) seen_.erase(seen_.begin());
    position = seen_.emplace(peer.instance_id, Seen{}).first;
  }

  // A later start of the process: it is judged anew.
  Seen& seen = position->second;
  if (seen.samples == 0 || peer.boot_id > seen.newest.boot_id) {
    const bool said_duplicate = seen.said_duplicate;
    seen = Seen{};
    seen.said_duplicate = said_duplicate;
    seen.first_arrival = now;
  }

  if (duplicate && !seen.said_duplicate) {
    seen.said_duplicate = true;

    findings.push_back(duplicate_instance(peer, peer.instance_id == own_instance_id_ ? nullptr : &seen.newest));
  }

  if (peer.boot_id < seen.newest.boot_id) return findings;

  if (is_twin(peer) && !seen.said_twin) {
    seen.said_twin = true;
    findings.push_back(duplicate_vehicle(peer));
  }

  if (peer.idl_version != own_idl_version_ && !seen.said_version) {
    seen.said_version = true;
    findings.push_back(other_idl_version(peer, own_idl_version_));
  }

  // The first sample may be history that waited for us, so one that is fresh must confirm it.
  const double skew_s = static_cast<double>(peer.wall_clock_ns - wall_clock_ns) * 1e-9;
  const bool is_skewed = seen.samples >= 2 && std::abs(skew_s) > kMostSkewS && std::abs(seen.last_skew_s) > kMostSkewS;

  if (is_skewed && !seen.said_skew) {
    seen.said_skew = true;
    findings.push_back(clock_skew(peer, skew_s));
  }

  seen.last_skew_s = skew_s;
  seen.newest = peer;
  ++seen.samples;

  return findings;
}

}  // namespace aisle::service
