#pragma once
#include <array>
#include <cstddef>
#include <cstdint>

#include "common/geometry/wide_vectors.hpp"
#include "services/local-planner/core/rollout.hpp"
#include "services/local-planner/core/side_by_side.hpp"

namespace aisle::local_planner {

/// Length of the velocity of the base, m/s.
double speed_of(const geometry::Twist2& twist);
/// Farthest centre of a disc from the base: what a turn swings.
double swing_m(const Scene& scene);

/// Poses with their headings as unit vectors, each stepping along an arc of its own. Stepping them costs no call of
/// libm.
class Lanes {
 public:
  alignas(32) Lane x, y;  // in map

  explicit Lanes(const geometry::Pose2& base_in_map);
  /// The twists of the steps from now on.
  void set_steps(const Lane& linear_mps, const Lane& angular_radps, const Lane& sideways_mps, double dt_s);
  void step();
  void find_yaws_rad(Lane& yaw_rad) const;
  /// Of four lanes, `first` and the next.
  [[gnu::always_inline]] void find_headings(std::size_t first, geometry::Wide& cos_yaw, geometry::Wide& sin_yaw) const {
    geometry::Wide cos_chord, sin_chord, cos_half, sin_half;
    geometry::load(&cos_chord_[first], cos_chord);
    geometry::load(&sin_chord_[first], sin_chord);
    geometry::load(&cos_half_[first], cos_half);
    geometry::load(&sin_half_[first], sin_half);
    cos_yaw = cos_half * cos_chord + sin_half * sin_chord;
    sin_yaw = cos_half * sin_chord - sin_half * cos_chord;
  }

 private:
  void aim_chords();
  void step_sideways();

  alignas(32) Lane cos_chord_,
      sin_chord_;  // the direction of the next step's chord: the heading, and half the step's turn
  alignas(32) Lane cos_half_, sin_half_;  // of half a step's turn
  alignas(32) Lane cos_turn_, sin_turn_;  // of all of it
  alignas(32) Lane ahead_m_, left_m_;     // the chord
  bool goes_sideways_{false};
};

/// A rectangle that holds all lanes' bases.
struct Box {
  geometry::Point2 low, high;
  explicit Box(const Lanes& lanes);
  /// Squared metres from a point to the box; 0 inside.
  double distance2(geometry::Point2 p) const {
    const double x = most(0.0, most(low.x - p.x, p.x - high.x)), y = most(0.0, most(low.y - p.y, p.y - high.y));
    return x * x + y * y;
  }
};

/// The centres of the footprint's discs of each lane; a vehicle that is a disc has one, in its base.
class Outlines {
 public:
  explicit Outlines(const Scene& scene);
  /// @pre `lanes` lives as long
  void follow(const Lanes& lanes);
  /// Squared, from each lane's nearest centre.
  void distances2_to(geometry::Point2 p, Lane& squared);
  std::size_t count() const { return scene_.discs_ahead_m.size(); }
  double radius_m() const { return scene_.radius_m; }
  const grid::ClearanceField& clearance() const { return scene_.clearance; }
  /// One disc's centres in four lanes, `first` and the next.
  [[gnu::always_inline]] void find_centers(std::size_t disc, std::size_t first, geometry::Wide& x,
                                           geometry::Wide& y) const {
    geometry::load(&lanes_->x[first], x);
    geometry::load(&lanes_->y[first], y);
    if (is_disc_) return;
    geometry::Wide cos_yaw, sin_yaw;
    lanes_->find_headings(first, cos_yaw, sin_yaw);
    const double ahead_m = scene_.discs_ahead_m[disc];
    x = x + ahead_m * cos_yaw;
    y = y + ahead_m * sin_yaw;
  }

 private:
  void turn();
  void find_distances2_of_bases(geometry::Point2 p, Lane& squared) const;
  void find_distances2_of_discs(geometry::Point2 p, Lane& squared) const;

  const Scene& scene_;
  const Lanes* lanes_{nullptr};
  bool is_disc_;
  bool is_turned_{false};
  alignas(32) Lane cos_yaw_, sin_yaw_;  // where the lanes are now, once somebody has asked
};

/// Looks up distances to walls along trajectories; where there was plenty a moment ago it does not look again: the
/// distance shrinks by at most what was driven. Of several discs only those are looked up that can be too near.
class WallWatch {
 public:
  /// @param gaps_m of the vehicle's discs, where all samples begin
  /// @param enough_m gaps that are as wide are not asked for
  WallWatch(const Outlines& outlines, const DiscGaps& gaps_m, double enough_m);
  /// One step on. Returns whether some gap is less than enough.
  bool look(const Outlines& outlines, const Lane& driven_m);
  /// The least gap of each vehicle's outline that was seen so far; enough where there always was enough.
  const Lane& least_gaps_m() const { return least_m_; }
  /// Nobody asks for this lane's gap any more.
  void leave(std::size_t lane);

 private:
  void drive_on(const Lane& driven_m);
  bool look_at_unknown(const Outlines& outlines);

  double radius_m_, enough_m_;
  // Counted in metres driven since the beginning: until when a lane has enough surely, and until when each of its discs
  // has.
  alignas(32) Lane driven_m_, enough_until_m_, least_m_;
  alignas(32) std::array<Lane, kMostDiscs> far_until_m_;
  std::array<std::size_t, kLanes / geometry::kWide>
      unknown_;  // the first of each four lanes of which one has no longer surely enough
  std::size_t unknown_count_{0};
};

}  // namespace aisle::local_planner
