#include "services/obstacle-tracker/core/scan.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::obstacle_tracker {
namespace {

// Bounds beyond which a scan makes no sense, whatever the site.
constexpr double kMaxRangeM = 1000.0;
constexpr double kMaxSweepS = 1.0;
constexpr double kMaxCoordinateM = 1e6;
constexpr double kMaxPositionSigmaM = 1.0;
constexpr double kMaxYawSigmaRad = 0.5;

bool is_finite(const geometry::Twist2& t) {
  return std::isfinite(t.linear_mps) && std::isfinite(t.angular_radps) && std::isfinite(t.sideways_mps);
}

}  // namespace

const char* name_of(DropReason reason) {
  switch (reason) {
    case DropReason::kUnknownVehicle:
      return "unknown_vehicle";
    case DropReason::kNoMap:
      return "no_map";
    case DropReason::kNotFinite:
      return "not_finite";
    case DropReason::kNegativeRange:
      return "negative_range";
    case DropReason::kWrongCount:
      return "wrong_count";
    case DropReason::kBadGeometry:
      return "bad_geometry";
    case DropReason::kNotNewer:
      return "not_newer";
    case DropReason::kFuture:
      return "from_future";
    case DropReason::kTooOld:
      return "too_old";
  }

  return "unknown";
}

const char* explain(DropReason reason) {
  switch (reason) {
    case DropReason::kUnknownVehicle:
      return "no vehicle_info of it has come yet";
    case DropReason::kNoMap:
      return "no whole map has come yet";
    case DropReason::kNotFinite:
      return "a pose, twist, angle or range is not a number";
    case DropReason::kNegativeRange:
      return "a range is negative";
    case DropReason::kWrongCount:
      return "no rays, more than a full turn, or not as many as its scans have";
    case DropReason::kBadGeometry:
      return "angle step, sweep, range limits, pose or its sigma make no sense";
    case DropReason::kNotNewer:
      return "its stamp is not newer than that of the scan before";
    case DropReason::kFuture:
      return "its stamp is ahead of that vehicle's clock so far";
    case DropReason::kTooOld:
      return "it was measured more than a second ago";
  }

  return "unknown reason";
}

std::optional<DropReason> find_fault(const Scan& scan) {
  // Numbers that are none.
  if (!geometry::is_finite(scan.base_in_map) || !is_finite(scan.twist) || !std::isfinite(scan.position_sigma_m) ||
      !std::isfinite(scan.yaw_sigma_rad) || !std::isfinite(scan.first_angle_rad) ||
      !std::isfinite(scan.angle_step_rad) || !std::isfinite(scan.sweep_s) || !std::isfinite(scan.range_min_m) ||
      !std::isfinite(scan.range_max_m)) {
    return DropReason::kNotFinite;
  }

  // Numbers that make no sense.
  if (scan.angle_step_rad <= 0.0 || scan.sweep_s < 0.0 || scan.sweep_s > kMaxSweepS || scan.range_min_m < 0.0 ||
      scan.range_max_m <= scan.range_min_m || scan.range_max_m > kMaxRangeM ||
      std::abs(scan.base_in_map.x) > kMaxCoordinateM || std::abs(scan.base_in_map.y) > kMaxCoordinateM ||
      std::abs(scan.first_angle_rad) > 4.0 * geometry::kPi) {
    return DropReason::kBadGeometry;
  }

  if (scan.position_sigma_m < 0.0 || scan.position_sigma_m > kMaxPositionSigmaM || scan.yaw_sigma_rad < 0.0 ||
      scan.yaw_sigma_rad > kMaxYawSigmaRad) {
    return DropReason::kBadGeometry;
  }

  // The rays: as many as fit a full turn, and a range of each. A range of infinity is a ray without a hit.
  const double turn_rad = scan.angle_step_rad * static_cast<double>(scan.ranges_m.size());
  if (scan.ranges_m.empty() || turn_rad > 2.0 * geometry::kPi + 1.5 * scan.angle_step_rad)
    return DropReason::kWrongCount;

  if (std::any_of(scan.ranges_m.begin(), scan.ranges_m.end(), [](float r) { return std::isnan(r); }))
    return DropReason::kNotFinite;

  if (std::any_of(scan.ranges_m.begin(), scan.ranges_m.end(), [](float r) { return r < 0.0F; }))
    return DropReason::kNegativeRange;

  return std::nullopt;
}

bool is_full_turn(const Scan& scan) {
  return scan.angle_step_rad * (static_cast<double>(scan.ranges_m.size()) + 0.5) > 2.0 * geometry::kPi;
}

}  // namespace aisle::obstacle_tracker
