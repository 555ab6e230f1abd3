#pragma once
// Samples to and from the tracker's own types. What is decoded is safe to compute with.
#include <cstdint>

#include "common/wire/checks.hpp"
#include "idl/tracking.hpp"
#include "idl/vehicle.hpp"
#include "services/obstacle-tracker/core/coverage.hpp"
#include "services/obstacle-tracker/core/scan.hpp"
#include "services/obstacle-tracker/core/track.hpp"

namespace aisle::obstacle_tracker {

/// Id and body; pose, twist and stamp are left as they are by default.
wire::Decoded<KnownVehicle> decode(const aisle::VehicleInfo& sample);

/// What a vehicle says of its motion.
struct Motion {
  geometry::Pose2 base_in_map;
  geometry::Twist2 twist;
};
wire::Decoded<Motion> decode(const aisle::VehicleState& sample);

/// `stamp` is left to the caller. Only the id is checked here: find_fault() knows the rest, by reason.
wire::Decoded<Scan> decode(const aisle::Scan& sample);

/// `by` and `scan_stamp_ns` are left to the writer.
aisle::Track encode(const Track& track);

/// `source_id`, `by` and `map_id` are left to the writer.
aisle::Coverage encode(const CoverageTile& tile);

}  // namespace aisle::obstacle_tracker
