#include "services/fake-vehicle/core/command_authority.hpp"

#include <cmath>
#include <utility>

namespace aisle::fake_vehicle {
namespace {

constexpr double kBeyondReason = 100.0;  // m/s, rad/s

bool is_sane(const geometry::Twist2& twist) {
  const auto is_near_zero = [](double speed) { return std::abs(speed) <= kBeyondReason; };  // false for NaN
  return is_near_zero(twist.linear_mps) && is_near_zero(twist.angular_radps) && is_near_zero(twist.sideways_mps);
}

}  // namespace

const char* name(Verdict verdict) {
  switch (verdict) {
    case Verdict::kAccepted:
      return "accepted";
    case Verdict::kForeignVehicle:
      return "foreign_vehicle";
    case Verdict::kMalformed:
      return "malformed";
    case Verdict::kOldEpoch:
      return "old_epoch";
    case Verdict::kForeignSource:
      return "foreign_source";
    case Verdict::kOldSequence:
      return "old_sequence";
  }
  return "unknown";
}

CommandAuthority::CommandAuthority(std::string agv_id, std::uint32_t accepted_epoch)
    : agv_id_(std::move(agv_id)), epoch_(accepted_epoch) {}

Verdict CommandAuthority::judge(const Command& command) {
  const Verdict verdict = look_at(command);
  if (verdict != Verdict::kAccepted) {
    ++refused_;
    return verdict;
  }
  epoch_ = command.epoch;
  source_id_ = command.source_id;
  boot_id_ = command.boot_id;
  sequence_number_ = command.sequence_number;
  return verdict;
}

Verdict CommandAuthority::look_at(const Command& command) const {
  if (command.agv_id != agv_id_) return Verdict::kForeignVehicle;
  if (!is_sane(command.twist)) return Verdict::kMalformed;
  if (command.epoch < epoch_) return Verdict::kOldEpoch;
  if (command.epoch > epoch_ || source_id_.empty()) return Verdict::kAccepted;
  if (command.source_id != source_id_ || command.boot_id != boot_id_) return Verdict::kForeignSource;
  return command.sequence_number > sequence_number_ ? Verdict::kAccepted : Verdict::kOldSequence;
}

}  // namespace aisle::fake_vehicle
