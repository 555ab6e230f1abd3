#pragma once
#include <Eigen/Dense>
#include <cmath>

namespace aisle::obstacle_tracker {

/// What is believed of a state: (x, y, vx, vy) in map, and whatever a motion adds behind; metres, seconds.
template <int N>
struct Gaussian {
  Eigen::Matrix<double, N, 1> mean{Eigen::Matrix<double, N, 1>::Zero()};
  Eigen::Matrix<double, N, N> covariance{Eigen::Matrix<double, N, N>::Zero()};
};

/// What a measured position would change.
struct Innovation {
  Eigen::Vector2d residual;
  Eigen::Matrix2d covariance;
  double distance2{0.0};  // squared Mahalanobis distance, chi-squared with 2 degrees of freedom

  /// Logarithm of the probability density of the residual.
  double log_likelihood() const {
    constexpr double kLogTwoPi = 1.8378770664093453;
    return -0.5 * (distance2 + std::log(covariance.determinant())) - kLogTwoPi;
  }
};

/// The state's moment is `lag_s` after the measurement's: the thing was where it is, less its way since.
template <int N>
Eigen::Matrix<double, 2, N> seen_before(double lag_s) {
  Eigen::Matrix<double, 2, N> h = Eigen::Matrix<double, 2, N>::Zero();
  h(0, 0) = h(1, 1) = 1.0;
  h(0, 2) = h(1, 3) = -lag_s;
  return h;
}

template <int N>
Innovation innovation_of(const Gaussian<N>& belief, const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance,
                         double lag_s) {
  const Eigen::Matrix<double, 2, N> h = seen_before<N>(lag_s);
  Innovation innovation;
  innovation.residual = position - h * belief.mean;
  innovation.covariance = h * belief.covariance * h.transpose() + covariance;
  innovation.distance2 = innovation.residual.dot(innovation.covariance.inverse() * innovation.residual);
  return innovation;
}

/// Takes the measurement in (Joseph form: the covariance stays symmetric and positive). Returns what it changed.
template <int N>
Innovation take_in(Gaussian<N>& belief, const Eigen::Vector2d& position, const Eigen::Matrix2d& covariance,
                   double lag_s) {
  using Square = Eigen::Matrix<double, N, N>;
  const Eigen::Matrix<double, 2, N> h = seen_before<N>(lag_s);
  const Innovation innovation = innovation_of(belief, position, covariance, lag_s);
  const Eigen::Matrix<double, N, 2> gain = belief.covariance * h.transpose() * innovation.covariance.inverse();
  belief.mean += gain * innovation.residual;
  const Square rest = Square::Identity() - gain * h;
  const Square joseph = rest * belief.covariance * rest.transpose() + gain * covariance * gain.transpose();
  belief.covariance = 0.5 * (joseph + joseph.transpose());
  return innovation;
}

/// Adds doubt to the velocity.
template <int N>
void doubt_velocity(Gaussian<N>& belief, double speed_sigma_mps) {
  belief.covariance(2, 2) += speed_sigma_mps * speed_sigma_mps;
  belief.covariance(3, 3) += speed_sigma_mps * speed_sigma_mps;
}

}  // namespace aisle::obstacle_tracker
