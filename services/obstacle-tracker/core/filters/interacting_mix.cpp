// Three motions at once, each with its probability: standing still, constant velocity, constant turn. The interacting
// multiple model estimator (Blom, Bar-Shalom 1988; Bar-Shalom, Li, Kirubarajan 2001, 11.6.6). The turn rate, which only
// one of the motions knows, is that motion's own when the others are mixed into it (after Granstroem, Willett,
// Bar-Shalom 2015), so that the motions without a turn rate do not pull it to zero.

#include <algorithm>
#include <array>
#include <cmath>

#include "services/obstacle-tracker/core/motion_filter.hpp"
#include "services/obstacle-tracker/core/motions/standing.hpp"
#include "services/obstacle-tracker/core/motions/straight.hpp"
#include "services/obstacle-tracker/core/motions/turning.hpp"

namespace aisle::obstacle_tracker {
namespace {

/// The motions that are mixed.
enum Mode : std::size_t { kStands, kStraight, kTurns, kModes };

using Weights = std::array<double, kModes>;

/// The belief of each mode of (x, y, vx, vy, w); only in kTurns the last has a meaning.
using Beliefs = std::array<Gaussian<5>, kModes>;

/// Mean and covariance of a weighted sum of Gaussians (11.6.6-8, 11.6.6-9):
///   x = sum w_i x_i,  P = sum w_i (P_i + (x_i - x)(x_i - x)')
Gaussian<4> moments_of(const Beliefs& beliefs, const Weights& weights) {
  Gaussian<4> mixed;
  for (std::size_t i = 0; i < kModes; ++i) mixed.mean += weights[i] * beliefs[i].mean.head<4>();

  for (std::size_t i = 0; i < kModes; ++i) {
    const Eigen::Vector4d off = beliefs[i].mean.head<4>() - mixed.mean;
    mixed.covariance += weights[i] * (beliefs[i].covariance.topLeftCorner<4, 4>() + off * off.transpose());
  }

  return mixed;
}

/// One belief and one probability a mode. Before each move they are mixed; after each measurement the modes that
/// expected it gain probability.
class InteractingMix final : public MotionFilter {
 public:
  InteractingMix(const MotionModel& motion, const Gaussian<4>& first) : MotionFilter(first), motion_(motion) {
    for (Gaussian<5>& mode : modes_) {
      mode.mean.head<4>() = first.mean;
      mode.covariance.topLeftCorner<4, 4>() = first.covariance;
      mode.covariance(kTurnRate, kTurnRate) = motion.first_turn_sigma_radps * motion.first_turn_sigma_radps;
    }

    probability_ = {1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0};
  }

 private:
  /// Probability that a mode is another one dt_s later: a chain that leaves a mode after mode_s on average, for either
  /// of the others.
  double change(double dt_s) const { return (1.0 - std::exp(-1.5 * dt_s / motion_.mode_s)) / 3.0; }

  /// Mixing: before the modes move, each starts from the mixture of all of them, weighted by how probable it is that
  /// the thing was in mode i if it is in mode j now (11.6.6).
  void interact(double dt_s) {
    const double other = change(dt_s);
    const Beliefs before = modes_;

    Weights later{};
    for (std::size_t j = 0; j < kModes; ++j) {
      Weights from{};

      // p(i -> j) p_i, and their sum over i: the probability of mode j now.
      for (std::size_t i = 0; i < kModes; ++i) {
        from[i] = (i == j ? 1.0 - 2.0 * other : other) * probability_[i];
        later[j] += from[i];
      }

      for (double& part : from) part /= later[j];

      // Only kTurns has a turn rate of its own; its correlation with the rest shrinks by the share of the others.
      const Gaussian<4> mixed = moments_of(before, from);
      modes_[j].mean.head<4>() = mixed.mean;
      modes_[j].covariance.topLeftCorner<4, 4>() = mixed.covariance;

      modes_[j].covariance.block<4, 1>(0, kTurnRate) *= from[j];
      modes_[j].covariance.block<1, 4>(kTurnRate, 0) *= from[j];
    }

    probability_ = later;
  }

  void move(double dt_s) override {
    interact(dt_s);
    stay(modes_[kStands], dt_s);

    // The straight motion knows no turn rate: it moves the first four numbers.
    Gaussian<4> straight{modes_[kStraight].mean.head<4>(), modes_[kStraight].covariance.topLeftCorner<4, 4>()};
    move_straight(straight, motion_.acceleration_density, dt_s);
    modes_[kStraight].mean.head<4>() = straight.mean;
    modes_[kStraight].covariance.topLeftCorner<4, 4>() = straight.covariance;

    move_turning(modes_[kTurns], motion_.acceleration_density, motion_.turn_density, dt_s);
  }

  void rest(double dt_s) override {
    for (Gaussian<5>& mode : modes_) stay(mode, dt_s);
  }

  void observe(const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance, double lag_s) override {
    // Each mode's probability is multiplied by the likelihood that it gave the measurement (11.6.6). In logarithms,
    // from the greatest one, so that nothing underflows.
    constexpr double kLeast = 1e-4;  // a mode never dies out: it may be needed again
    Weights log_weight{};
    for (std::size_t j = 0; j < kModes; ++j) {
      log_weight[j] = std::log(probability_[j]) + take_in(modes_[j], position, covariance, lag_s).log_likelihood();
    }

    const double most = *std::max_element(log_weight.begin(), log_weight.end());
    double sum = 0.0;
    for (std::size_t j = 0; j < kModes; ++j) {
      probability_[j] = std::max(kLeast, std::exp(log_weight[j] - most));
      sum += probability_[j];
    }

    for (double& part : probability_) part /= sum;
  }

  void doubt(double speed_sigma_mps) override {
    doubt_velocity(modes_[kStraight], speed_sigma_mps);
    doubt_velocity(modes_[kTurns], speed_sigma_mps);
  }

  Gaussian<4> summary() const override { return moments_of(modes_, probability_); }

  MotionModel motion_;
  Beliefs modes_;
  Weights probability_{};
};

}  // namespace

Filter interacting_mix() {
  return {"interacting-mix",
          "stands, keeps its velocity, or keeps its turn rate: all three at once, by their probability",
          [](const MotionModel& motion, const Gaussian<4>& first) -> std::unique_ptr<MotionFilter> {
            return std::make_unique<InteractingMix>(motion, first);
          }};
}

}  // namespace aisle::obstacle_tracker
