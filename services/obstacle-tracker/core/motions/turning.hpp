#pragma once
#include "services/obstacle-tracker/core/motions/gaussian.hpp"

namespace aisle::obstacle_tracker {

/// The last of (x, y, vx, vy, w): turn rate in rad/s, counter-clockwise.
inline constexpr int kTurnRate = 4;

/// Where (x, y, vx, vy, w) is dt_s later on its circle: the coordinated turn, Bar-Shalom, Li, Kirubarajan, "Estimation
/// with Applications to Tracking and Navigation", 2001, (11.7.1-4). A turn rate of 0 goes straight.
Eigen::Matrix<double, 5, 1> on_circle(const Eigen::Matrix<double, 5, 1>& state, double dt_s);

/// Its derivative by the state there (11.7.2-4).
Eigen::Matrix<double, 5, 5> jacobian_of_circle(const Eigen::Matrix<double, 5, 1>& state, double dt_s);

/// Carries a state on along its circle, to first order of the covariance (extended Kalman filter), but for white noise
/// of density `q` (m^2/s^3 an axis) in the acceleration and `turn_q` (rad^2/s^3) in the turn rate's change. @pre dt_s
/// >= 0
void move_turning(Gaussian<5>& belief, double q, double turn_q, double dt_s);

}  // namespace aisle::obstacle_tracker
