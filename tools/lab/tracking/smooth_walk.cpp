#include "tools/lab/tracking/smooth_walk.hpp"

#include <algorithm>
#include <cstddef>

namespace aisle::tracking {

using geometry::Point2;

/// The knots of the spline: smoothed places and their velocities.
SmoothWalk::SmoothWalk(const std::vector<fake_world::RecordedPerson::Row>& rows, double hurry) {
  for (const fake_world::RecordedPerson::Row& row : rows) {
    const double t_s = row.t_s / hurry;
    if (knots_.empty() || t_s > knots_.back().t_s) knots_.push_back({t_s, row.in_map, {}});
  }

  // Mean velocity from knot a to knot b.
  const auto mean_velocity = [this](std::size_t a, std::size_t b) {
    return (1.0 / (knots_[b].t_s - knots_[a].t_s)) * (knots_[b].in_map - knots_[a].in_map);
  };

  const std::size_t n = knots_.size();
  std::vector<Point2> smoothed;

  for (const Knot& knot : knots_) smoothed.push_back(knot.in_map);

  for (std::size_t i = 0; i < n && n > 1; ++i) {
    if (i == 0 || i == n - 1) {
      knots_[i].velocity_in_map = i == 0 ? mean_velocity(0, 1) : mean_velocity(n - 2, n - 1);
      continue;
    }

    // Velocity: the parabola through the three rows; for even rows the central difference (p[i+1] - p[i-1]) / 2h.
    // Place: two thirds of the row and one third of the line between its neighbours, (p[i-1] + 4 p[i] + p[i+1]) / 6.
    const double before_s = knots_[i].t_s - knots_[i - 1].t_s;
    const double after_s = knots_[i + 1].t_s - knots_[i].t_s;

    knots_[i].velocity_in_map =
        (1.0 / (before_s + after_s)) * (after_s * mean_velocity(i - 1, i) + before_s * mean_velocity(i, i + 1));

    const Point2 between = knots_[i - 1].in_map + before_s * mean_velocity(i - 1, i + 1);
    smoothed[i] = knots_[i].in_map + (1.0 / 3.0) * (between - knots_[i].in_map);
  }

  for (std::size_t i = 0; i < n; ++i) knots_[i].in_map = smoothed[i];
}

/// The cubic between the two knots around the moment.
std::optional<fake_world::Motion> SmoothWalk::at(double t_s) const {
  if (t_s < knots_.front().t_s || t_s > knots_.back().t_s) return std::nullopt;

  const auto later =
      std::upper_bound(knots_.begin(), knots_.end(), t_s, [](double t, const Knot& knot) { return t < knot.t_s; });
  if (later == knots_.end()) return fake_world::Motion{knots_.back().in_map, knots_.back().velocity_in_map};

  // Hermite cubic between knots a and b: p(u) = p_a + u h v_a + u^2 curve + u^3 bend, u in [0, 1].
  const Knot& b = *later;
  const Knot& a = *(later - 1);
  const double h = b.t_s - a.t_s;
  const double u = (t_s - a.t_s) / h;
  const Point2 step = b.in_map - a.in_map;
  const Point2 bend = h * (a.velocity_in_map + b.velocity_in_map) - 2.0 * step;  // of u^3
  const Point2 curve = step - h * a.velocity_in_map - bend;                      // of u^2

  return fake_world::Motion{a.in_map + u * h * a.velocity_in_map + u * u * curve + u * u * u * bend,
                            a.velocity_in_map + (2.0 * u / h) * curve + (3.0 * u * u / h) * bend};
}

}  // namespace aisle::tracking
