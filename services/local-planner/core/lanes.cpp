#include "services/local-planner/core/lanes.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry/wide_vectors.hpp"

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

AISLE_WIDE_VECTORS void Lanes::set_steps(const Lane& linear_mps, const Lane& angular_radps, const Lane& sideways_mps, double dt_s) {
  constexpr double kSeriesRad = 0.15;       // up to here the series are right to 1e-11
  int turns_far = 0, sideways = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double half = 0.5 * angular_radps[i] * dt_s;
    const double h2 = half * half;
    cos_half[i] = 1.0 - 0.5 * h2 + h2 * h2 / 24.0;
    sin_half[i] = half * (1.0 - h2 / 6.0 + h2 * h2 / 120.0);
    ahead_m[i] = linear_mps[i] * dt_s * (1.0 - h2 / 6.0);
    left_m[i] = sideways_mps[i] * dt_s * (1.0 - h2 / 6.0);
    turns_far += std::abs(half) >= kSeriesRad ? 1 : 0;
    sideways += sideways_mps[i] != 0.0 ? 1 : 0;
  }
  goes_sideways_ = sideways > 0;
  if (turns_far == 0) return;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double half = 0.5 * angular_radps[i] * dt_s;
    if (std::abs(half) >= kSeriesRad) cos_half[i] = std::cos(half), sin_half[i] = std::sin(half);
  }
}

/// Along the arc's chord, which points half the turn to the side.
AISLE_WIDE_VECTORS void Lanes::step() {
  if (goes_sideways_) return step_sideways();
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double c = cos_half[i] * cos_yaw[i] - sin_half[i] * sin_yaw[i];
    const double s = sin_half[i] * cos_yaw[i] + cos_half[i] * sin_yaw[i];
    x[i] = x[i] + ahead_m[i] * c;
    y[i] = y[i] + ahead_m[i] * s;
    cos_yaw[i] = cos_half[i] * c - sin_half[i] * s;
    sin_yaw[i] = sin_half[i] * c + cos_half[i] * s;
  }
}

AISLE_WIDE_VECTORS void Lanes::step_sideways() {
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

namespace {

/// Least and greatest of a lane's values.
AISLE_WIDE_VECTORS void find_extremes(const Lane& values, double& low, double& high) {
  constexpr std::size_t kHalf = kLanes / 2;
  std::array<double, kHalf> lows, highs;
  for (std::size_t i = 0; i < kHalf; ++i) lows[i] = least(values[i], values[i + kHalf]), highs[i] = most(values[i], values[i + kHalf]);
  for (std::size_t width = kHalf / 2; width > 0; width /= 2)
    for (std::size_t i = 0; i < width; ++i) lows[i] = least(lows[i], lows[i + width]), highs[i] = most(highs[i], highs[i + width]);
  low = lows[0];
  high = highs[0];
}

}  // namespace

Box::Box(const Lanes& lanes) {
  find_extremes(lanes.x, low.x, high.x);
  find_extremes(lanes.y, low.y, high.y);
}

double Box::distance2(Point2 p) const {
  const double x = std::max({0.0, low.x - p.x, p.x - high.x});
  const double y = std::max({0.0, low.y - p.y, p.y - high.y});
  return x * x + y * y;
}

Outlines::Outlines(const Scene& scene)
    : scene_(scene), is_disc_(scene.discs_ahead_m.size() == 1 && scene.discs_ahead_m.front() == 0.0), count_(scene.discs_ahead_m.size()) {}

AISLE_WIDE_VECTORS void Outlines::follow(const Lanes& lanes) {
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

AISLE_WIDE_VECTORS void Outlines::distances2_to(Point2 p, Lane& squared) const {
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

AISLE_WIDE_VECTORS void Outlines::wall_gaps_m(Lane& gaps_m) const {
  grid::clearances_m(scene_.clearance, x_[0], y_[0], gaps_m);
  Lane of_disc;
  for (std::size_t disc = 1; disc < count_; ++disc) {
    grid::clearances_m(scene_.clearance, x_[disc], y_[disc], of_disc);
    for (std::size_t i = 0; i < kLanes; ++i) gaps_m[i] = least(gaps_m[i], of_disc[i]);
  }
  const double radius_m = scene_.radius_m;
  for (std::size_t i = 0; i < kLanes; ++i) gaps_m[i] -= radius_m;
}

namespace {

/// Takes off what was driven. Returns how many are less than enough then.
AISLE_WIDE_VECTORS int drive(Lane& known_m, const Lane& driven_m, double enough_m) {
  int unknown = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    known_m[i] -= driven_m[i];
    unknown += known_m[i] < enough_m ? 1 : 0;
  }
  return unknown;
}

/// Learns the gaps that were unknown. Returns how many are less than enough.
AISLE_WIDE_VECTORS int learn(Lane& known_m, const Lane& gaps_m, double enough_m) {
  int near = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    known_m[i] = known_m[i] < enough_m ? gaps_m[i] : known_m[i];
    near += known_m[i] < enough_m ? 1 : 0;
  }
  return near;
}

}  // namespace

bool WallWatch::look(const Outlines& outlines, const Lane& driven_m) {
  constexpr int kFew = 6;                   // are quicker looked up one by one
  const int unknown = drive(known_m_, driven_m, enough_m_);
  if (unknown == 0) return false;
  Lane gaps_m = known_m_;
  if (unknown > kFew) {
    outlines.wall_gaps_m(gaps_m);
  } else {
    for (std::size_t i = 0; i < kLanes; ++i)
      if (known_m_[i] < enough_m_) gaps_m[i] = outlines.wall_gap_m(i);
  }
  return learn(known_m_, gaps_m, enough_m_) > 0;
}

}  // namespace aisle::local_planner
