#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "common/grid/clearance_batch.hpp"
#include "services/local-planner/core/motion.hpp"
#include "services/local-planner/core/scene.hpp"

namespace aisle::local_planner::plain {

/// The least gap to walls along each trajectory of a block, sample by sample: what WallGaps says, to the bit.
///
/// How (conservative advancement, Mirtich 1996): where a disc had `g` metres to spare, it has some left until it has
/// driven `g` further, and is not looked up before. When a disc of a sample is due, the discs of its three neighbours
/// are looked up as well, as the batched version does; what is known of a gap differs by a rounding of the field
/// otherwise.
class Walls {
 public:
  /// @param gaps_m of the vehicle's discs, where all samples begin
  /// @param enough_m more than this counts as this
  Walls(const Scene& scene, const DiscGaps& gaps_m, double enough_m);

  /// One step further: sample i is at `arcs[i]`, and its farthest point has driven at most `driven_m[i]` in the step.
  void look(const std::vector<Arc<double>>& arcs, const std::vector<double>& driven_m);

  /// The least gap of sample i so far, in metres; enough where there always was enough.
  double least_m(std::size_t i) const { return watched_[i].least_m; }

  /// Stops computing the gap of sample i.
  void leave(std::size_t i) { watched_[i].is_left = true; }

 private:
  /// What is known of one sample's gaps.
  struct Watched {
    bool is_left{false};
    double driven_m{0.0};
    double enough_until_m;                       // driven by then, all discs have enough
    double least_m;                              // so far
    std::array<double, kMostDiscs> far_until_m;  // driven by then, a disc has no less than least_m
  };

  /// Looks up the discs that are due of four neighbouring samples.
  void look_at_four(Watched* four, const Arc<double>* arcs);

  /// Looks up one disc of all four.
  void look_up(Watched* four, const Arc<double>* arcs, std::size_t disc, bool is_near_already);

  /// Centre of one disc of the footprint.
  geometry::Point2 center_in_map(const Arc<double>& arc, std::size_t disc) const;

  const Scene& scene_;
  const grid::ClearanceBatch rough_;
  double enough_m_;
  std::vector<Watched> watched_;
};

}  // namespace aisle::local_planner::plain
