// C4, LI eq. 10 (Yheading): the smaller the angle from the trajectory's end to the sub-target, the better.
//
//     Yheading(v, w) = pi - |angle from the pose to the sub-target|, in [0, pi]
#include "services/local-planner/core/critic.hpp"
#include "services/local-planner/core/turns.hpp"

namespace aisle::local_planner {
namespace {

/// The sub-target is the point of the global path nearest to the vehicle, a look-ahead further on. Looked at after the
/// heading time, as C1.
template <class Number>
[[gnu::always_inline]] inline Number score(const Sample<Number>& sample, const Aim& aim) {
  return geometry::kPi - turn_left_rad(sample, aim.sub_target_in_map);
}

AISLE_BATCHED void score_block(const SampleBlock& samples, const Aim& aim, PerSample& scores) {
  for (std::size_t b = 0; b < kBatches; ++b) scores.put(b, score(samples.batches[b], aim));
}

}  // namespace

const Critic sub_target_heading_critic{score<double>, score_block};

}  // namespace aisle::local_planner
