#include "services/local-planner/core/dwa.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <vector>

#include "common/geometry/wide_vectors.hpp"
#include "common/kinematics/tricycle.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Twist2;

constexpr double kStandingMps = 0.05;

std::vector<double> spread(double low, double high, int count) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(std::max(count, 1)) + 1);
  if (high - low < 1e-6 || count < 2) return {high};
  for (int i = 0; i < count; ++i) values.push_back(low + (high - low) * i / (count - 1));
  return values;
}

/// 1 for each sample that may be taken, 0 for the others: standing may always be.
std::vector<Lane> admit(const std::vector<Samples>& all, Choice& choice) {
  std::vector<Lane> admitted(all.size());
  for (std::size_t b = 0; b < all.size(); ++b)
    for (std::size_t i = 0; i < all[b].count; ++i) {
      const bool is_rejected = all[b].moves[i] && all[b].collides[i] != Obstruction::kNone;
      if (is_rejected)
        ++choice.rejected[static_cast<int>(all[b].collides[i])];
      else if (all[b].moves[i])
        ++choice.moving;
      admitted[b][i] = is_rejected ? 0.0 : 1.0;
    }
  return admitted;
}

/// To `sums`, lane by lane, what of `values` is admitted.
AISLE_WIDE_VECTORS void add(const Lane& values, const Lane& admitted, Lane& sums) {
  for (std::size_t i = 0; i < kLanes; ++i) sums[i] += admitted[i] * values[i];
}

AISLE_WIDE_VECTORS void add(const Lane& values, double factor, Lane& sums) {
  for (std::size_t i = 0; i < kLanes; ++i) sums[i] += factor * values[i];
}

/// The admitted sample with the greatest sum of weighted scores, counted over all lanes; the first of them. None where
/// none is admitted. Another speed than the one in force must be worth a share of what a sample earns on the mean: else
/// two that are almost as good send the vehicle up and down.
std::optional<std::size_t> best_of(const std::vector<Samples>& all, const std::vector<Lane>& admitted, const Aim& aim,
                                   const Variant& variant, double speed_mps, double change_worth) {
  Lane count{};
  for (const Lane& lanes : admitted) add(lanes, 1.0, count);
  const double samples = std::accumulate(count.begin(), count.end(), 0.0);
  std::vector<Lane> totals(all.size()), scores(all.size());
  for (const WeightedCritic& critic : variant.critics) {
    Lane sums{};
    for (std::size_t b = 0; b < all.size(); ++b) {
      critic.score(all[b], aim, scores[b]);
      add(scores[b], admitted[b], sums);
    }
    const double sum = std::accumulate(sums.begin(), sums.end(), 0.0);
    for (std::size_t b = 0; sum > 0.0 && b < all.size(); ++b) add(scores[b], critic.weight * samples / sum, totals[b]);
  }
  double mean = 0.0;  // what is normalised earns its weight on the mean
  for (const WeightedCritic& critic : variant.critics) mean += critic.weight;
  std::optional<std::size_t> best;
  double most = -mean;
  for (std::size_t b = 0; b < all.size(); ++b)
    for (std::size_t i = 0; i < kLanes; ++i) {
      const double total = totals[b][i] - (all[b].linear_mps[i] == speed_mps ? 0.0 : change_worth * mean);
      if (admitted[b][i] > 0.0 && total > most) best = b * kLanes + i, most = total;
    }
  return best;
}

/// Turn rates at this speed: those that the window reaches, straight on among them; of a tricycle those that its wheel
/// can be steered to within the time that it takes to look there.
std::vector<double> turns_at(const Scene& scene, double v, const DwaSettings& settings) {
  const kinematics::Limits& limits = scene.limits;
  std::vector<double> turns;
  if (limits.model == kinematics::Model::kTricycle) {
    const double reach = limits.axle.max_steering_rate_radps * settings.heading_s;
    const double low = std::max(-limits.axle.max_steering_rad, scene.steering_rad - reach);
    const double high = std::min(limits.axle.max_steering_rad, scene.steering_rad + reach);
    for (const double steering : spread(low, high, v > 0.0 ? settings.angular_samples : 1))
      turns.push_back(kinematics::turn_rate_radps(limits.axle, v, steering));
    if (low < 0.0 && high > 0.0) turns.push_back(0.0);
    return turns;
  }
  const double w0 = scene.twist.angular_radps;
  const double reach = limits.max_turn_acceleration_radps2 * settings.window_s;
  const double low = std::max(-limits.max_turn_radps, w0 - reach);
  const double high = std::min(limits.max_turn_radps, w0 + reach);
  turns = spread(low, high, settings.angular_samples);
  if (low < 0.0 && high > 0.0) turns.push_back(0.0);
  return turns;
}

/// Speeds to the left: none but for omnidirectional vehicles.
std::vector<double> sideways_of(const Scene& scene, const DwaSettings& settings) {
  const kinematics::Limits& limits = scene.limits;
  if (limits.model != kinematics::Model::kOmnidirectional) return {0.0};
  const double reach = limits.max_acceleration_mps2 * settings.window_s;
  const double most = std::min(scene.speed_cap_mps, limits.max_speed_mps);
  std::vector<double> speeds =
      spread(std::max(-most, scene.twist.sideways_mps - reach), std::min(most, scene.twist.sideways_mps + reach), 3);
  if (std::find(speeds.begin(), speeds.end(), 0.0) == speeds.end()) speeds.push_back(0.0);
  return speeds;
}

/// Speeds that the window reaches, and the one in force: where the best speed lies between two others, the vehicle
/// would else be sent up and down from cycle to cycle.
std::vector<double> forwards_of(const Scene& scene, const DwaSettings& settings) {
  const kinematics::Limits& limits = scene.limits;
  const double v0 = scene.twist.linear_mps;
  const double low = std::max(0.0, v0 - limits.max_deceleration_mps2 * settings.window_s);
  const double high = std::max(low, std::min({v0 + limits.max_acceleration_mps2 * settings.window_s,
                                              scene.speed_cap_mps, limits.max_speed_mps}));
  std::vector<double> speeds = spread(low, high, settings.linear_samples);
  if (low < v0 && v0 < high) speeds.insert(std::lower_bound(speeds.begin(), speeds.end(), v0), v0);
  return speeds;
}

/// Neighbours in turn and speed come one after the other: they end at the same walls, and so together.
std::vector<Twist2> window(const Scene& scene, const DwaSettings& settings) {
  constexpr std::size_t kTogether = 8;  // speeds
  const std::vector<double> speeds = forwards_of(scene, settings), sideways = sideways_of(scene, settings);
  std::vector<std::vector<double>> turns;
  std::size_t most_turns = 0;
  for (const double v : speeds) {
    turns.push_back(turns_at(scene, v, settings));
    most_turns = std::max(most_turns, turns.back().size());
  }
  std::vector<Twist2> samples;
  samples.reserve(speeds.size() * most_turns * sideways.size());
  for (std::size_t first = 0; first < speeds.size(); first += kTogether)
    for (std::size_t w = 0; w < most_turns; ++w)
      for (std::size_t v = first; v < std::min(first + kTogether, speeds.size()); ++v)
        for (std::size_t s = 0; w < turns[v].size() && s < sideways.size(); ++s)
          samples.push_back({speeds[v], turns[v][w], sideways[s]});
  return samples;
}

}  // namespace

Choice choose(const Scene& scene, const Aim& aim, const Variant& variant, const DwaSettings& settings) {
  const Needed needed = needed_gaps(scene, settings);
  Choice choice;
  const std::vector<Twist2> wanted = window(scene, settings);
  const std::vector<Obstruction> stopping = obstructions(scene, needed, wanted, settings);
  std::vector<Twist2> stoppable;
  stoppable.reserve(wanted.size());
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    if (stopping[i] == Obstruction::kNone)
      stoppable.push_back(wanted[i]);
    else
      ++choice.rejected[static_cast<int>(stopping[i])];
  }
  const std::vector<Samples> all = roll_out(scene, needed, stoppable, aim, settings);
  const std::vector<Lane> admitted = admit(all, choice);
  const bool is_under_way =
      std::abs(scene.twist.linear_mps) > kStandingMps;  // who stands may set off for the least gain
  const std::optional<std::size_t> best =
      best_of(all, admitted, aim, variant, scene.twist.linear_mps, is_under_way ? settings.change_worth : 0.0);
  if (!best) return choice;
  const Samples& samples = all[*best / kLanes];
  const std::size_t lane = *best % kLanes;
  choice.found = true;
  choice.twist = samples.twist(lane);
  choice.wall_gap_m = samples.wall_gap_m[lane];
  choice.mover_gap_m = samples.mover_gap_m[lane];
  return choice;
}

}  // namespace aisle::local_planner
