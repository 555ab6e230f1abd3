#include "services/local-planner/core/dwa.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

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

/// @pre not empty
const Sample& best_of(const std::vector<const Sample*>& samples, const Aim& aim, const Variant& variant) {
  const std::size_t critics = variant.critics.size();
  std::vector<double> scores(samples.size() * critics), factors(critics, 0.0);
  for (std::size_t i = 0; i < samples.size(); ++i)
    for (std::size_t c = 0; c < critics; ++c) factors[c] += scores[i * critics + c] = variant.critics[c].score(*samples[i], aim);
  for (std::size_t c = 0; c < critics; ++c) factors[c] = factors[c] > 0.0 ? variant.critics[c].weight * static_cast<double>(samples.size()) / factors[c] : 0.0;
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    double total = 0.0;
    for (std::size_t c = 0; c < critics; ++c) total += factors[c] * scores[i * critics + c];
    if (total > most) best = i, most = total;
  }
  return *samples[best];
}

/// Turn rates at this speed: those that the window reaches, straight on among them; of a tricycle those that its wheel can be steered to
/// within the time that it takes to look there.
std::vector<double> turns_at(const Scene& scene, double v, const DwaSettings& settings) {
  const kinematics::Limits& limits = scene.limits;
  std::vector<double> turns;
  if (limits.model == kinematics::Model::kTricycle) {
    const double reach = limits.axle.max_steering_rate_radps * settings.heading_s;
    const double low = std::max(-limits.axle.max_steering_rad, scene.steering_rad - reach);
    const double high = std::min(limits.axle.max_steering_rad, scene.steering_rad + reach);
    for (const double steering : spread(low, high, v > 0.0 ? settings.angular_samples : 1)) turns.push_back(kinematics::turn_rate_radps(limits.axle, v, steering));
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
  std::vector<double> speeds = spread(std::max(-most, scene.twist.sideways_mps - reach), std::min(most, scene.twist.sideways_mps + reach), 3);
  if (std::find(speeds.begin(), speeds.end(), 0.0) == speeds.end()) speeds.push_back(0.0);
  return speeds;
}

std::vector<Twist2> window(const Scene& scene, const DwaSettings& settings) {
  const kinematics::Limits& limits = scene.limits;
  const double v0 = scene.twist.linear_mps;
  const double v_low = std::max(0.0, v0 - limits.max_deceleration_mps2 * settings.window_s);
  const double v_high = std::max(v_low, std::min({v0 + limits.max_acceleration_mps2 * settings.window_s, scene.speed_cap_mps, limits.max_speed_mps}));
  std::vector<Twist2> samples;
  for (const double v : spread(v_low, v_high, settings.linear_samples)) {
    const std::vector<double> turns = turns_at(scene, v, settings);
    for (const double sideways : sideways_of(scene, settings))
      for (const double w : turns) samples.push_back({v, w, sideways});
  }
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
    if (stopping[i] == Obstruction::kNone) stoppable.push_back(wanted[i]);
    else ++choice.rejected[static_cast<int>(stopping[i])];
  }
  const std::vector<Rollout> rollouts = roll_out(scene, needed, stoppable, aim, settings);
  std::vector<const Sample*> samples;
  samples.reserve(rollouts.size());
  for (const Rollout& rollout : rollouts) {
    const bool moves = fastest_point_mps(scene, rollout.sample.twist) > kStandingMps;
    if (moves && rollout.collides != Obstruction::kNone) {
      ++choice.rejected[static_cast<int>(rollout.collides)];
      continue;
    }
    if (moves) ++choice.moving;
    samples.push_back(&rollout.sample);
  }
  if (samples.empty()) return choice;
  const Sample& best = best_of(samples, aim, variant);
  choice.found = true;
  choice.twist = best.twist;
  choice.wall_gap_m = best.wall_gap_m;
  choice.mover_gap_m = best.mover_gap_m;
  return choice;
}

}  // namespace aisle::local_planner
