#pragma once
#include <array>
#include <cstddef>

#include "common/grid/clearance_lanes.hpp"
#include "services/local-planner/core/rollout.hpp"

namespace aisle::local_planner {

/// So many samples are rolled out side by side, in arrays that compilers make vectors of.
inline constexpr std::size_t kLanes = grid::kClearanceLanes;
using Lane = std::array<double, kLanes>;

/// By value, which loops over lanes need to become vectors; std::min takes references.
inline double least(double a, double b) { return b < a ? b : a; }
inline double most(double a, double b) { return a < b ? b : a; }

/// Length of the velocity of the base, m/s.
double speed_of(const geometry::Twist2& twist);
/// Farthest centre of a disc from the base: what a turn swings.
double swing_m(const Scene& scene);

/// Poses with their headings as unit vectors, each stepping along an arc of its own. Stepping them costs no call of libm.
struct Lanes {
  alignas(32) Lane x, y;                    // in map
  alignas(32) Lane cos_yaw, sin_yaw;
  alignas(32) Lane cos_half, sin_half;      // of half a step's turn
  alignas(32) Lane ahead_m, left_m;         // the step's chord, in the direction of half its turn

  explicit Lanes(const geometry::Pose2& base_in_map);
  /// The twists of the steps from now on.
  void set_steps(const Lane& linear_mps, const Lane& angular_radps, const Lane& sideways_mps, double dt_s);
  void step();
  geometry::Pose2 pose(std::size_t i) const;

 private:
  void step_sideways();
  bool goes_sideways_{false};
};

/// A rectangle that holds all lanes' bases.
struct Box {
  geometry::Point2 low, high;
  explicit Box(const Lanes& lanes);
  /// Squared metres from a point to the box; 0 inside.
  double distance2(geometry::Point2 p) const;
};

/// The centres of the footprint's discs of each lane; a vehicle that is a disc has one, in its base.
class Outlines {
 public:
  explicit Outlines(const Scene& scene);
  /// @pre `lanes` lives as long
  void follow(const Lanes& lanes);
  /// Squared, from each lane's nearest centre.
  void distances2_to(geometry::Point2 p, Lane& squared) const;
  std::size_t count() const { return count_; }
  double radius_m() const { return scene_.radius_m; }
  double cell_m() const { return scene_.clearance.geometry().resolution_m; }
  /// From one disc's centre to the nearest wall.
  double clearance_m(std::size_t disc, std::size_t lane) const { return scene_.clearance.clearance_m(geometry::Point2{x_[disc][lane], y_[disc][lane]}); }
  void clearances_m(std::size_t disc, Lane& found_m) const { grid::clearances_m(scene_.clearance, x_[disc], y_[disc], found_m); }
  /// The same of 32 pairs of a disc and a lane: `disc * kLanes + lane`.
  void clearances_of_pairs_m(const std::size_t* pairs, Lane& found_m) const;

 private:
  const Scene& scene_;
  bool is_disc_;
  std::size_t count_;
  std::array<Lane, kMostDiscs> off_x_, off_y_;      // where the centres are not the bases
  std::array<const double*, kMostDiscs> x_, y_;
};

/// Looks up distances to walls along trajectories; where there was plenty a moment ago it does not look again: the distance shrinks by
/// at most what was driven. Of several discs only those are looked up that can be too near.
class WallWatch {
 public:
  explicit WallWatch(double enough_m);
  /// One step on. Returns whether some gap is less than `enough_m`.
  bool look(const Outlines& outlines, const Lane& driven_m);
  /// Of the vehicles' outlines; at least `enough_m` where there is as much.
  const Lane& gaps_m() const { return known_m_; }
  /// Nobody asks for this lane's gap any more.
  void leave(std::size_t lane);

 private:
  bool look_at_disc(const Outlines& outlines, int unknown);
  bool look_at_discs(const Outlines& outlines);

  double enough_m_;
  Lane known_m_;
  std::array<Lane, kMostDiscs> bound_m_;    // of the clearance of each disc's centre
};

}  // namespace aisle::local_planner
