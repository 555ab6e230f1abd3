// C2 (LI, WU, YU, WANG): least clearance along the trajectory, capped, so that open space has no pull of its own.
//
//     dist(v, w) = min(wall gap / wall cap, mover gap / mover cap), in [0, 1]
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {
namespace {

template <class Number>
[[gnu::always_inline]] inline Number score(const Sample<Number>& sample, const Aim& aim) {
  using geometry::clamped;
  return geometry::least(clamped(sample.wall_gap_m / aim.wall_cap_m, 0.0, 1.0),
                         clamped(sample.mover_gap_m / aim.mover_cap_m, 0.0, 1.0));
}

AISLE_BATCHED void score_block(const SampleBlock& samples, const Aim& aim, PerSample& scores) {
  for (std::size_t b = 0; b < kBatches; ++b) scores.put(b, score(samples.batches[b], aim));
}

}  // namespace

const Critic clearance_critic{score<double>, score_block};

}  // namespace aisle::local_planner
