#pragma once
#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include "common/geometry/pose.hpp"
#include "common/grid/clearance.hpp"
#include "common/kinematics/vehicle_model.hpp"
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

struct DwaSettings {
  double horizon_s{2.0};
  double step_s{0.1};
  double window_s{0.3};   // speeds reachable within this are sampled; commands follow at the control period's pace
  double heading_s{0.8};  // C1 looks at the trajectory here
  int linear_samples{7};
  int angular_samples{17};
  double wall_margin_m{0.04};
  double peer_margin_m{0.08};
  double braking_share{0.9};  // of the deceleration limit, where stopping is promised
  double change_worth{
      0.01};  // of what a sample earns on the mean: so much more must another speed than the one in force earn
};

/// A person or thing at constant velocity, its place the less certain the later. Positions count from the scene's
/// moment.
struct Mover {
  geometry::Point2 position_in_map;
  geometry::Point2 velocity_in_map;
  double radius_m{0.25};
  double margin_m{0.1};
  double growth_mps{0.2};
  bool may_walk{true};     // false: has stood for long
  bool has_walked{false};  // it came from elsewhere, and may set off after all
  double unseen_s{0.0};    // how long before the scene's moment its motion was measured

  /// How far from where its velocity takes it a person can be `t_s` after the scene's moment, who has started, stopped
  /// or turned since the motion was measured; in metres. 0 for what has stood for long.
  double reach_m(double t_s) const;
};

/// Another vehicle: where it can come while it brakes, and where it says it will be at each step.
struct PeerMotion {
  double radius_m{0.35};
  std::vector<geometry::Point2> stopping_in_map;
  std::vector<geometry::Point2> intended_in_map;
};

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
  std::vector<double> discs_ahead_m{
      0.0};  // the footprint's discs of radius_m: their centres before the base; at most kMostDiscs
};
inline constexpr std::size_t kMostDiscs = 5;
using DiscGaps = std::array<double, kMostDiscs>;  // one a disc of the footprint

/// What stops a vehicle that takes up `wanted` for one step and then brakes along its arc: nothing, or what it would
/// touch before it stands. Walls and peers: anywhere on that arc, also of the peer's own braking; movers: at the same
/// time, while the vehicle is faster than 0.05 m/s, wherever a person can have come by then (passive safety, Mitsch,
/// Ghorbal and Platzer 2013: it stands before anybody can touch it). What is too near already forbids only coming
/// nearer.
Obstruction obstruction(const Scene& scene, const geometry::Twist2& wanted, const DwaSettings& settings);

/// The gaps that a scene asks for: the margins, or what there is now where that is less. Made once a cycle; holds only
/// what the vehicle can come near to, and points into the scene.
struct Needed {
  double wall{0.0};
  DiscGaps wall_gaps_m{};  // now
  std::vector<std::pair<const PeerMotion*, double>> peers;
  std::vector<std::pair<const Mover*, double>> movers;
  std::vector<const Mover*> foreseen;  // within the horizon
  std::vector<const PeerMotion*> met;
  bool somebody_touches{false};
};
Needed needed_gaps(const Scene& scene, const DwaSettings& settings);

/// From each of the vehicle's discs, where it is now, to the nearest wall, in metres; negative: overlaps.
DiscGaps wall_gaps_m(const Scene& scene);

/// The same of many samples at once, in their order.
std::vector<Obstruction> obstructions(const Scene& scene, const Needed& needed,
                                      const std::vector<geometry::Twist2>& wanted, const DwaSettings& settings);

/// From the twist in force towards each of `wanted`, then on with it, to the horizon. In the order of `wanted`; what
/// moves and collides with a wall ends there.
std::vector<Samples> roll_out(const Scene& scene, const Needed& needed, const std::vector<geometry::Twist2>& wanted,
                              const Aim& aim, const DwaSettings& settings);

}  // namespace aisle::local_planner
