#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "tools/sim/fault_plan.hpp"

namespace aisle::sim {

/// One change of the site at one moment.
struct FaultAction {
  enum class Kind {
    kLinksChange,  // links begin or end to be harmed
    kCut,
    kHeal,
    kCrash,
    kStart,
    kHang,
    kGoOn,
    kClockJump,
    kDiskFull,
    kDiskFree,
    kFilesTorn,
    kFilesLost,
    kHold,
    kLetGo,
    kSlow,
    kFast,
    kDeath,
    kSignOff
  };

  double t_s{0.0};
  Kind kind{Kind::kLinksChange};
  std::string process{};  // of a cut: where the messages come from
  std::string to{};       // of a cut
  bool both_ways{false};
  double by_s{0.0};   // of a clock jump
  int fault{0};       // its number in the plan; what ends a fault bears the same number as what began it
  double share{1.0};  // of the top speed, of a vehicle that is slow
};

/// "crash", "cut", ...; how it is counted. Empty for what only ends another fault.
const char* name_of(FaultAction::Kind kind);

/// A plan laid out for one site: which process is hit when. Where a pattern names several processes, one is drawn for
/// each occasion (vehicles are held, and are slow, all that are named); the draw depends on plan, names and seed only.
/// In the order of time; nothing begins at or after the plan's stop_s, and what is still under way then ends there, but
/// that the dead are signed off when they are.
/// @param services names of the processes that may be hit by a pattern
/// @param others further names that may be hit where the plan names them in full, or, as ends of cuts, by a pattern
///   that fits no service
/// @throws config::BadInput for a name or pattern that fits none of them
std::vector<FaultAction> schedule(const FaultPlan& plan, const std::vector<std::string>& services,
                                  const std::vector<std::string>& others, std::uint64_t seed);

/// Seconds of a plan as the network counts time: rounded, so that 2.01 s means the same moment to all.
std::chrono::nanoseconds moment_of(double s);

/// How messages from `from` to `to` are harmed at `t` after the start of the run, all links of the plan together:
/// losses of independent causes, delays one after the other. Moments are those of moment_of(): at the time of an action
/// kLinksChange, what begins then has begun, and what ends then is over.
LinkFault harm_at(const FaultPlan& plan, std::chrono::nanoseconds t, const std::string& from, const std::string& to);

}  // namespace aisle::sim
