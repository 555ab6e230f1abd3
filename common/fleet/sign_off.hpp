#pragma once

#include <string>

namespace aisle::fleet {

/// A person says that the vehicle stands where it was heard last, or is gone: nobody waits for its word any more. Ends
/// when the vehicle is heard again.
struct SignOff {
  std::string agv_id;
};

}  // namespace aisle::fleet
