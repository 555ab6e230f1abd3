#include "common/fleet/vehicle_state.hpp"

namespace aisle::fleet {

const char* name(Hold hold) {
  switch (hold) {
    case Hold::kNone:
      return "none";
    case Hold::kNoCommand:
      return "no_command";
    case Hold::kLateCommand:
      return "late_command";
    case Hold::kContact:
      return "contact";
    case Hold::kDuplicateId:
      return "duplicate_id";
    case Hold::kPerson:
      return "person";
  }

  return "unknown";
}

}  // namespace aisle::fleet
