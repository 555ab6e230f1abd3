#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "services/local-planner/core/motion.hpp"
#include "services/local-planner/core/rollout.hpp"

namespace aisle::local_planner {

/// Farthest centre of a disc of the footprint from the base, in metres: what a turn swings.
double swing_m(const Scene& scene);

/// Squared metres from a vehicle's nearest disc centre to a point in map. How: the centres lie on a line through the
/// base (`x`, `y`) along the heading; the point's way along that line and across it are the same for all of them.
template <class Number>
[[gnu::always_inline]] inline Number outline_distance2(const std::vector<double>& discs_ahead_m, const Number& x,
                                                       const Number& y, const Number& cos_yaw, const Number& sin_yaw,
                                                       geometry::Point2 p) {
  constexpr double kFar2 = 1e18;  // m^2, more than any map
  const Number east = p.x - x;
  const Number north = p.y - y;
  const Number along = cos_yaw * east + sin_yaw * north;
  const Number across = cos_yaw * north - sin_yaw * east;

  Number nearest2 = Number{} + kFar2;

  for (const double ahead_m : discs_ahead_m) {
    const Number left = along - ahead_m;
    nearest2 = geometry::least<Number>(nearest2, left * left);
  }

  return nearest2 + across * across;
}

/// The same of a vehicle that is one disc around its base.
template <class Number>
[[gnu::always_inline]] inline Number disc_distance2(const Number& x, const Number& y, geometry::Point2 p) {
  const Number east = x - p.x;
  const Number north = y - p.y;
  return east * east + north * north;
}

/// Is the footprint one disc around the base?
inline bool is_disc(const Scene& scene) {
  return scene.discs_ahead_m.size() == 1 && scene.discs_ahead_m.front() == 0.0;
}

/// A rectangle in map that holds the bases of a block of samples.
struct Box {
  geometry::Point2 low, high;

  /// Of a block's bases.
  static Box around(const ArcBlock& arcs);

  /// Squared metres from a point to the box; 0 inside.
  double distance2(geometry::Point2 p) const {
    const double x = geometry::most(0.0, geometry::most(low.x - p.x, p.x - high.x));
    const double y = geometry::most(0.0, geometry::most(low.y - p.y, p.y - high.y));
    return x * x + y * y;
  }
};

/// The footprints of a block of samples, each as discs along its vehicle's axis.
class Outlines {
 public:
  /// @pre both live as long; the outlines follow the arcs
  Outlines(const Scene& scene, const ArcBlock& arcs) : scene_(scene), arcs_(arcs), is_disc_(is_disc(scene)) {}

  /// The scene that the vehicles are in.
  const Scene& scene() const { return scene_; }

  /// Unit vectors of the headings, for distance2(): to be called after each step.
  void find_headings();

  /// Squared metres from the nearest disc's centre to a point in map, for the samples of batch `b`.
  [[gnu::always_inline]] geometry::Batch distance2(std::size_t b, geometry::Point2 p) const {
    const Arc<geometry::Batch>& arc = arcs_.batches[b];
    return is_disc_ ? disc_distance2(arc.x, arc.y, p)
                    : outline_distance2(scene_.discs_ahead_m, arc.x, arc.y, cos_yaw_[b], sin_yaw_[b], p);
  }

  /// One disc's centres, for the samples of batch `b`.
  [[gnu::always_inline]] void find_centers(std::size_t disc, std::size_t b, geometry::Batch& x,
                                           geometry::Batch& y) const {
    const Arc<geometry::Batch>& arc = arcs_.batches[b];
    x = arc.x;
    y = arc.y;
    if (is_disc_) return;
    const double ahead_m = scene_.discs_ahead_m[disc];
    x = x + ahead_m * arc.cos_yaw();
    y = y + ahead_m * arc.sin_yaw();
  }

 private:
  const Scene& scene_;
  const ArcBlock& arcs_;
  bool is_disc_;
  alignas(sizeof(geometry::Batch)) geometry::Batch cos_yaw_[kBatches], sin_yaw_[kBatches];
};

/// The least gap to walls along each trajectory of a block.
///
/// How (conservative advancement, Mirtich 1996): where a disc had `g` metres to spare, it has some left until it has
/// driven `g` further, and is not looked up before. Then the four samples of its batch are looked up together, first
/// roughly, and exactly where the rough bound is not enough.
class WallGaps {
 public:
  /// @param gaps_m of the vehicle's discs, where all samples begin
  /// @param enough_m more than this counts as this
  WallGaps(const Outlines& outlines, const DiscGaps& gaps_m, double enough_m);

  /// One step further. Returns whether a sample's gap was found to be less than enough.
  bool look(const PerSample& driven_m);

  /// The least gap of each sample so far, in metres; enough where there always was enough.
  const PerSample& least_m() const { return least_m_; }

  /// Stops computing the gap of sample i.
  void leave(std::size_t i);

 private:
  /// Adds to what was driven, and lists the batches with a sample that may have too little by now.
  void drive_on(const PerSample& driven_m);

  /// Looks up those batches.
  bool look_up();

  const Outlines& outlines_;
  double enough_m_;
  PerSample driven_m_;        // by each sample so far: an upper bound
  PerSample enough_until_m_;  // driven by then, all discs of a sample have enough
  PerSample least_m_;
  std::array<PerSample, kMostDiscs> far_until_m_;  // driven by then, a disc has no less than least_m_
  std::array<std::size_t, kBatches> due_;          // batches to look up
  std::size_t due_count_{0};
};

}  // namespace aisle::local_planner
