// C5, WU eq. 5 (dist-1): the nearer the trajectory keeps to the global path, the better.
//
//     dist-1(v, w) = 1 - mean distance to the path / 1 m, in [0, 1]
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {
namespace {

constexpr double kFarM = 1.0;  // from here on, farther from the path is no worse

/// Repaired: WU says that the lowest cost wins, while its heading and velocity terms are rewards; here all are rewards.
template <class Number>
[[gnu::always_inline]] inline Number score(const Sample<Number>& sample, const Aim&) {
  return geometry::clamped(1.0 - sample.path_distance_m / kFarM, 0.0, 1.0);
}

AISLE_BATCHED void score_block(const SampleBlock& samples, const Aim& aim, PerSample& scores) {
  for (std::size_t b = 0; b < kBatches; ++b) scores.put(b, score(samples.batches[b], aim));
}

}  // namespace

const Critic path_distance_critic{score<double>, score_block};

}  // namespace aisle::local_planner
