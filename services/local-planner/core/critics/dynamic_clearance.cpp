// C8, QU eq. 15: clearance D to what moves, where it will be at that time. D is the gap between the outlines; eq. 14
// takes the distance of the centres, which for the papers' points is the same.
//
//     dist_d(v, w) = 0 where D < 1.2 |v| dt, else D / mover cap, in [0, 1]
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {
namespace {

constexpr double kTooNear = 1.2;  // of the way of one step

/// Repaired: eq. 15 prints 1/D, which would reward driving close.
template <class Number>
[[gnu::always_inline]] inline Number score(const Sample<Number>& sample, const Aim& aim) {
  const Number least_m = kTooNear * geometry::magnitude(sample.linear_mps) * aim.step_s;
  return sample.moving_gap_m < least_m ? Number{} : geometry::clamped(sample.moving_gap_m / aim.mover_cap_m, 0.0, 1.0);
}

AISLE_BATCHED void score_block(const SampleBlock& samples, const Aim& aim, PerSample& scores) {
  for (std::size_t b = 0; b < kBatches; ++b) scores.put(b, score(samples.batches[b], aim));
}

}  // namespace

const Critic dynamic_clearance_critic{score<double>, score_block};

}  // namespace aisle::local_planner
