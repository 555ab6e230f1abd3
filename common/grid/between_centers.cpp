#include "common/grid/between_centers.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace aisle::grid {
namespace {

using Point = BetweenCenters::Point;

double distance_to_piece(Point q, Point a, Point b) {
  return geometry::distance_to_segment({q.s, q.t}, {a.s, a.t}, {b.s, b.t});
}

/// Does the piece from a to b enter s <= 1/2 and t <= 1/2?
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

/// Least distance, in cells, of the piece to the quarter of the square that belongs to the lower left cell.
double distance_to_lower_left(Point a, Point b) {
  if (enters_lower_left(a, b)) return 0.0;
  const auto from_end = [](Point p) { return std::hypot(std::max(p.s - 0.5, 0.0), std::max(p.t - 0.5, 0.0)); };
  return std::min({from_end(a), from_end(b), distance_to_piece({0.5, 0.5}, a, b)});
}

}  // namespace

BetweenCenters::BetweenCenters(const ClearanceField& field, int x, int y)
    : cell_m_(field.geometry().resolution_m),
      corner_m_{field.clearance_m(Cell{x, y}), field.clearance_m(Cell{x + 1, y}), field.clearance_m(Cell{x, y + 1}),
                field.clearance_m(Cell{x + 1, y + 1})},
      least_m_(std::min({corner_m_[0], corner_m_[1], corner_m_[2], corner_m_[3]})) {}

double BetweenCenters::blended_m(Point p) const {
  const double below = corner_m_[0] + p.s * (corner_m_[1] - corner_m_[0]);
  const double above = corner_m_[2] + p.s * (corner_m_[3] - corner_m_[2]);
  return below + p.t * (above - below);
}

double BetweenCenters::nearest_of_four_m(Point a, Point b) const {
  double nearest = 0.5;
  for (std::size_t i = 0; i < corner_m_.size(); ++i) {
    if (corner_m_[i] > 0.0) continue;
    const auto turned = [&](Point p) { return Point{(i & 1U) != 0 ? 1.0 - p.s : p.s, (i & 2U) != 0 ? 1.0 - p.t : p.t}; };
    nearest = std::min(nearest, distance_to_lower_left(turned(a), turned(b)));
  }
  return nearest * cell_m_;
}

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
  if (least_m_ <= 0.0) return std::max(least, nearest_of_four_m(p, p));
  const double slack = std::min(kWorst, kSlope * (p.s * (1.0 - p.s) + p.t * (1.0 - p.t)));
  return std::max(least, blended_m(p) - slack * cell_m_);
}

bool BetweenCenters::is_free_along(Point a, Point b, double radius_m) const {
  const auto is_enough = [radius_m](double clearance) { return clearance > 0.0 && clearance >= radius_m; };
  if (a.s == b.s && a.t == b.t) return is_enough(clearance_m(a));
  if (is_enough(least_around_m(a, b))) return true;
  if (least_m_ <= 0.0) return is_enough(nearest_of_four_m(a, b));
  return is_enough(least_blended_m(a, b) - kWorst * cell_m_);
}

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
