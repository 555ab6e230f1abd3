#include "common/fleet/command_authority.hpp"

#include <cmath>
#include <utility>

namespace aisle::fleet {
namespace {

constexpr double kBeyondReason = 100.0;  // m/s, rad/s

/// Finite, and not faster than any vehicle.
bool is_sane(const geometry::Twist2& twist) {
  const auto is_near_zero = [](double speed) { return std::abs(speed) <= kBeyondReason; };  // false for NaN
  return is_near_zero(twist.linear_mps) && is_near_zero(twist.angular_radps) && is_near_zero(twist.sideways_mps);
}

}  // namespace

const char* name(CommandVerdict verdict) {
  switch (verdict) {
    case CommandVerdict::kAccepted:
      return "accepted";
    case CommandVerdict::kForeignVehicle:
      return "foreign_vehicle";
    case CommandVerdict::kMalformed:
      return "malformed";
    case CommandVerdict::kOldEpoch:
      return "old_epoch";
    case CommandVerdict::kForeignSource:
      return "foreign_source";
    case CommandVerdict::kOldSequence:
      return "old_sequence";
  }

  return "unknown";
}

CommandAuthority::CommandAuthority(std::string agv_id, std::uint32_t accepted_epoch)
    : agv_id_(std::move(agv_id)), epoch_(accepted_epoch) {}

/// Only an accepted command changes what is accepted next.
CommandVerdict CommandAuthority::judge(const VelocityCommand& command, const Origin& by) {
  const CommandVerdict verdict = look_at(command, by);
  if (verdict != CommandVerdict::kAccepted) {
    ++refused_;
    return verdict;
  }

  epoch_ = by.epoch;
  source_id_ = by.source_id;
  boot_id_ = by.boot_id;
  sequence_number_ = by.sequence_number;

  return verdict;
}

CommandVerdict CommandAuthority::refuse_unread() {
  ++refused_;
  return CommandVerdict::kMalformed;
}

/// The checks in order of how much they say: first the form, then the epoch, then source and number
/// within it.
CommandVerdict CommandAuthority::look_at(const VelocityCommand& command, const Origin& by) const {
  if (command.agv_id != agv_id_) return CommandVerdict::kForeignVehicle;
  if (!is_sane(command.twist)) return CommandVerdict::kMalformed;
  if (by.source_id.empty() || by.sequence_number == 0) return CommandVerdict::kMalformed;
  if (by.epoch < epoch_) return CommandVerdict::kOldEpoch;
  if (by.epoch > epoch_ || source_id_.empty()) return CommandVerdict::kAccepted;
  if (by.source_id != source_id_ || by.boot_id != boot_id_) return CommandVerdict::kForeignSource;

  return by.sequence_number > sequence_number_ ? CommandVerdict::kAccepted : CommandVerdict::kOldSequence;
}

}  // namespace aisle::fleet
