#pragma once

#include <cmath>

#include "common/geometry/footprint.hpp"
#include "services/local-planner/core/inputs.hpp"
#include "services/local-planner/core/room.hpp"
#include "services/local-planner/core/scene.hpp"
#include "services/local-planner/core/surroundings.hpp"

namespace aisle::local_planner {

inline constexpr double kSpeedRoundingMps = 1e-6;                      // of a speed that was commanded and measured
inline constexpr double kCreepMps = kStandingMps - kSpeedRoundingMps;  // does not count as moving, and still gets on

/// The own vehicle's motion at the two moments that a cycle needs: `now`, and `then`, dead_time_s later, when the
/// command of this cycle acts.
struct OwnMotion {
  geometry::Pose2 base_now;  // in map
  geometry::Pose2 base_then;
  double measured_mps{0.0};  // along its heading

  /// Slower than any speed that it would be told to drive.
  bool stands() const { return std::abs(measured_mps) < kCreepMps - kSpeedRoundingMps; }
};

/// What one cycle begins with, and does not change. Refers to the caller's inputs.
struct Moment {
  const Inputs& inputs;
  const Vehicle& vehicle;
  geometry::CoveringDiscs discs;  // of the vehicle's footprint
  OwnMotion motion;
  time::Stamp now;

  /// Where the vehicle is now.
  geometry::Point2 here() const { return motion.base_now.position(); }

  /// Radius to be kept from walls along the way: the whole vehicle's where it may turn anywhere; half the width of a
  /// tricycle, whose plan knows headings.
  double way_radius_m() const { return vehicle.turns_on_the_spot() ? vehicle.reach_m() : discs.radius_m; }

  /// Where the way may lead, among the walls and what stands. @pre inputs.clearance
  Room room(const Surroundings& around, double wall_margin_m, double disc_margin_m) const {
    return {*inputs.clearance, around.standing_discs, way_radius_m(), wall_margin_m, disc_margin_m};
  }

  /// Metres between the outlines of the vehicle and a mover, when the next command acts; negative: they overlap.
  double gap_then_m(const Mover& mover) const;
};

}  // namespace aisle::local_planner
