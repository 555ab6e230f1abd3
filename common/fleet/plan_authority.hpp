#pragma once

#include <cstdint>

namespace aisle::fleet {

/// May a plan be followed?
enum class PlanVerdict {
  kAccepted,
  kOldEpoch,     // of a planner that was replaced
  kOldSequence,  // overtaken by a later plan of the same planner
};

/// One word for logs and counters.
const char* name(PlanVerdict verdict);

/// Whose plans a vehicle follows: those of the newest planner epoch heard, for whichever vehicle a plan
/// was, and those of one planner in its order. A plan that is already followed stays when a newer epoch
/// is heard: the planner that took over confirms it or replaces it.
class PlanAuthority {
 public:
  /// A plan for another vehicle was heard.
  void hear(std::uint32_t epoch);

  /// A plan for this vehicle: may it be followed?
  PlanVerdict judge(std::uint32_t epoch, std::uint64_t boot_id, std::uint64_t sequence_number);

  /// The newest heard; 0: none.
  std::uint32_t epoch() const { return epoch_; }

 private:
  std::uint32_t epoch_{0};
  std::uint64_t boot_id_{0};
  std::uint64_t sequence_number_{0};
};

}  // namespace aisle::fleet
