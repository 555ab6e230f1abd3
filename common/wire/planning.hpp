#pragma once

// Samples of idl/planning.idl to and from the values of common/fleet. Encoders leave `by` to the writer.

#include "common/fleet/goal.hpp"
#include "common/fleet/navigation.hpp"
#include "common/fleet/plan.hpp"
#include "common/wire/checks.hpp"
#include "idl/planning.hpp"

namespace aisle::wire {

aisle::Goal encode(const fleet::Goal& goal);
Decoded<fleet::Goal> decode(const aisle::Goal& sample);

/// @pre at most 4096 waypoints and 4096 steps
aisle::Plan encode(const fleet::Plan& plan);
Decoded<fleet::Plan> decode(const aisle::Plan& sample);

/// Of a longer intent only the first 64 points are written.
/// @pre at most 32 held poses: one that is left out would be floor that its vehicle may still drive
aisle::NavigationStatus encode(const fleet::NavigationStatus& status);
Decoded<fleet::NavigationStatus> decode(const aisle::NavigationStatus& sample);

}  // namespace aisle::wire
