#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "services/local-planner/core/critic.hpp"
#include "services/local-planner/core/scene.hpp"

namespace aisle::local_planner {

inline constexpr double kStoodMps = 1e-3;  // below this a braking vehicle is taken to have stopped
inline constexpr double kTinyM = 1e-6;     // a gap may be less than the needed one by this: rounding
inline constexpr int kPathEverySteps = 4;  // of a smooth trajectory that is enough to compare it with the path
inline constexpr double kBesidePersonMps = 0.5 * kStandingMps;  // faster is moving while a person touches the vehicle

/// The dynamic window: how far it looks, how finely, and what it keeps free.
struct DwaSettings {
  double horizon_s{2.0};
  double step_s{0.1};
  // Speeds reachable within this are sampled; commands follow at the control period's pace. The papers' V_d is of one
  // interval (LI eq. 6, QU eq. 7, YU eq. 9, WANG eq. 8): this longer reach is ours, and as printed there is none.
  double window_s{0.3};
  double heading_s{0.8};  // the heading critics look at the trajectory here
  int linear_samples{7};
  int angular_samples{17};
  double linear_step_mps{0.0};     // between sampled speeds; 0: by linear_samples
  double angular_step_radps{0.0};  // between sampled turn rates; 0: by angular_samples
  double wall_margin_m{0.04};
  double peer_margin_m{0.08};
  double braking_share{0.9};  // of the deceleration limit, where stopping is promised
  double change_worth{0.01};  // another speed than the one in force must earn so much more, of a sample's mean score

  /// Steps of a trajectory, and the step at which the heading critics look.
  int steps() const;
  int look_step() const;

  /// Walls count up to this step.
  int last_wall_step(const Aim& aim) const;
};

/// The gaps that a scene's samples must keep: the margins, or what there is now where that is less, so that what is too
/// near already forbids only coming nearer. Made once a cycle; holds only what the vehicle can come near to, and points
/// into the scene.
struct Needed {
  double wall{0.0};                                         // metres
  DiscGaps wall_gaps_m{};                                   // now
  std::vector<std::pair<const PeerMotion*, double>> peers;  // while braking, with their gaps in metres
  std::vector<std::pair<const Mover*, double>> movers;
  std::vector<const Mover*> foreseen;  // within the horizon
  bool is_person_beside{false};        // a person walks right beside the vehicle
};

/// Made at the begin of a cycle.
Needed needed_gaps(const Scene& scene, const DwaSettings& settings);

/// From each of the vehicle's discs, where it is now, to the nearest wall, in metres; negative: overlaps.
DiscGaps wall_gaps_m(const Scene& scene);

/// Speed of the vehicle's fastest point, m/s: of its base, or of the farthest disc centre, `swing_m` from it, in a
/// turn.
double fastest_point_mps(const geometry::Twist2& twist, double swing_m);

/// When a sample that slows down from `was_mps` to `speed_mps` within a step of `dt_s` falls below kStandingMps: so
/// long before the end of the step.
double standing_since_s(double was_mps, double speed_mps, double dt_s);

/// What stops a vehicle that takes up `wanted` for one step and then brakes along its arc: nothing, or what it would
/// touch before it stands. Walls and peers: anywhere on that arc, also of the peer's own braking; movers: at the same
/// time, while the vehicle is faster than kStandingMps, wherever a person can have come by then (passive safety,
/// Mitsch, Ghorbal and Platzer 2013: it stands before anybody can touch it).
Obstruction obstruction(const Scene& scene, const geometry::Twist2& wanted, const DwaSettings& settings);

/// The window's two steps for blocks of samples; plain_window.hpp has them as plain loops, to the same bit.
namespace batched {

/// What `obstruction` says of each sample, in their order.
std::vector<Obstruction> obstructions(const Scene& scene, const Needed& needed,
                                      const std::vector<geometry::Twist2>& wanted, const DwaSettings& settings);

/// From the twist in force towards each of `wanted`, then on with it, to the horizon. In the order of `wanted`, in
/// blocks of kBlock; what moves and collides with a wall ends there.
std::vector<SampleBlock> roll_out(const Scene& scene, const Needed& needed, const std::vector<geometry::Twist2>& wanted,
                                  const Aim& aim, const DwaSettings& settings);

}  // namespace batched
}  // namespace aisle::local_planner
