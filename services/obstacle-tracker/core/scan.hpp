#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/fleet/scan.hpp"
#include "common/geometry/pose.hpp"
#include "common/time/stamp.hpp"

namespace aisle::obstacle_tracker {

/// A scan with the moment of its first ray on the tracker's clock (see ScanClock).
struct Scan : fleet::Scan {
  time::Stamp stamp{};
};

/// A vehicle of the fleet: hits on its outline are no obstacle. A disc, or a rectangle in its own frame.
struct KnownVehicle {
  std::string agv_id;
  bool is_rectangle{false};
  double radius_m{0.5};  // of the disc, or of the circle around the rectangle
  double length_m{0.0};
  double width_m{0.0};

  geometry::Pose2 base_in_map;
  geometry::Twist2 twist;
  time::Stamp stamp{};  // of pose and twist, on the tracker's clock
  double ahead_m{0.0};  // of the rectangle's middle before the vehicle's frame
};

/// Why a scan was not used.
enum class DropReason {
  kUnknownVehicle,  // no vehicle_info of it has come
  kNoMap,
  kNotFinite,  // pose, twist, angles or a range is not a number
  kNegativeRange,
  kWrongCount,   // no rays, more than fit a full turn, or not as many as this vehicle's scans have
  kBadGeometry,  // angle step, sweep or range limits make no sense
  kNotNewer,     // not newer than the newest of this vehicle
  kFuture,       // stamped later than it can be
  kTooOld,       // measured more than a second ago
};

inline constexpr int kDropReasons = 9;

/// As it is named in counters: "unknown_vehicle", "no_map", ...
const char* name_of(DropReason reason);

/// In words, for the log: "a pose, angle or range is not a number".
const char* explain(DropReason reason);

/// Checks what one scan says by itself: finite numbers, sensible geometry, ranges that are not negative. std::nullopt:
/// usable. Pose and twist in map and in the vehicle's frame, as in fleet::Scan.
std::optional<DropReason> find_fault(const Scan& scan);

/// True when the rays go all around, so that the last ray neighbours the first.
bool is_full_turn(const Scan& scan);

}  // namespace aisle::obstacle_tracker
