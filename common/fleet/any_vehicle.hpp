#pragma once

namespace aisle::fleet {

/// In place of a vehicle's id: whichever vehicle serves the goal soonest. The dispatcher chooses it; no vehicle is
/// called so.
inline constexpr const char* kAnyVehicle = "any";

}  // namespace aisle::fleet
