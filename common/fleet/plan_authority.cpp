#include "common/fleet/plan_authority.hpp"

#include <algorithm>

namespace aisle::fleet {

const char* name(PlanVerdict verdict) {
  switch (verdict) {
    case PlanVerdict::kAccepted:
      return "accepted";
    case PlanVerdict::kOldEpoch:
      return "old_epoch";
    case PlanVerdict::kOldSequence:
      return "old_sequence";
  }

  return "unknown";
}

void PlanAuthority::hear(std::uint32_t epoch) { epoch_ = std::max(epoch_, epoch); }

/// A higher epoch is always followed; within an epoch, and one start of its planner, numbers must not
/// fall.
PlanVerdict PlanAuthority::judge(std::uint32_t epoch, std::uint64_t boot_id, std::uint64_t sequence_number) {
  if (epoch < epoch_) return PlanVerdict::kOldEpoch;

  // The same sample may come again, e.g. when the link to its writer was lost for a while.
  if (epoch == epoch_ && boot_id == boot_id_ && sequence_number < sequence_number_) return PlanVerdict::kOldSequence;

  epoch_ = epoch;
  boot_id_ = boot_id;
  sequence_number_ = sequence_number;

  return PlanVerdict::kAccepted;
}

}  // namespace aisle::fleet
