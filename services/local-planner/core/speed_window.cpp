#include "services/local-planner/core/speed_window.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "common/kinematics/tricycle.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Twist2;

constexpr double kNoSpread = 1e-6;  // m/s, rad/s or rad
constexpr int kSidewaysSamples = 3;

/// `count` numbers from `low` to `high`, both included; `high` alone where the two are as good as one.
std::vector<double> spread(double low, double high, int count) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(std::max(count, 1)) + 1);

  if (high - low < kNoSpread || count < 2) return {high};
  for (int i = 0; i < count; ++i) values.push_back(low + (high - low) * i / (count - 1));

  return values;
}

/// From `low` on every `step`, and `high`.
std::vector<double> stepped(double low, double high, double step) {
  std::vector<double> values;
  const int steps = static_cast<int>((high - low) / step + kNoSpread);
  for (int i = 0; i <= steps; ++i) values.push_back(low + i * step);
  if (values.empty() || high - values.back() > kNoSpread) values.push_back(high);
  return values;
}

/// Turn rates of a window of (v, w), as the papers sample it: by their resolution; of a tricycle those that its wheel
/// can be steered to at all at this speed.
std::vector<double> turns_by_resolution(const Scene& scene, double v, const DwaSettings& settings) {
  const kinematics::Limits& limits = scene.limits;
  const bool is_steered = limits.model == kinematics::Model::kTricycle;
  const double most =
      is_steered ? std::min(limits.max_turn_radps, v * std::tan(limits.axle.max_steering_rad) / limits.axle.wheelbase_m)
                 : limits.max_turn_radps;
  const double w0 = std::clamp(scene.twist.angular_radps, -most, most);
  const double reach = limits.max_turn_acceleration_radps2 * settings.window_s;
  const double low = std::max(-most, w0 - reach), high = std::min(most, w0 + reach);
  std::vector<double> turns = stepped(low, high, settings.angular_step_radps);
  if (low < 0.0 && high > 0.0) turns.push_back(0.0);
  return turns;
}

/// Turn rates at this speed: those that the window reaches, straight on among them; of a tricycle those that its wheel
/// can be steered to within the time that it takes to look there.
std::vector<double> turns_at(const Scene& scene, double v, const DwaSettings& settings) {
  if (settings.angular_step_radps > 0.0) return turns_by_resolution(scene, v, settings);
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
  std::vector<double> speeds = spread(std::max(-most, scene.twist.sideways_mps - reach),
                                      std::min(most, scene.twist.sideways_mps + reach), kSidewaysSamples);

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
  std::vector<double> speeds = settings.linear_step_mps > 0.0 ? stepped(low, high, settings.linear_step_mps)
                                                              : spread(low, high, settings.linear_samples);
  if (low < v0 && v0 < high) speeds.insert(std::lower_bound(speeds.begin(), speeds.end(), v0), v0);

  return speeds;
}

}  // namespace

std::vector<Twist2> speed_window(const Scene& scene, const DwaSettings& settings) {
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

  // Eight speeds at a time, by turn rates: what ends at the same walls stands together.
  for (std::size_t first = 0; first < speeds.size(); first += kTogether)
    for (std::size_t w = 0; w < most_turns; ++w)
      for (std::size_t v = first; v < std::min(first + kTogether, speeds.size()); ++v)
        for (std::size_t s = 0; w < turns[v].size() && s < sideways.size(); ++s)
          samples.push_back({speeds[v], turns[v][w], sideways[s]});

  return samples;
}

}  // namespace aisle::local_planner
