#include "common/fleet/plan.hpp"

namespace aisle::fleet {

/// For logs and people.
const char* name(PlanOutcome outcome) {
  switch (outcome) {
    case PlanOutcome::kFound:
      return "found";
    case PlanOutcome::kNoPath:
      return "no path";
    case PlanOutcome::kStartBlocked:
      return "start blocked";
    case PlanOutcome::kGoalBlocked:
      return "goal blocked";
    case PlanOutcome::kOutOfMap:
      return "out of map";
    case PlanOutcome::kOutOfTime:
      return "out of time";
    case PlanOutcome::kCancelled:
      return "cancelled";
  }

  return "?";
}

const char* name(PlanTrigger trigger) {
  switch (trigger) {
    case PlanTrigger::kNewGoal:
      return "new goal";
    case PlanTrigger::kMapChanged:
      return "map changed";
    case PlanTrigger::kVehicleBlocked:
      return "vehicle blocked";
    case PlanTrigger::kTakeover:
      return "takeover";
  }

  return "?";
}

}  // namespace aisle::fleet
