#include "services/local-planner/core/dwa.hpp"

#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <vector>

#include "services/local-planner/core/plain_window.hpp"
#include "services/local-planner/core/speed_window.hpp"
#include "services/local-planner/core/tube.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Batch;
using geometry::Twist2;

/// 1 for each sample that may be taken, 0 for the others: standing may always be.
std::vector<PerSample> admit(const std::vector<SampleBlock>& blocks, Choice& choice) {
  std::vector<PerSample> admitted(blocks.size());
  for (std::size_t k = 0; k < blocks.size(); ++k) {
    admitted[k].fill(0.0);
    for (std::size_t i = 0; i < blocks[k].count; ++i)
      if (choice.admit(blocks[k].moves[i], blocks[k].collisions[i])) admitted[k][i] = 1.0;
  }

  return admitted;
}

/// sums += scores of the admitted samples.
AISLE_BATCHED void add_admitted(const PerSample& scores, const PerSample& admitted, PerSample& sums) {
  for (std::size_t b = 0; b < kBatches; ++b) sums.put(b, sums.batch(b) + admitted.batch(b) * scores.batch(b));
}

/// totals += factor x scores.
AISLE_BATCHED void add_weighted(const PerSample& scores, double factor, PerSample& totals) {
  for (std::size_t b = 0; b < kBatches; ++b) totals.put(b, totals.batch(b) + factor * scores.batch(b));
}

double sum_of(const PerSample& numbers) { return std::accumulate(numbers.begin(), numbers.end(), 0.0); }

/// A zero for each sample of so many blocks.
std::vector<PerSample> zeros(std::size_t blocks) {
  std::vector<PerSample> out(blocks);
  for (PerSample& numbers : out) numbers.fill(0.0);

  return out;
}

/// The total of each sample: the sum over critics of weight x score / (the critic's mean over the admitted samples).
/// The division takes the place of the papers' smoothing, so that weights mean the same for every vehicle.
std::vector<PerSample> totals_of(const std::vector<SampleBlock>& blocks, const std::vector<PerSample>& admitted,
                                 const Aim& aim, const Variant& variant) {
  std::vector<PerSample> totals = zeros(blocks.size()), scores(blocks.size());

  double samples = 0.0;
  for (const PerSample& block : admitted) samples += sum_of(block);

  for (const WeightedCritic& critic : variant.critics) {
    PerSample sums;
    sums.fill(0.0);

    for (std::size_t k = 0; k < blocks.size(); ++k) {
      critic.critic.score_block(blocks[k], aim, scores[k]);
      add_admitted(scores[k], admitted[k], sums);
    }

    const double sum = sum_of(sums);

    for (std::size_t k = 0; sum > 0.0 && k < blocks.size(); ++k)
      add_weighted(scores[k], critic.weight * samples / sum, totals[k]);
  }

  return totals;
}

/// The admitted sample with the greatest total, the first of them; none where none is admitted.
std::optional<std::size_t> best_of(const std::vector<SampleBlock>& blocks, const std::vector<PerSample>& admitted,
                                   const std::vector<PerSample>& totals, const Preference& preference) {
  std::optional<std::size_t> best;
  double most = preference.least();
  for (std::size_t k = 0; k < blocks.size(); ++k)
    for (std::size_t i = 0; i < kBlock; ++i) {
      const double linear_mps = blocks[k].batches[i / geometry::kBatch].linear_mps[i % geometry::kBatch];
      const double total = preference.applied(totals[k][i], linear_mps);
      if (admitted[k][i] > 0.0 && total > most) {
        best = k * kBlock + i;
        most = total;
      }
    }

  return best;
}

}  // namespace

bool Choice::admit(bool moves, Obstruction collision) {
  const bool is_rejected = moves && collision != Obstruction::kNone;
  if (is_rejected)
    ++rejected[static_cast<std::size_t>(collision)];
  else if (moves)
    ++moving;

  return !is_rejected;
}

std::vector<Twist2> Choice::without_leaving(const std::vector<Twist2>& wanted, const Scene& scene,
                                            const DwaSettings& settings) {
  if (scene.tube == nullptr) return wanted;

  std::vector<Twist2> keeping;
  keeping.reserve(wanted.size());
  const TubeKeeping keeps(scene, *scene.tube, settings);

  for (const Twist2& sample : wanted) {
    if (keeps.to(sample))
      keeping.push_back(sample);
    else
      ++rejected[static_cast<std::size_t>(Obstruction::kTube)];
  }

  return keeping;
}

std::vector<Twist2> Choice::without_obstructed(const std::vector<Twist2>& wanted,
                                               const std::vector<Obstruction>& obstructions) {
  std::vector<Twist2> stoppable;
  stoppable.reserve(wanted.size());

  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (obstructions[i] == Obstruction::kNone)
      stoppable.push_back(wanted[i]);
    else
      ++rejected[static_cast<std::size_t>(obstructions[i])];
  }

  return stoppable;
}

void Choice::take(const Sample<double>& sample) {
  found = true;
  twist = {sample.linear_mps, sample.angular_radps, sample.sideways_mps};
  wall_gap_m = sample.wall_gap_m;
  mover_gap_m = sample.mover_gap_m;
}

Preference::Preference(const Scene& scene, const Variant& variant, const DwaSettings& settings)
    : speed_mps_(scene.twist.linear_mps) {
  for (const WeightedCritic& critic : variant.critics) mean_ += critic.weight;
  const bool is_under_way = std::abs(speed_mps_) > kStandingMps;  // a standing vehicle sets off for the least gain
  change_costs_ = (is_under_way ? settings.change_worth : 0.0) * mean_;
}

Choice batched::choose(const Scene& scene, const Aim& aim, const Variant& variant, const DwaSettings& settings) {
  // 1. The window: which gaps are needed here, and which speeds can be reached.
  const Needed needed = needed_gaps(scene, settings);
  Choice choice;
  const std::vector<Twist2> wanted = choice.without_leaving(speed_window(scene, settings), scene, settings);

  // 2. What could stop in time.
  const std::vector<Twist2> stoppable =
      choice.without_obstructed(wanted, obstructions(scene, needed, wanted, settings));

  // 3. Where the others lead, and what they are worth.
  const std::vector<SampleBlock> blocks = roll_out(scene, needed, stoppable, aim, settings);
  const std::vector<PerSample> admitted = admit(blocks, choice);
  const std::vector<PerSample> totals = totals_of(blocks, admitted, aim, variant);

  if (const auto best = best_of(blocks, admitted, totals, Preference(scene, variant, settings)))
    choice.take(blocks[*best / kBlock].at(*best % kBlock));

  return choice;
}

Choice choose(const Scene& scene, const Aim& aim, const Variant& variant, const DwaSettings& settings) {
#ifdef AISLE_VECTORS
  return batched::choose(scene, aim, variant, settings);
#else
  return plain::choose(scene, aim, variant, settings);
#endif
}

Obstruction obstruction(const Scene& scene, const Twist2& wanted, const DwaSettings& settings) {
#ifdef AISLE_VECTORS
  return batched::obstructions(scene, needed_gaps(scene, settings), {wanted}, settings).front();
#else
  return plain::obstructions(scene, needed_gaps(scene, settings), {wanted}, settings).front();
#endif
}

}  // namespace aisle::local_planner
