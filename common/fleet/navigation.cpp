#include "common/fleet/navigation.hpp"

namespace aisle::fleet {

/// For logs and people; the exhaustive switch refuses to compile without a word for a new phase.
const char* name(Phase phase) {
  switch (phase) {
    case Phase::kWaiting:
      return "waiting";
    case Phase::kTurning:
      return "turning";
    case Phase::kDriving:
      return "driving";
    case Phase::kAvoiding:
      return "avoiding";
    case Phase::kBlocked:
      return "blocked";
    case Phase::kArrived:
      return "arrived";
    case Phase::kFailed:
      return "failed";
    case Phase::kHeld:
      return "held";
  }

  return "?";
}

const char* name(Reason reason) {
  switch (reason) {
    case Reason::kNone:
      return "none";
    case Reason::kNoGoal:
      return "no goal";
    case Reason::kNoMap:
      return "no map";
    case Reason::kNoPlan:
      return "no plan";
    case Reason::kNoState:
      return "no state";
    case Reason::kNoTracker:
      return "no tracker";
    case Reason::kStaleState:
      return "stale state";
    case Reason::kStaleTracker:
      return "stale tracker";
    case Reason::kPlanOutdated:
      return "plan outdated";
    case Reason::kObstacle:
      return "obstacle";
    case Reason::kVehicle:
      return "vehicle";
    case Reason::kOffPath:
      return "off path";
    case Reason::kUnreachable:
      return "unreachable";
    case Reason::kCancelled:
      return "cancelled";
    case Reason::kLate:
      return "late";
    case Reason::kAuthority:
      return "authority";
    case Reason::kNoGrant:
      return "no grant";
    case Reason::kPerson:
      return "held by a person";
  }

  return "?";
}

}  // namespace aisle::fleet
