// C1, all five papers: the smaller the angle from the trajectory's end to the target, the better.
//
//     heading(v, w) = pi - |angle from the pose to the target|, in [0, pi]
#include "services/local-planner/core/critic.hpp"
#include "services/local-planner/core/turns.hpp"

namespace aisle::local_planner {
namespace {

/// Looked at where the trajectory is after the heading time: at the horizon a fast sample has often passed a near
/// target, and every angle there is as bad as any other.
template <class Number>
[[gnu::always_inline]] inline Number score(const Sample<Number>& sample, const Aim& aim) {
  return geometry::kPi - turn_left_rad(sample, aim.target_in_map);
}

AISLE_BATCHED void score_block(const SampleBlock& samples, const Aim& aim, PerSample& scores) {
  for (std::size_t b = 0; b < kBatches; ++b) scores.put(b, score(samples.batches[b], aim));
}

}  // namespace

const Critic heading_critic{score<double>, score_block};

}  // namespace aisle::local_planner
