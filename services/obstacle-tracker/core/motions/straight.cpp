#include "services/obstacle-tracker/core/motions/straight.hpp"

namespace aisle::obstacle_tracker {

Eigen::Matrix4d acceleration_noise(double q, double dt_s) {
  // Q = q [t^3/3  t^2/2; t^2/2  t] an axis, t = dt_s (6.2.2-4).
  Eigen::Matrix4d noise = Eigen::Matrix4d::Zero();
  noise(0, 0) = noise(1, 1) = q * dt_s * dt_s * dt_s / 3.0;
  noise(0, 2) = noise(2, 0) = noise(1, 3) = noise(3, 1) = q * dt_s * dt_s / 2.0;
  noise(2, 2) = noise(3, 3) = q * dt_s;

  return noise;
}

void move_straight(Gaussian<4>& belief, double q, double dt_s) {
  // x' = F x, P' = F P F' + Q with F = [1 t; 0 1] an axis (6.2.2-3).
  Eigen::Matrix4d f = Eigen::Matrix4d::Identity();
  f(0, 2) = f(1, 3) = dt_s;

  belief.mean = f * belief.mean;
  belief.covariance = f * belief.covariance * f.transpose() + acceleration_noise(q, dt_s);
}

}  // namespace aisle::obstacle_tracker
