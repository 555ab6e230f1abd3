// C7, QU eq. 12: clearance to walls and to what stands, D from the vehicle's centre.
//
//     dist_s(v, w) = 0 where D < 1.2 R, else D / (R + wall cap), in [0, 1]
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {
namespace {

constexpr double kTooNear = 1.2;  // radii

/// Repaired: eq. 12 prints 1/D, which would reward driving close.
template <class Number>
[[gnu::always_inline]] inline Number score(const Sample<Number>& sample, const Aim& aim) {
  const Number center_m = aim.radius_m + geometry::least(sample.wall_gap_m, sample.standing_gap_m);
  const Number growing = geometry::least<Number>(Number{} + 1.0, center_m / (aim.radius_m + aim.wall_cap_m));
  return center_m < kTooNear * aim.radius_m ? Number{} : growing;
}

AISLE_BATCHED void score_block(const SampleBlock& samples, const Aim& aim, PerSample& scores) {
  for (std::size_t b = 0; b < kBatches; ++b) scores.put(b, score(samples.batches[b], aim));
}

}  // namespace

const Critic static_clearance_critic{score<double>, score_block};

}  // namespace aisle::local_planner
