// C6, WU eq. 5 (dist-2): the nearer the trajectory's end comes to the local sub-target, the better.
//
//     dist-2(v, w) = 1 - distance to the sub-target / 3 m, in [0, 1]
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {
namespace {

constexpr double kFarM = 3.0;  // from here on, farther from the sub-target is no worse

/// Looked at where the trajectory is after the heading time: at the horizon a fast sample has passed a near sub-target,
/// and would lose to one that stands. A reward, as C5.
template <class Number>
[[gnu::always_inline]] inline Number score(const Sample<Number>& sample, const Aim& aim) {
  const Number x = sample.look_x_m - aim.target_in_map.x;
  const Number y = sample.look_y_m - aim.target_in_map.y;
  return geometry::clamped(1.0 - geometry::square_root(x * x + y * y) / kFarM, 0.0, 1.0);
}

AISLE_BATCHED void score_block(const SampleBlock& samples, const Aim& aim, PerSample& scores) {
  for (std::size_t b = 0; b < kBatches; ++b) scores.put(b, score(samples.batches[b], aim));
}

}  // namespace

const Critic sub_target_distance_critic{score<double>, score_block};

}  // namespace aisle::local_planner
