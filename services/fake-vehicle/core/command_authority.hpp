#pragma once
#include <cstdint>
#include <string>

#include "common/geometry/pose.hpp"

namespace aisle::fake_vehicle {

/// A velocity command as it came, not yet believed.
struct Command {
  std::string agv_id;
  std::string source_id;
  std::uint64_t boot_id{0};
  std::uint32_t epoch{0};
  std::uint64_t sequence_number{0};
  std::int64_t stamp_ns{0};
  std::uint64_t plan_id{0};
  geometry::Twist2 twist;
};

enum class Verdict {
  kAccepted,
  kForeignVehicle,  // addressed to another agv id
  kMalformed,       // not finite, or beyond all reason
  kOldEpoch,        // of a source that was replaced
  kForeignSource,   // the epoch is held by another source, or another boot of it
  kOldSequence,     // already used, or overtaken
};

/// One word for logs and counters.
const char* name(Verdict verdict);

/// Who may drive. A command is accepted with the vehicle's own id, finite values, an epoch that is at least the
/// accepted one, and a sequence number used never before. A higher epoch takes over, whoever sends it; within an epoch
/// only its first source and boot is heard (a lease with an epoch: who is heard is not left to the middleware).
class CommandAuthority {
 public:
  /// `accepted_epoch`: of before a restart of the vehicle, 0 at first.
  CommandAuthority(std::string agv_id, std::uint32_t accepted_epoch);

  Verdict judge(const Command& command);

  std::uint32_t accepted_epoch() const { return epoch_; }
  std::uint64_t refused() const { return refused_; }

 private:
  Verdict look_at(const Command& command) const;

  std::string agv_id_;
  std::uint32_t epoch_;
  std::string source_id_;  // empty: nobody holds the epoch yet
  std::uint64_t boot_id_{0};
  std::uint64_t sequence_number_{0};
  std::uint64_t refused_{0};
};

}  // namespace aisle::fake_vehicle
