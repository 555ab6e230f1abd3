#include "services/local-planner/core/lanes.hpp"

#include <algorithm>
#include <cmath>

#include "common/geometry/bearings.hpp"
#include "common/grid/clearance_lanes.hpp"

namespace aisle::local_planner {

using geometry::is_any;
using geometry::kWide;
using geometry::load;
using geometry::Point2;
using geometry::Pose2;
using geometry::store;
using geometry::Twist2;
using geometry::Wide;
using geometry::WideMarks;

namespace {

constexpr double kFarM = 1e9;

}  // namespace

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
  cos_chord_.fill(std::cos(base_in_map.yaw));
  sin_chord_.fill(std::sin(base_in_map.yaw));
  cos_half_.fill(1.0);
  sin_half_.fill(0.0);
}

AISLE_WIDE_VECTORS void Lanes::set_steps(const Lane& linear_mps, const Lane& angular_radps, const Lane& sideways_mps,
                                         double dt_s) {
  constexpr double kSeriesRad = 0.15;  // up to here the series are right to 1e-11
  int turns_far = 0, sideways = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double half = 0.5 * angular_radps[i] * dt_s;
    const double h2 = half * half;
    cos_turn_[i] = 1.0 - 0.5 * h2 + h2 * h2 / 24.0;
    sin_turn_[i] = half * (1.0 - h2 / 6.0 + h2 * h2 / 120.0);
    ahead_m_[i] = linear_mps[i] * dt_s * (1.0 - h2 / 6.0);
    left_m_[i] = sideways_mps[i] * dt_s * (1.0 - h2 / 6.0);
    turns_far += std::abs(half) >= kSeriesRad ? 1 : 0;
    sideways += sideways_mps[i] != 0.0 ? 1 : 0;
  }
  goes_sideways_ = sideways > 0;
  for (std::size_t i = 0; turns_far > 0 && i < kLanes; ++i) {
    const double half = 0.5 * angular_radps[i] * dt_s;
    if (std::abs(half) >= kSeriesRad) cos_turn_[i] = std::cos(half), sin_turn_[i] = std::sin(half);
  }
  aim_chords();
}

/// From chords that point half the last step's turn from the heading to such as point half the next one's, of which
/// `turn` holds the half.
AISLE_WIDE_VECTORS void Lanes::aim_chords() {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double cos_yaw = cos_half_[i] * cos_chord_[i] + sin_half_[i] * sin_chord_[i];
    const double sin_yaw = cos_half_[i] * sin_chord_[i] - sin_half_[i] * cos_chord_[i];
    const double c = cos_turn_[i], s = sin_turn_[i];
    cos_chord_[i] = c * cos_yaw - s * sin_yaw;
    sin_chord_[i] = s * cos_yaw + c * sin_yaw;
    cos_half_[i] = c;
    sin_half_[i] = s;
    cos_turn_[i] = c * c - s * s;
    sin_turn_[i] = 2.0 * s * c;
  }
}

AISLE_WIDE_VECTORS void Lanes::step() {
  if (goes_sideways_) return step_sideways();
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double c = cos_chord_[i], s = sin_chord_[i];
    x[i] = x[i] + ahead_m_[i] * c;
    y[i] = y[i] + ahead_m_[i] * s;
    cos_chord_[i] = cos_turn_[i] * c - sin_turn_[i] * s;
    sin_chord_[i] = sin_turn_[i] * c + cos_turn_[i] * s;
  }
}

AISLE_WIDE_VECTORS void Lanes::step_sideways() {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double c = cos_chord_[i], s = sin_chord_[i];
    x[i] = x[i] + ahead_m_[i] * c - left_m_[i] * s;
    y[i] = y[i] + ahead_m_[i] * s + left_m_[i] * c;
    cos_chord_[i] = cos_turn_[i] * c - sin_turn_[i] * s;
    sin_chord_[i] = sin_turn_[i] * c + cos_turn_[i] * s;
  }
}

AISLE_WIDE_VECTORS void Lanes::find_yaws_rad(Lane& yaw_rad) const {
  for (std::size_t first = 0; first < kLanes; first += kWide) {
    Wide s, c, bearing_rad;
    find_headings(first, c, s);
    geometry::find_bearing_rad(s, c, bearing_rad);
    store(bearing_rad, &yaw_rad[first]);
  }
}

namespace {

/// Least and greatest of a lane's values.
AISLE_WIDE_VECTORS void find_extremes(const Lane& values, double& low, double& high) {
  constexpr std::size_t kHalf = kLanes / 2;
  std::array<double, kHalf> lows, highs;
  for (std::size_t i = 0; i < kHalf; ++i)
    lows[i] = least(values[i], values[i + kHalf]), highs[i] = most(values[i], values[i + kHalf]);
  for (std::size_t width = kHalf / 2; width > 0; width /= 2)
    for (std::size_t i = 0; i < width; ++i)
      lows[i] = least(lows[i], lows[i + width]), highs[i] = most(highs[i], highs[i + width]);
  low = lows[0];
  high = highs[0];
}

}  // namespace

Box::Box(const Lanes& lanes) {
  find_extremes(lanes.x, low.x, high.x);
  find_extremes(lanes.y, low.y, high.y);
}

Outlines::Outlines(const Scene& scene)
    : scene_(scene), is_disc_(scene.discs_ahead_m.size() == 1 && scene.discs_ahead_m.front() == 0.0) {}

void Outlines::follow(const Lanes& lanes) {
  lanes_ = &lanes;
  is_turned_ = false;
}

AISLE_WIDE_VECTORS void Outlines::turn() {
  is_turned_ = true;
  for (std::size_t first = 0; first < kLanes; first += kWide) {
    Wide c, s;
    lanes_->find_headings(first, c, s);
    store(c, &cos_yaw_[first]);
    store(s, &sin_yaw_[first]);
  }
}

void Outlines::distances2_to(Point2 p, Lane& squared) {
  if (is_disc_) return find_distances2_of_bases(p, squared);
  if (!is_turned_) turn();
  find_distances2_of_discs(p, squared);
}

AISLE_WIDE_VECTORS void Outlines::find_distances2_of_bases(Point2 p, Lane& squared) const {
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double x = lanes_->x[i] - p.x, y = lanes_->y[i] - p.y;
    squared[i] = x * x + y * y;
  }
}

/// The discs lie on a line: what is left of the way along it, and the way across it.
AISLE_WIDE_VECTORS void Outlines::find_distances2_of_discs(Point2 p, Lane& squared) const {
  for (std::size_t first = 0; first < kLanes; first += kWide) {
    Wide x, y, c, s;
    load(&lanes_->x[first], x);
    load(&lanes_->y[first], y);
    load(&cos_yaw_[first], c);
    load(&sin_yaw_[first], s);
    const Wide east = p.x - x, north = p.y - y;
    const Wide along = c * east + s * north, across = c * north - s * east;
    Wide nearest2 = Wide{} + kFarM * kFarM;
    for (const double ahead_m : scene_.discs_ahead_m) {
      const Wide left = along - ahead_m;
      const Wide left2 = left * left;
      nearest2 = left2 < nearest2 ? left2 : nearest2;
    }
    const Wide distance2 = nearest2 + across * across;
    store(distance2, &squared[first]);
  }
}

WallWatch::WallWatch(const Outlines& outlines, const DiscGaps& gaps_m, double enough_m)
    : radius_m_(outlines.radius_m()), enough_m_(enough_m) {
  driven_m_.fill(0.0);
  enough_until_m_.fill(*std::min_element(gaps_m.begin(), gaps_m.end()) - enough_m);
  least_m_.fill(enough_m);
  for (std::size_t disc = 0; disc < outlines.count(); ++disc) far_until_m_[disc].fill(gaps_m[disc] - enough_m);
}

void WallWatch::leave(std::size_t lane) { enough_until_m_[lane] = kFarM; }

bool WallWatch::look(const Outlines& outlines, const Lane& driven_m) {
  drive_on(driven_m);
  return unknown_count_ > 0 && look_at_unknown(outlines);
}

AISLE_WIDE_VECTORS void WallWatch::drive_on(const Lane& driven_m) {
  unknown_count_ = 0;
  for (std::size_t first = 0; first < kLanes; first += kWide) {
    Wide so_far_m, step_m, until_m;
    load(&driven_m_[first], so_far_m);
    load(&driven_m[first], step_m);
    load(&enough_until_m_[first], until_m);
    so_far_m += step_m;
    store(so_far_m, &driven_m_[first]);
    unknown_[unknown_count_] = first;  // without a branch, which nobody could predict
    unknown_count_ += is_any(so_far_m > until_m) ? 1 : 0;
  }
}

/// Looks up the discs that may be near, of unknown lanes and, since it costs nothing, of their neighbours. Returns
/// whether some gap is less than enough.
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
    const bool is_near_already = is_any(is_asked & (least_m < enough_m_));
    for (std::size_t disc = 0; disc < discs; ++disc) {
      Wide x, y, found_m, far_until_m;
      load(&far_until_m_[disc][first], far_until_m);
      if (is_any(is_asked & (driven_m > far_until_m))) {
        outlines.find_centers(disc, first, x, y);
        if (!is_near_already) clearance.find_at_least_m(x, y, found_m);
        if (is_near_already || is_any(is_asked & (found_m - radius_m_ < least_m)))
          clearance.find_m(x, y, is_asked, found_m);
        const Wide gap_m = found_m - radius_m_;
        is_near |= is_asked & (gap_m < enough_m_);
        least_m = is_asked & (gap_m < least_m) ? gap_m : least_m;
        far_until_m = driven_m + (gap_m - least_m);
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
