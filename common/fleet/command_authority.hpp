#pragma once

#include <cstdint>
#include <string>

#include "common/fleet/origin.hpp"
#include "common/fleet/velocity_command.hpp"

namespace aisle::fleet {

/// May a velocity command be followed?
enum class CommandVerdict {
  kAccepted,
  kForeignVehicle,  // addressed to another agv id
  kMalformed,       // not finite, beyond all reason, without a source or a sequence number
  kOldEpoch,        // of a source that was replaced
  kForeignSource,   // the epoch is held by another source, or another boot of it
  kOldSequence,     // already used, or overtaken
};

/// One word for logs and counters.
const char* name(CommandVerdict verdict);

/// Which source drives a vehicle. A lease with an epoch: authority is not left to the middleware.
///
/// A command is accepted when it has the vehicle's own id, finite values, a source id, an epoch that is
/// at least the accepted one, and a sequence number (counted from 1) that was not used before. A higher
/// epoch takes over, from every source; within an epoch only its first source and boot is heard.
class CommandAuthority {
 public:
  /// `accepted_epoch`: the last accepted one before a restart of the vehicle, 0 at first.
  CommandAuthority(std::string agv_id, std::uint32_t accepted_epoch);

  /// Accepts the command, and with it its source and epoch, or counts it as refused.
  CommandVerdict judge(const VelocityCommand& command, const Origin& by);

  /// A command for this vehicle that could not be read at all: kMalformed, and counted as refused.
  CommandVerdict refuse_unread();

  /// Of the last command accepted; to be kept over a restart.
  std::uint32_t accepted_epoch() const { return epoch_; }
  std::uint64_t refused() const { return refused_; }

 private:
  /// The verdict alone, without taking over anything.
  CommandVerdict look_at(const VelocityCommand& command, const Origin& by) const;

  std::string agv_id_;
  std::uint32_t epoch_;
  std::string source_id_;  // empty: nobody holds the epoch yet
  std::uint64_t boot_id_{0};
  std::uint64_t sequence_number_{0};
  std::uint64_t refused_{0};
};

}  // namespace aisle::fleet
