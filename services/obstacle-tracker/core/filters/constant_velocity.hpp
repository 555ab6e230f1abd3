#pragma once
#include <Eigen/Core>

namespace aisle::obstacle_tracker {

/// A Kalman filter for a point that keeps its velocity, but for white noise in its acceleration (Bar-Shalom, Li, Kirubarajan,
/// "Estimation with Applications to Tracking and Navigation", 2001, 6.2.2). State (x, y, vx, vy) in map; metres, seconds.
class ConstantVelocity {
 public:
  struct Params {
    double acceleration_density{0.10};  // of the white noise, m^2/s^3 an axis
    double first_speed_sigma_mps{0.9};  // of a thing just found, an axis

    template <class Reader>
    void describe(Reader& r) {
      r.field("acceleration_density", acceleration_density, 0.001, 100.0).field("first_speed_sigma_mps", first_speed_sigma_mps, 0.05, 10.0);
    }
  };
  /// What a measurement would change.
  struct Innovation {
    Eigen::Vector2d residual;
    Eigen::Matrix2d covariance;
    double distance2{0.0};  // squared Mahalanobis distance, chi-squared with 2 degrees of freedom
  };

  ConstantVelocity(const Params& params, const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance);

  /// @pre dt_s >= 0
  void predict(double dt_s);
  /// The same for a thing that stands: it stays, and little doubt is added.
  void stand(double dt_s);
  /// Of a position measured `lag_s` before the state's moment: it is compared with where the state says the thing then was.
  Innovation innovation(const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance, double lag_s) const;
  /// Takes the measurement in (Joseph form: the covariance stays symmetric and positive).
  void update(const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance, double lag_s);
  /// The thing turned or started: adds doubt to the velocity, so that the next measurements set it.
  void loosen(double speed_sigma_mps);

  const Eigen::Vector4d& state() const { return state_; }
  const Eigen::Matrix4d& covariance() const { return covariance_; }

 private:
  Params params_;
  Eigen::Vector4d state_;
  Eigen::Matrix4d covariance_;
};

}  // namespace aisle::obstacle_tracker
