#pragma once

// Shapes of idl/geometry.idl to and from our own. Decoders check into `Checks` and return a value that is safe to
// compute with.

#include "common/geometry/pose.hpp"
#include "common/wire/checks.hpp"
#include "idl/geometry.hpp"

namespace aisle::wire {

/// Bounds of what decoders accept.
inline constexpr double kFarthestM = 1.0e6;  // no site is larger; beyond, centimetres get lost in sums of squares
inline constexpr double kFastestMps = 100.0;
inline constexpr double kFastestTurnRadps = 100.0;

inline aisle::Point encode(const geometry::Point2& point) {
  aisle::Point sample;
  sample.x_m(point.x);
  sample.y_m(point.y);
  return sample;
}

/// The heading is wrapped into (-pi, pi].
inline aisle::Pose encode(const geometry::Pose2& pose) {
  aisle::Pose sample;
  sample.x_m(pose.x);
  sample.y_m(pose.y);
  sample.yaw_rad(geometry::wrap(pose.yaw));

  return sample;
}

inline aisle::Twist encode(const geometry::Twist2& twist) {
  aisle::Twist sample;
  sample.linear_mps(twist.linear_mps);
  sample.angular_radps(twist.angular_radps);
  sample.sideways_mps(twist.sideways_mps);

  return sample;
}

/// Metres, each within kFarthestM.
inline geometry::Point2 decode(const aisle::Point& sample, Checks& checks, const char* field = "point") {
  checks.within(field, sample.x_m(), -kFarthestM, kFarthestM).within(field, sample.y_m(), -kFarthestM, kFarthestM);
  return {sample.x_m(), sample.y_m()};
}

/// Accepts a heading up to a turn beyond (-pi, pi] and wraps it.
inline geometry::Pose2 decode(const aisle::Pose& sample, Checks& checks, const char* field = "pose") {
  checks.within(field, sample.x_m(), -kFarthestM, kFarthestM)
      .within(field, sample.y_m(), -kFarthestM, kFarthestM)
      .within(field, sample.yaw_rad(), -3.0 * geometry::kPi, 3.0 * geometry::kPi);
  return {sample.x_m(), sample.y_m(), geometry::wrap(sample.yaw_rad())};
}

/// Each component within the fastest above.
inline geometry::Twist2 decode(const aisle::Twist& sample, Checks& checks, const char* field = "twist") {
  checks.within(field, sample.linear_mps(), -kFastestMps, kFastestMps)
      .within(field, sample.angular_radps(), -kFastestTurnRadps, kFastestTurnRadps)
      .within(field, sample.sideways_mps(), -kFastestMps, kFastestMps);
  return {sample.linear_mps(), sample.angular_radps(), sample.sideways_mps()};
}

}  // namespace aisle::wire
