#pragma once

#include <Eigen/Dense>
#include <cmath>

namespace aisle::obstacle_tracker {

/// A normal distribution of a state (x, y, vx, vy) in map, and whatever a motion adds behind; metres, seconds.
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

  /// Logarithm of the probability density of the residual r: -(r' S^-1 r + ln det S) / 2 - ln(2 pi), in 2 dimensions.
  double log_likelihood() const {
    constexpr double kLogTwoPi = 1.8378770664093453;
    return -0.5 * (distance2 + std::log(covariance.determinant())) - kLogTwoPi;
  }
};

/// The measurement matrix H of a position measured `lag_s` before the state's moment: z = (x - lag vx, y - lag vy),
/// where the thing was then if it kept its velocity.
template <int N>
Eigen::Matrix<double, 2, N> seen_before(double lag_s) {
  Eigen::Matrix<double, 2, N> h = Eigen::Matrix<double, 2, N>::Zero();
  h(0, 0) = h(1, 1) = 1.0;
  h(0, 2) = h(1, 3) = -lag_s;

  return h;
}

/// Residual r = z - H x and its covariance S = H P H' + R (Bar-Shalom, Li, Kirubarajan, "Estimation with Applications
/// to Tracking and Navigation", 2001, 5.2.3). `position`: z in map; `covariance`: its R, m^2.
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

/// Takes the measurement in, and returns its innovation:
///   K = P H' S^-1,  x += K r,  P = (I - K H) P (I - K H)' + K R K'
/// The last is the Joseph form, by which the covariance stays symmetric and positive (same book, 5.2.3).
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

/// Adds doubt to the velocity: speed_sigma_mps^2 to each axis of its covariance.
template <int N>
void doubt_velocity(Gaussian<N>& belief, double speed_sigma_mps) {
  belief.covariance(2, 2) += speed_sigma_mps * speed_sigma_mps;
  belief.covariance(3, 3) += speed_sigma_mps * speed_sigma_mps;
}

}  // namespace aisle::obstacle_tracker
