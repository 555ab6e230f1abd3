#include "services/local-planner/core/lanes.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::local_planner {

using geometry::Point2;
using geometry::Pose2;
using geometry::Twist2;

double speed_of(const Twist2& twist) {
  return twist.sideways_mps == 0.0 ? std::abs(twist.linear_mps) : std::hypot(twist.linear_mps, twist.sideways_mps);
}

double swing_m(const Scene& scene) {
  double most = 0.0;
  for (const double ahead_m : scene.discs_ahead_m) most = std::max(most, std::abs(ahead_m));
  return most;
}

Lanes::Lanes(const Pose2& base_in_map) {
  x.fill(base_in_map.x);
  y.fill(base_in_map.y);
  cos_yaw.fill(std::cos(base_in_map.yaw));
  sin_yaw.fill(std::sin(base_in_map.yaw));
}

void Lanes::set_steps(const Lane& linear_mps, const Lane& angular_radps, const Lane& sideways_mps, double dt_s) {
  constexpr double kSeriesRad = 0.15;       // up to here the series are right to 1e-11
  int turns_far = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double half = 0.5 * angular_radps[i] * dt_s;
    const double h2 = half * half;
    cos_half[i] = 1.0 - 0.5 * h2 + h2 * h2 / 24.0;
    sin_half[i] = half * (1.0 - h2 / 6.0 + h2 * h2 / 120.0);
    ahead_m[i] = linear_mps[i] * dt_s * (1.0 - h2 / 6.0);
    left_m[i] = sideways_mps[i] * dt_s * (1.0 - h2 / 6.0);
    turns_far += std::abs(half) >= kSeriesRad ? 1 : 0;
  }
  if (turns_far == 0) return;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double half = 0.5 * angular_radps[i] * dt_s;
    if (std::abs(half) >= kSeriesRad) cos_half[i] = std::cos(half), sin_half[i] = std::sin(half);
  }
}

/// Along the arc's chord, which points half the turn to the side.
void Lanes::step() {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double c = cos_half[i] * cos_yaw[i] - sin_half[i] * sin_yaw[i];
    const double s = sin_half[i] * cos_yaw[i] + cos_half[i] * sin_yaw[i];
    x[i] = x[i] + ahead_m[i] * c - left_m[i] * s;
    y[i] = y[i] + ahead_m[i] * s + left_m[i] * c;
    cos_yaw[i] = cos_half[i] * c - sin_half[i] * s;
    sin_yaw[i] = sin_half[i] * c + cos_half[i] * s;
  }
}

Pose2 Lanes::pose(std::size_t i) const { return {x[i], y[i], std::atan2(sin_yaw[i], cos_yaw[i])}; }

Box::Box(const Lanes& lanes) {
  constexpr std::size_t kHalf = kLanes / 2;
  std::array<double, kHalf> low_x, high_x, low_y, high_y;
  for (std::size_t i = 0; i < kHalf; ++i) {
    low_x[i] = least(lanes.x[i], lanes.x[i + kHalf]), high_x[i] = most(lanes.x[i], lanes.x[i + kHalf]);
    low_y[i] = least(lanes.y[i], lanes.y[i + kHalf]), high_y[i] = most(lanes.y[i], lanes.y[i + kHalf]);
  }
  for (std::size_t width = kHalf / 2; width > 0; width /= 2)
    for (std::size_t i = 0; i < width; ++i) {
      low_x[i] = least(low_x[i], low_x[i + width]), high_x[i] = most(high_x[i], high_x[i + width]);
      low_y[i] = least(low_y[i], low_y[i + width]), high_y[i] = most(high_y[i], high_y[i + width]);
    }
  low = {low_x[0], low_y[0]};
  high = {high_x[0], high_y[0]};
}

double Box::distance2(Point2 p) const {
  const double x = std::max({0.0, low.x - p.x, p.x - high.x});
  const double y = std::max({0.0, low.y - p.y, p.y - high.y});
  return x * x + y * y;
}

Outlines::Outlines(const Scene& scene)
    : scene_(scene), is_disc_(scene.discs_ahead_m.size() == 1 && scene.discs_ahead_m.front() == 0.0), count_(scene.discs_ahead_m.size()) {}

void Outlines::follow(const Lanes& lanes) {
  if (is_disc_) {
    x_[0] = lanes.x.data();
    y_[0] = lanes.y.data();
    return;
  }
  for (std::size_t disc = 0; disc < count_; ++disc) {
    const double ahead_m = scene_.discs_ahead_m[disc];
    for (std::size_t i = 0; i < kLanes; ++i)
      off_x_[disc][i] = lanes.x[i] + ahead_m * lanes.cos_yaw[i], off_y_[disc][i] = lanes.y[i] + ahead_m * lanes.sin_yaw[i];
    x_[disc] = off_x_[disc].data();
    y_[disc] = off_y_[disc].data();
  }
}

void Outlines::distances2_to(Point2 p, Lane& squared) const {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double x = x_[0][i] - p.x;
    const double y = y_[0][i] - p.y;
    squared[i] = x * x + y * y;
  }
  for (std::size_t disc = 1; disc < count_; ++disc)
    for (std::size_t i = 0; i < kLanes; ++i) {
      const double x = x_[disc][i] - p.x;
      const double y = y_[disc][i] - p.y;
      squared[i] = least(squared[i], x * x + y * y);
    }
}

double Outlines::wall_gap_m(std::size_t lane) const {
  double least = scene_.clearance.clearance_m(Point2{x_[0][lane], y_[0][lane]});
  for (std::size_t disc = 1; disc < count_; ++disc) least = std::min(least, scene_.clearance.clearance_m(Point2{x_[disc][lane], y_[disc][lane]}));
  return least - scene_.radius_m;
}

bool WallWatch::look(const Outlines& outlines, const Lane& driven_m, std::size_t lanes) {
  int unknown = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    known_m_[i] -= driven_m[i];
    unknown += known_m_[i] < enough_m_ ? 1 : 0;
  }
  if (unknown == 0) return false;
  bool is_near = false;
  for (std::size_t i = 0; i < lanes; ++i) {
    if (known_m_[i] >= enough_m_) continue;
    known_m_[i] = outlines.wall_gap_m(i);
    is_near = is_near || known_m_[i] < enough_m_;
  }
  std::fill(known_m_.begin() + static_cast<std::ptrdiff_t>(lanes), known_m_.end(), known_m_[lanes - 1]);
  return is_near;
}

}  // namespace aisle::local_planner
