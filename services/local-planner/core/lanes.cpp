#include "services/local-planner/core/lanes.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry/bearings.hpp"
#include "common/grid/clearance_lanes.hpp"

namespace aisle::local_planner {

using geometry::Point2;
using geometry::Pose2;
using geometry::Twist2;
using geometry::is_any;
using geometry::kWide;
using geometry::load;
using geometry::store;
using geometry::Wide;
using geometry::WideMarks;

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

AISLE_WIDE_VECTORS void Lanes::find_yaws_rad(Lane& yaw_rad) const {
  for (std::size_t first = 0; first < kLanes; first += kWide) {
    Wide s, c, bearing_rad;
    load(&sin_yaw[first], s);
    load(&cos_yaw[first], c);
    geometry::find_bearing_rad(s, c, bearing_rad);
    store(bearing_rad, &yaw_rad[first]);
  }
}

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

Outlines::Outlines(const Scene& scene) : scene_(scene), is_disc_(scene.discs_ahead_m.size() == 1 && scene.discs_ahead_m.front() == 0.0) {}

void Outlines::follow(const Lanes& lanes) {
  lanes_ = &lanes;
  is_placed_ = false;
}

AISLE_WIDE_VECTORS void Outlines::place() {
  is_placed_ = true;
  if (is_disc_) {
    x_[0] = lanes_->x.data();
    y_[0] = lanes_->y.data();
    return;
  }
  for (std::size_t disc = 0; disc < count(); ++disc) {
    const double ahead_m = scene_.discs_ahead_m[disc];
    for (std::size_t i = 0; i < kLanes; ++i)
      off_x_[disc][i] = lanes_->x[i] + ahead_m * lanes_->cos_yaw[i], off_y_[disc][i] = lanes_->y[i] + ahead_m * lanes_->sin_yaw[i];
    x_[disc] = off_x_[disc].data();
    y_[disc] = off_y_[disc].data();
  }
}

AISLE_WIDE_VECTORS void Outlines::distances2_to(Point2 p, Lane& squared) {
  if (!is_placed_) place();
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double x = x_[0][i] - p.x;
    const double y = y_[0][i] - p.y;
    squared[i] = x * x + y * y;
  }
  for (std::size_t disc = 1; disc < count(); ++disc)
    for (std::size_t i = 0; i < kLanes; ++i) {
      const double x = x_[disc][i] - p.x;
      const double y = y_[disc][i] - p.y;
      squared[i] = least(squared[i], x * x + y * y);
    }
}

namespace {

constexpr double kFarM = 1e9;

}  // namespace

WallWatch::WallWatch(const Outlines& outlines, double enough_m) : radius_m_(outlines.radius_m()), enough_m_(enough_m) {
  driven_m_.fill(0.0);
  enough_until_m_.fill(-kFarM);
  least_m_.fill(enough_m);
  for (std::size_t disc = 0; disc < outlines.count(); ++disc) far_until_m_[disc].fill(-kFarM);
}

void WallWatch::leave(std::size_t lane) { enough_until_m_[lane] = kFarM; }

bool WallWatch::look(const Outlines& outlines, const Lane& driven_m) {
  if (!drive_on(driven_m)) return false;
  list_unknown();
  return look_at_unknown(outlines);
}

/// Returns whether a lane has no longer surely enough.
AISLE_WIDE_VECTORS bool WallWatch::drive_on(const Lane& driven_m) {
  WideMarks is_unknown{};
  for (std::size_t first = 0; first < kLanes; first += kWide) {
    Wide so_far_m, step_m, until_m;
    load(&driven_m_[first], so_far_m);
    load(&driven_m[first], step_m);
    load(&enough_until_m_[first], until_m);
    so_far_m += step_m;
    store(so_far_m, &driven_m_[first]);
    is_unknown |= so_far_m > until_m;
  }
  return is_any(is_unknown);
}

AISLE_WIDE_VECTORS void WallWatch::list_unknown() {
  unknown_count_ = 0;
  for (std::size_t first = 0; first < kLanes; first += kWide) {
    Wide so_far_m, until_m;
    load(&driven_m_[first], so_far_m);
    load(&enough_until_m_[first], until_m);
    unknown_[unknown_count_] = first;       // without a branch, which nobody could predict
    unknown_count_ += is_any(so_far_m > until_m) ? 1 : 0;
  }
}

/// Looks up the discs that may be near, of unknown lanes and, since it costs nothing, of their neighbours. Returns whether some gap is
/// less than enough.
AISLE_WIDE_VECTORS bool WallWatch::look_at_unknown(const Outlines& outlines) {
  const grid::ClearanceLanes clearance(outlines.clearance());
  const std::size_t discs = outlines.count();
  WideMarks is_near{};
  for (std::size_t k = 0; k < unknown_count_; ++k) {
    const std::size_t first = unknown_[k];
    Wide driven_m, enough_until_m, least_m, nearest_until_m = Wide{} + kFarM;
    load(&driven_m_[first], driven_m);
    load(&enough_until_m_[first], enough_until_m);
    load(&least_m_[first], least_m);
    const WideMarks is_asked = enough_until_m < kFarM;
    for (std::size_t disc = 0; disc < discs; ++disc) {
      Wide x, y, found_m, far_until_m;
      load(&far_until_m_[disc][first], far_until_m);
      if (is_any(is_asked & (driven_m > far_until_m))) {
        outlines.find_centers(disc, first, x, y);
        clearance.find_m(x, y, is_asked, found_m);
        const Wide gap_m = found_m - radius_m_;
        is_near |= is_asked & (gap_m < enough_m_);
        least_m = is_asked & (gap_m < least_m) ? gap_m : least_m;
        far_until_m = driven_m + (gap_m - enough_m_);
        store(far_until_m, &far_until_m_[disc][first]);
      }
      nearest_until_m = far_until_m < nearest_until_m ? far_until_m : nearest_until_m;
    }
    store(least_m, &least_m_[first]);
    store(is_asked ? nearest_until_m : enough_until_m, &enough_until_m_[first]);
  }
  return is_any(is_near);
}

}  // namespace aisle::local_planner
