#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

#include "common/geometry/pose.hpp"
#include "common/grid/clearance.hpp"
#include "common/kinematics/vehicle_model.hpp"

namespace aisle::local_planner {

/// At this speed or below, the vehicle counts as standing: touching a person then is not its doing.
inline constexpr double kStandingMps = 0.05;

/// A person or thing at constant velocity, its position the less certain the later. Positions count from the scene's
/// moment.
struct Mover {
  geometry::Point2 position_in_map;
  geometry::Point2 velocity_in_map;
  double radius_m{0.25};
  double margin_m{0.1};
  double growth_mps{0.2};  // of the margin
  bool may_walk{true};     // false: has stood for long
  bool has_walked{false};  // it came from elsewhere, and may set off after all
  double unseen_s{0.0};    // from the measurement of its motion to the scene's moment

  /// How far from its predicted position a person can be `t_s` after the scene's moment, having started, stopped or
  /// turned since the motion was measured; in metres. 0 for what has stood for long.
  double reach_m(double t_s) const;

  /// By how much the margin has grown for the rollout's gaps at `t_s`, in metres: they are a matter of comfort, and
  /// grow no further than this.
  double foreseen_growth_m(double t_s) const {
    constexpr double kGrowsForS = 1.0;
    return growth_mps * std::min(t_s, kGrowsForS);
  }
};

/// Another vehicle: where it can come while it brakes.
struct PeerMotion {
  double radius_m{0.35};
  std::vector<geometry::Point2> stopping_in_map;
};

struct Tube;

/// One cycle's surroundings, at the moment from which the next command acts.
struct Scene {
  const grid::ClearanceField& clearance;
  geometry::Pose2 base_in_map;
  geometry::Twist2 twist;  // in force then
  double radius_m{0.35};

  kinematics::Limits limits;
  double speed_cap_mps{1.2};
  const std::vector<Mover>& movers;
  const std::vector<PeerMotion>& peers;
  double steering_rad{0.0};  // of a tricycle, in force then

  /// The footprint's discs, of radius_m: their centres before the base; at most kMostDiscs.
  std::vector<double> discs_ahead_m{0.0};

  const Tube* tube{nullptr};  // that the vehicle keeps to; none: all the free floor
};

inline constexpr std::size_t kMostDiscs = 5;
using DiscGaps = std::array<double, kMostDiscs>;  // one a disc of the footprint, in metres

}  // namespace aisle::local_planner
