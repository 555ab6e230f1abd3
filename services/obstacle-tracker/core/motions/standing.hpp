#pragma once

#include "services/obstacle-tracker/core/motions/gaussian.hpp"

namespace aisle::obstacle_tracker {

/// Carries the state of a thing that stands on by dt_s: its position stays, with a little doubt added, and its velocity
/// is 0 give or take 0.1 m/s, independent of the rest. What the state holds behind the velocity stays as it is.
/// @pre dt_s >= 0
template <int N>
void stay(Gaussian<N>& belief, double dt_s) {
  constexpr double kDrift = 1e-4;  // m^2/s
  constexpr double kSpeedSigmaMps = 0.1;

  belief.mean.template segment<2>(2).setZero();
  belief.covariance.template middleRows<2>(2).setZero();
  belief.covariance.template middleCols<2>(2).setZero();
  belief.covariance.template block<2, 2>(0, 0) += Eigen::Matrix2d::Identity() * kDrift * dt_s;
  belief.covariance.template block<2, 2>(2, 2) = Eigen::Matrix2d::Identity() * kSpeedSigmaMps * kSpeedSigmaMps;
}

}  // namespace aisle::obstacle_tracker
