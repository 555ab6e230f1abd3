#include "services/obstacle-tracker/core/motions/turning.hpp"

#include "services/obstacle-tracker/core/motions/straight.hpp"

namespace aisle::obstacle_tracker {
namespace {

/// The circle's coefficients and their derivatives by w, for a turn by w x t.
struct Arc {
  double ahead;  // sin(w t) / w
  double aside;  // (1 - cos(w t)) / w
  double ahead_by_rate;
  double aside_by_rate;
};

Arc arc_of(double w, double t) {
  // Nearer to 0 the quotients lose digits; there the first two terms of their series are exact to 1e-12.
  constexpr double kStraight_rad = 1e-3;

  const double turn = w * t;
  if (std::abs(turn) < kStraight_rad) {
    return {t * (1.0 - turn * turn / 6.0), 0.5 * turn * t, -turn * t * t / 3.0,
            0.5 * t * t * (1.0 - turn * turn / 4.0)};
  }

  const double s = std::sin(turn);
  const double c = std::cos(turn);
  return {s / w, (1.0 - c) / w, (turn * c - s) / (w * w), (turn * s - (1.0 - c)) / (w * w)};
}

}  // namespace

Eigen::Matrix<double, 5, 1> on_circle(const Eigen::Matrix<double, 5, 1>& state, double dt_s) {
  const double vx = state(2);
  const double vy = state(3);
  const double w = state(kTurnRate);

  // A turn by w t: (x, y) += (sin(w t)/w vx - (1 - cos(w t))/w vy, (1 - cos(w t))/w vx + sin(w t)/w vy), and the
  // velocity turns by w t; w stays.
  const Arc arc = arc_of(w, dt_s);
  const double s = std::sin(w * dt_s);
  const double c = std::cos(w * dt_s);

  Eigen::Matrix<double, 5, 1> later;
  later << state(0) + arc.ahead * vx - arc.aside * vy, state(1) + arc.aside * vx + arc.ahead * vy, c * vx - s * vy,
      s * vx + c * vy, w;

  return later;
}

Eigen::Matrix<double, 5, 5> jacobian_of_circle(const Eigen::Matrix<double, 5, 1>& state, double dt_s) {
  const double vx = state(2);
  const double vy = state(3);
  const double w = state(kTurnRate);

  // Columns of vx and vy are the coefficients of on_circle(); the column of w holds their derivatives by w.
  const Arc arc = arc_of(w, dt_s);
  const double s = std::sin(w * dt_s);
  const double c = std::cos(w * dt_s);

  Eigen::Matrix<double, 5, 5> f = Eigen::Matrix<double, 5, 5>::Identity();
  f.block<2, 2>(0, 2) << arc.ahead, -arc.aside, arc.aside, arc.ahead;
  f.block<2, 2>(2, 2) << c, -s, s, c;
  f.block<4, 1>(0, kTurnRate) << arc.ahead_by_rate * vx - arc.aside_by_rate * vy,
      arc.aside_by_rate * vx + arc.ahead_by_rate * vy, -dt_s * (s * vx + c * vy), dt_s * (c * vx - s * vy);

  return f;
}

void move_turning(Gaussian<5>& belief, double q, double turn_q, double dt_s) {
  // P' = F P F' + Q, with F taken at the state before the move.
  const Eigen::Matrix<double, 5, 5> f = jacobian_of_circle(belief.mean, dt_s);

  belief.mean = on_circle(belief.mean, dt_s);
  belief.covariance = f * belief.covariance * f.transpose();

  belief.covariance.topLeftCorner<4, 4>() += acceleration_noise(q, dt_s);
  belief.covariance(kTurnRate, kTurnRate) += turn_q * dt_s;
}

}  // namespace aisle::obstacle_tracker
