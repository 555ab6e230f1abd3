// C3, all five papers: the faster, the better.
//
//     vel(v, w) = |v|, in m/s
#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {
namespace {

template <class Number>
[[gnu::always_inline]] inline Number score(const Sample<Number>& sample, const Aim&) {
  return geometry::magnitude(sample.linear_mps);
}

AISLE_BATCHED void score_block(const SampleBlock& samples, const Aim& aim, PerSample& scores) {
  for (std::size_t b = 0; b < kBatches; ++b) scores.put(b, score(samples.batches[b], aim));
}

}  // namespace

const Critic velocity_critic{score<double>, score_block};

}  // namespace aisle::local_planner
