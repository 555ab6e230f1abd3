// A Kalman filter for a point that keeps its velocity, but for white noise in its acceleration (Bar-Shalom, Li,
// Kirubarajan 2001, 6.2.2).

#include "services/obstacle-tracker/core/motion_filter.hpp"
#include "services/obstacle-tracker/core/motions/standing.hpp"
#include "services/obstacle-tracker/core/motions/straight.hpp"

namespace aisle::obstacle_tracker {
namespace {

/// State (x, y, vx, vy).
class ConstantVelocity final : public MotionFilter {
 public:
  ConstantVelocity(const MotionModel& motion, const Gaussian<4>& first)
      : MotionFilter(first), q_(motion.acceleration_density), walk_(first) {}

 private:
  void move(double dt_s) override { move_straight(walk_, q_, dt_s); }

  void rest(double dt_s) override { stay(walk_, dt_s); }

  void observe(const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance, double lag_s) override {
    take_in(walk_, position, covariance, lag_s);
  }

  void doubt(double speed_sigma_mps) override { doubt_velocity(walk_, speed_sigma_mps); }

  Gaussian<4> summary() const override { return walk_; }

  double q_;
  Gaussian<4> walk_;
};

}  // namespace

Filter constant_velocity() {
  return {"constant-velocity", "keeps its velocity, but for white noise in its acceleration",
          [](const MotionModel& motion, const Gaussian<4>& first) -> std::unique_ptr<MotionFilter> {
            return std::make_unique<ConstantVelocity>(motion, first);
          }};
}

}  // namespace aisle::obstacle_tracker
