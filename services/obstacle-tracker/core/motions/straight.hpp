#pragma once

#include "services/obstacle-tracker/core/motions/gaussian.hpp"

namespace aisle::obstacle_tracker {

/// Covariance that white noise in the acceleration of density `q` (m^2/s^3 an axis) adds to (x, y, vx, vy) within dt_s:
/// the continuous-time model of Bar-Shalom, Li, Kirubarajan, "Estimation with Applications to Tracking and Navigation",
/// 2001, (6.2.2-4).
Eigen::Matrix4d acceleration_noise(double q, double dt_s);

/// Carries the state of a thing that keeps its velocity, but for such noise, on by dt_s (6.2.2-3). @pre dt_s >= 0
void move_straight(Gaussian<4>& belief, double q, double dt_s);

}  // namespace aisle::obstacle_tracker
