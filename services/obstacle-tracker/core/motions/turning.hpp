#pragma once

#include "services/obstacle-tracker/core/motions/gaussian.hpp"

namespace aisle::obstacle_tracker {

/// The last of (x, y, vx, vy, w): turn rate in rad/s, counter-clockwise.
inline constexpr int kTurnRate = 4;

/// Where (x, y, vx, vy, w) is dt_s later on its circle: the coordinated turn, Bar-Shalom, Li, Kirubarajan, "Estimation
/// with Applications to Tracking and Navigation", 2001, (11.7.1-4). A turn rate of 0 goes straight.
Eigen::Matrix<double, 5, 1> on_circle(const Eigen::Matrix<double, 5, 1>& state, double dt_s);

/// The derivative of on_circle() by the state (11.7.2-4), for the covariance.
Eigen::Matrix<double, 5, 5> jacobian_of_circle(const Eigen::Matrix<double, 5, 1>& state, double dt_s);

/// Carries the state of a thing that keeps its speed and its turn rate on by dt_s: an extended Kalman filter, of first
/// order in the covariance. White noise of density `q` (m^2/s^3 an axis) is in the acceleration, and of `turn_q`
/// (rad^2/s^3) in the turn rate's change. @pre dt_s >= 0
void move_turning(Gaussian<5>& belief, double q, double turn_q, double dt_s);

}  // namespace aisle::obstacle_tracker
