#include "common/grid/between_centers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace aisle::grid {
namespace {

using Point = BetweenCenters::Point;

/// In cells, from `q` to the segment from `a` to `b`.
double distance_to_piece(Point q, Point a, Point b) {
  return geometry::distance_to_segment({q.s, q.t}, {a.s, a.t}, {b.s, b.t});
}

/// Does the piece from a to b enter s <= 1/2 and t <= 1/2, the quarter of the lower left cell?
///
/// How: clipping (Liang, Barsky 1984). The part of the piece with s <= 1/2 is an interval of its
/// parameter, 0 at a and 1 at b; so is the part with t <= 1/2. The piece enters where both intervals
/// overlap.
bool enters_lower_left(Point a, Point b) {
  double from = 0.0;
  double to = 1.0;

  const auto clip = [&](double begin, double end) {
    const double change = end - begin;
    if (change == 0.0) {
      if (begin > 0.5) to = -1.0;
    } else if (change > 0.0) {
      to = std::min(to, (0.5 - begin) / change);
    } else {
      from = std::max(from, (0.5 - begin) / change);
    }
  };

  clip(a.s, b.s);
  clip(a.t, b.t);

  return from <= to;
}

/// Distance, in cells, to the quarter of the square that belongs to the lower left cell.
double distance_to_lower_left(Point p) {
  const double s = std::max(p.s - 0.5, 0.0);
  const double t = std::max(p.t - 0.5, 0.0);
  return std::sqrt(s * s + t * t);
}

/// Least distance of the piece to that quarter.
double distance_to_lower_left(Point a, Point b) {
  if (enters_lower_left(a, b)) return 0.0;
  return std::min({distance_to_lower_left(a), distance_to_lower_left(b), distance_to_piece({0.5, 0.5}, a, b)});
}

/// Quick: true only when the piece is more than `least` cells away from that quarter, and true for nearly all that are.
/// The quarter then lies left of it, below it, or below its line, which falls to the right and passes the quarter's
/// upper right corner.
bool is_surely_beyond_lower_left(Point a, Point b, double least) {
  if (std::min(a.s, b.s) > 0.5 + least || std::min(a.t, b.t) > 0.5 + least) return true;

  const double ds = b.s - a.s;
  const double dt = b.t - a.t;
  if (ds * dt >= 0.0) return false;

  const double above = std::abs(dt) * (a.s - 0.5) + std::abs(ds) * (a.t - 0.5);  // times the length
  return above > 0.0 && above * above > least * least * (ds * ds + dt * dt);
}

/// The point as seen when the square is turned so that this corner is the lower left one.
Point turned(Point p, std::size_t corner) {
  return {(corner & 1U) != 0 ? 1.0 - p.s : p.s, (corner & 2U) != 0 ? 1.0 - p.t : p.t};
}

constexpr double kRounding = 1e-12;

}  // namespace

BetweenCenters::BetweenCenters(const ClearanceField& field, int x, int y)
    : cell_m_(field.geometry().resolution_m), least_m_(0.0) {
  const Geometry& g = field.geometry();
  if (x >= 0 && y >= 0 && x + 1 < g.width && y + 1 < g.height) {
    const float* below = field.cells_m().data() + g.index({x, y});
    const float* above = below + g.width;
    corner_m_ = {below[0], below[1], above[0], above[1]};
  } else {
    corner_m_ = {field.clearance_m(Cell{x, y}), field.clearance_m(Cell{x + 1, y}), field.clearance_m(Cell{x, y + 1}),
                 field.clearance_m(Cell{x + 1, y + 1})};
  }

  least_m_ = std::min(std::min(corner_m_[0], corner_m_[1]), std::min(corner_m_[2], corner_m_[3]));
}

/// Bilinear: along both rows first, then between them.
double BetweenCenters::blended_m(Point p) const {
  const double below = corner_m_[0] + p.s * (corner_m_[1] - corner_m_[0]);
  const double above = corner_m_[2] + p.s * (corner_m_[3] - corner_m_[2]);
  return below + p.t * (above - below);
}

double BetweenCenters::nearest_of_four_m(Point p) const {
  double nearest = 0.5;
  for (std::size_t i = 0; i < corner_m_.size(); ++i) {
    if (corner_m_[i] <= 0.0) nearest = std::min(nearest, distance_to_lower_left(turned(p, i)));
  }

  return nearest * cell_m_;
}

/// Beyond half a cell, occupied cells outside the four count as well; then this says no.
bool BetweenCenters::is_clear_of_four(Point a, Point b, double radius_m) const {
  if (radius_m > 0.5 * cell_m_) return false;

  const double least = radius_m / cell_m_ + kRounding;
  for (std::size_t i = 0; i < corner_m_.size(); ++i) {
    if (corner_m_[i] > 0.0) continue;

    const Point from = turned(a, i);
    const Point to = turned(b, i);
    if (is_surely_beyond_lower_left(from, to, least)) continue;

    const double distance_m = distance_to_lower_left(from, to) * cell_m_;
    if (distance_m <= 0.0 || distance_m < radius_m) return false;
  }

  return true;
}

/// A centre does not count where the piece lies on the opposite side of the square: there the
/// interpolation does not use it.
double BetweenCenters::least_around_m(Point a, Point b) const {
  const auto both = [](double begin, double end, double at) { return begin == at && end == at; };
  double least = kFar;

  for (std::size_t i = 0; i < corner_m_.size(); ++i) {
    const bool left = (i & 1U) == 0;
    const bool below = (i & 2U) == 0;
    const bool counts = !both(a.s, b.s, left ? 1.0 : 0.0) && !both(a.t, b.t, below ? 1.0 : 0.0);
    if (counts) least = std::min(least, corner_m_[i]);
  }

  return least;
}

double BetweenCenters::clearance_m(Point p) const {
  const double least = least_around_m(p, p);
  if (least_m_ <= 0.0) return std::max(least, nearest_of_four_m(p));
  const double slack = std::min(kWorst, kSlope * (p.s * (1.0 - p.s) + p.t * (1.0 - p.t)));
  return std::max(least, blended_m(p) - slack * cell_m_);
}

bool BetweenCenters::is_free_along(Point a, Point b, double radius_m) const {
  const auto is_enough = [radius_m](double clearance) { return clearance > 0.0 && clearance >= radius_m; };
  if (a.s == b.s && a.t == b.t) return is_enough(clearance_m(a));
  if (is_enough(least_around_m(a, b))) return true;
  if (least_m_ <= 0.0) return is_clear_of_four(a, b, radius_m);
  return is_enough(least_blended_m(a, b) - kWorst * cell_m_);
}

/// f(u) = begin + slope u + bend u^2 along the piece; its minimum is at u = -slope / 2 bend when that
/// lies within.
double BetweenCenters::least_blended_m(Point a, Point b) const {
  // Along a straight piece it is a parabola through its values at both ends and in the middle.
  const double begin = blended_m(a);
  const double end = blended_m(b);
  const double middle = blended_m({0.5 * (a.s + b.s), 0.5 * (a.t + b.t)});
  const double bend = 2.0 * (begin + end - 2.0 * middle);
  const double slope = end - begin - bend;
  if (bend > 0.0 && slope < 0.0 && -slope < 2.0 * bend) return begin - slope * slope / (4.0 * bend);

  return std::min(begin, end);
}

}  // namespace aisle::grid
