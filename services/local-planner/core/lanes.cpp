#include "services/local-planner/core/lanes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

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

void Outlines::clearances_of_pairs_m(const std::size_t* pairs, Lane& found_m) const {
  Lane x, y;
  for (std::size_t i = 0; i < kLanes; ++i) {
    x[i] = x_[pairs[i] / kLanes][pairs[i] % kLanes];
    y[i] = y_[pairs[i] / kLanes][pairs[i] % kLanes];
  }
  grid::clearances_m(scene_.clearance, x.data(), y.data(), found_m);
}

namespace {

constexpr double kFarM = 1e9;

AISLE_WIDE_VECTORS void lower(Lane& bound_m, const Lane& driven_m) {
  for (std::size_t i = 0; i < kLanes; ++i) bound_m[i] -= driven_m[i];
}

/// Returns how many are less than `enough_m` then.
AISLE_WIDE_VECTORS int lower(Lane& known_m, const Lane& driven_m, double enough_m) {
  int unknown = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    known_m[i] -= driven_m[i];
    unknown += known_m[i] < enough_m ? 1 : 0;
  }
  return unknown;
}

/// Marks the lanes that are unknown and whose disc may be near with 1. Returns how many.
AISLE_WIDE_VECTORS int mark(const Lane& known_m, double enough_m, const Lane& bound_m, double near_m, std::array<std::uint64_t, kLanes>& marks) {
  std::uint64_t count = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    marks[i] = (known_m[i] < enough_m) & (bound_m[i] < near_m) ? 1 : 0;
    count += marks[i];
  }
  return static_cast<int>(count);
}

AISLE_WIDE_VECTORS void lower_to(Lane& least_m, const Lane& values_m) {
  for (std::size_t i = 0; i < kLanes; ++i) least_m[i] = least(least_m[i], values_m[i]);
}

/// Learns the gaps that were unknown. Returns how many are less than enough.
AISLE_WIDE_VECTORS int learn(Lane& known_m, const Lane& clearances_m, double radius_m, double enough_m) {
  int near = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    known_m[i] = known_m[i] < enough_m ? clearances_m[i] - radius_m : known_m[i];
    near += known_m[i] < enough_m ? 1 : 0;
  }
  return near;
}

}  // namespace

WallWatch::WallWatch(double enough_m) : enough_m_(enough_m) {
  known_m_.fill(-kFarM);
  for (Lane& bound_m : bound_m_) bound_m.fill(-kFarM);
}

void WallWatch::leave(std::size_t lane) { known_m_[lane] = kFarM; }

bool WallWatch::look(const Outlines& outlines, const Lane& driven_m) {
  const int unknown = lower(known_m_, driven_m, enough_m_);
  for (std::size_t disc = 0; outlines.count() > 1 && disc < outlines.count(); ++disc) lower(bound_m_[disc], driven_m);
  if (unknown == 0) return false;
  return outlines.count() == 1 ? look_at_disc(outlines, unknown) : look_at_discs(outlines);
}

constexpr int kFew = 10;                    // are quicker looked up one by one

bool WallWatch::look_at_disc(const Outlines& outlines, int unknown) {
  Lane found_m = known_m_;
  if (unknown > kFew) {
    outlines.clearances_m(0, found_m);
  } else {
    for (std::size_t i = 0; i < kLanes; ++i)
      if (known_m_[i] < enough_m_) found_m[i] = outlines.clearance_m(0, i);
  }
  return learn(known_m_, found_m, outlines.radius_m(), enough_m_) > 0;
}

/// Learns the clearances of those discs of unknown lanes that may be near, in full vectors.
bool WallWatch::look_at_discs(const Outlines& outlines) {
  // Between centres a clearance may be understated by as much: the mean way to the corners, and what interpolation takes off.
  constexpr double kUnderstatedCells = 0.83;
  const double near_m = enough_m_ + outlines.radius_m() + kUnderstatedCells * outlines.cell_m();
  std::array<std::size_t, (kMostDiscs + 1) * kLanes> wanted;
  std::array<std::uint64_t, kLanes> marks;
  std::size_t count = 0;
  for (std::size_t disc = 0; disc < outlines.count(); ++disc) {
    if (mark(known_m_, enough_m_, bound_m_[disc], near_m, marks) == 0) continue;
    for (std::size_t i = 0; i < kLanes; ++i) {
      wanted[count] = disc * kLanes + i;
      count += marks[i];
    }
  }
  for (std::size_t first = 0; first < count; first += kLanes) {
    const std::size_t some = std::min(kLanes, count - first);
    Lane found_m;
    if (some > static_cast<std::size_t>(kFew)) {
      std::fill_n(wanted.begin() + static_cast<std::ptrdiff_t>(first + some), kLanes - some, wanted[first]);
      outlines.clearances_of_pairs_m(wanted.data() + first, found_m);
    } else {
      for (std::size_t i = 0; i < some; ++i) found_m[i] = outlines.clearance_m(wanted[first + i] / kLanes, wanted[first + i] % kLanes);
    }
    for (std::size_t i = 0; i < some; ++i) bound_m_[wanted[first + i] / kLanes][wanted[first + i] % kLanes] = found_m[i];
  }
  Lane nearest_m = bound_m_[0];
  for (std::size_t disc = 1; disc < outlines.count(); ++disc) lower_to(nearest_m, bound_m_[disc]);
  return learn(known_m_, nearest_m, outlines.radius_m(), enough_m_) > 0;
}

}  // namespace aisle::local_planner
