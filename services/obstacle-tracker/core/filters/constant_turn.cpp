// An extended Kalman filter for a point that keeps its speed and its turn rate, but for white noise in the acceleration
// and in the turn rate's change: the nearly coordinated turn (Bar-Shalom, Li, Kirubarajan 2001, 11.7). The turn rate is
// estimated with the rest.

#include "services/obstacle-tracker/core/motion_filter.hpp"
#include "services/obstacle-tracker/core/motions/standing.hpp"
#include "services/obstacle-tracker/core/motions/turning.hpp"

namespace aisle::obstacle_tracker {
namespace {

/// State (x, y, vx, vy, w).
class ConstantTurn final : public MotionFilter {
 public:
  ConstantTurn(const MotionModel& motion, const Gaussian<4>& first) : MotionFilter(first), motion_(motion) {
    turn_.mean.head<4>() = first.mean;
    turn_.covariance.topLeftCorner<4, 4>() = first.covariance;
    turn_.covariance(kTurnRate, kTurnRate) = motion.first_turn_sigma_radps * motion.first_turn_sigma_radps;
  }

 private:
  void move(double dt_s) override { move_turning(turn_, motion_.acceleration_density, motion_.turn_density, dt_s); }

  void rest(double dt_s) override { stay(turn_, dt_s); }

  void observe(const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance, double lag_s) override {
    take_in(turn_, position, covariance, lag_s);
  }

  void doubt(double speed_sigma_mps) override { doubt_velocity(turn_, speed_sigma_mps); }

  Gaussian<4> summary() const override { return {turn_.mean.head<4>(), turn_.covariance.topLeftCorner<4, 4>()}; }

  MotionModel motion_;
  Gaussian<5> turn_;
};

}  // namespace

Filter constant_turn() {
  return {"constant-turn", "keeps its speed and its turn rate, but for white noise in both",
          [](const MotionModel& motion, const Gaussian<4>& first) -> std::unique_ptr<MotionFilter> {
            return std::make_unique<ConstantTurn>(motion, first);
          }};
}

}  // namespace aisle::obstacle_tracker
