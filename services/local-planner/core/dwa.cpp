#include "services/local-planner/core/dwa.hpp"

#include <algorithm>
#include <cstddef>

namespace aisle::local_planner {
namespace {

using geometry::Twist2;

constexpr double kStandingMps = 0.05;

std::vector<double> spread(double low, double high, int count) {
  std::vector<double> values;
  if (high - low < 1e-6 || count < 2) return {high};
  for (int i = 0; i < count; ++i) values.push_back(low + (high - low) * i / (count - 1));
  return values;
}

std::size_t best_of(const std::vector<Sample>& samples, const Aim& aim, const Variant& variant) {
  std::vector<double> total(samples.size(), 0.0);
  std::vector<double> scores(samples.size());
  for (const WeightedCritic& critic : variant.critics) {
    double sum = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) sum += scores[i] = critic.score(samples[i], aim);
    if (sum <= 0.0) continue;
    const double factor = critic.weight * static_cast<double>(samples.size()) / sum;
    for (std::size_t i = 0; i < samples.size(); ++i) total[i] += factor * scores[i];
  }
  return static_cast<std::size_t>(std::distance(total.begin(), std::max_element(total.begin(), total.end())));
}

}  // namespace

Choice choose(const Scene& scene, const Aim& aim, const Variant& variant, const DwaSettings& settings) {
  const kinematics::Limits& limits = scene.limits;
  const double v0 = scene.twist.linear_mps;
  const double w0 = scene.twist.angular_radps;
  const double v_low = std::max(0.0, v0 - limits.max_deceleration_mps2 * settings.window_s);
  const double v_high = std::max(v_low, std::min({v0 + limits.max_acceleration_mps2 * settings.window_s, scene.speed_cap_mps, limits.max_speed_mps}));
  const double reach = limits.max_turn_acceleration_radps2 * settings.window_s;
  const double w_low = std::max(-limits.max_turn_radps, w0 - reach);
  const double w_high = std::min(limits.max_turn_radps, w0 + reach);

  const Needed needed = needed_gaps(scene, settings);
  std::vector<double> turns = spread(w_low, w_high, settings.angular_samples);
  if (w_low < 0.0 && w_high > 0.0) turns.push_back(0.0);
  Choice choice;
  std::vector<Sample> samples;
  for (const double v : spread(v_low, v_high, settings.linear_samples))
    for (const double w : turns) {
      const Twist2 wanted{v, w, 0.0};
      const Obstruction stopping = obstruction(scene, needed, wanted, settings);
      if (stopping != Obstruction::kNone) {
        ++choice.rejected[static_cast<int>(stopping)];
        continue;
      }
      const Rollout rollout = roll_out(scene, needed, wanted, aim, settings);
      if (rollout.collides != Obstruction::kNone && v > kStandingMps) {
        ++choice.rejected[static_cast<int>(rollout.collides)];
        continue;
      }
      if (v > kStandingMps) ++choice.moving;
      samples.push_back(rollout.sample);
    }
  if (samples.empty()) return choice;
  const Sample& best = samples[best_of(samples, aim, variant)];
  choice.found = true;
  choice.twist = best.twist;
  choice.wall_gap_m = best.wall_gap_m;
  choice.mover_gap_m = best.mover_gap_m;
  return choice;
}

}  // namespace aisle::local_planner
