#include "services/obstacle-tracker/core/filters/constant_velocity.hpp"

#include <Eigen/Dense>
#include <cmath>

namespace aisle::obstacle_tracker {
namespace {

using Observation = Eigen::Matrix<double, 2, 4>;

Observation seen_before(double lag_s) {
  Observation h = Observation::Zero();
  h(0, 0) = h(1, 1) = 1.0;
  h(0, 2) = h(1, 3) = -lag_s;
  return h;
}

}  // namespace

ConstantVelocity::ConstantVelocity(const Params& params, const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance)
    : params_(params), state_(position.x(), position.y(), 0.0, 0.0), covariance_(Eigen::Matrix4d::Zero()) {
  covariance_.topLeftCorner<2, 2>() = covariance;
  covariance_.bottomRightCorner<2, 2>() = Eigen::Matrix2d::Identity() * params.first_speed_sigma_mps * params.first_speed_sigma_mps;
}

void ConstantVelocity::predict(double dt_s) {
  Eigen::Matrix4d f = Eigen::Matrix4d::Identity();
  f(0, 2) = f(1, 3) = dt_s;
  const double q = params_.acceleration_density;
  Eigen::Matrix4d noise = Eigen::Matrix4d::Zero();
  noise(0, 0) = noise(1, 1) = q * dt_s * dt_s * dt_s / 3.0;
  noise(0, 2) = noise(2, 0) = noise(1, 3) = noise(3, 1) = q * dt_s * dt_s / 2.0;
  noise(2, 2) = noise(3, 3) = q * dt_s;
  state_ = f * state_;
  covariance_ = f * covariance_ * f.transpose() + noise;
}

void ConstantVelocity::stand(double dt_s) {
  constexpr double kDrift = 1e-4;  // m^2/s
  constexpr double kSpeedSigmaMps = 0.1;
  state_.tail<2>().setZero();
  covariance_.topRightCorner<2, 2>().setZero();
  covariance_.bottomLeftCorner<2, 2>().setZero();
  covariance_.topLeftCorner<2, 2>() += Eigen::Matrix2d::Identity() * kDrift * dt_s;
  covariance_.bottomRightCorner<2, 2>() = Eigen::Matrix2d::Identity() * kSpeedSigmaMps * kSpeedSigmaMps;
}

ConstantVelocity::Innovation ConstantVelocity::innovation(const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance,
                                                          double lag_s) const {
  const Observation h = seen_before(lag_s);
  Innovation innovation;
  innovation.residual = position - h * state_;
  innovation.covariance = h * covariance_ * h.transpose() + covariance;
  innovation.distance2 = innovation.residual.dot(innovation.covariance.inverse() * innovation.residual);
  return innovation;
}

void ConstantVelocity::update(const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance, double lag_s) {
  const Observation h = seen_before(lag_s);
  const Eigen::Matrix2d s = h * covariance_ * h.transpose() + covariance;
  const Eigen::Matrix<double, 4, 2> gain = covariance_ * h.transpose() * s.inverse();
  state_ += gain * (position - h * state_);
  const Eigen::Matrix4d rest = Eigen::Matrix4d::Identity() - gain * h;
  const Eigen::Matrix4d joseph = rest * covariance_ * rest.transpose() + gain * covariance * gain.transpose();
  covariance_ = 0.5 * (joseph + joseph.transpose());
}

void ConstantVelocity::loosen(double speed_sigma_mps) {
  covariance_(2, 2) += speed_sigma_mps * speed_sigma_mps;
  covariance_(3, 3) += speed_sigma_mps * speed_sigma_mps;
}

}  // namespace aisle::obstacle_tracker
