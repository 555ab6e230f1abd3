#pragma once

// Samples of idl/tracking.idl to and from the values of common/fleet. Encoders leave `by` to the writer.

#include "common/fleet/coverage.hpp"
#include "common/fleet/track.hpp"
#include "common/wire/checks.hpp"
#include "common/wire/extras.hpp"
#include "idl/tracking.hpp"

namespace aisle::wire {

aisle::Track encode(const fleet::Track& track);
Decoded<fleet::Track> decode(const aisle::Track& sample);

/// @pre at most 256 scans and 1024 tracks
aisle::TrackingStatus encode(const fleet::TrackingStatus& status);
Decoded<fleet::TrackingStatus> decode(const aisle::TrackingStatus& sample);

aisle::Coverage encode(const fleet::CoverageTile& tile);
Decoded<fleet::CoverageTile> decode(const aisle::Coverage& sample);
/// A picture of the tile, and counts of its cells.
Extras extras_of(const aisle::Coverage& sample);

}  // namespace aisle::wire
