#include "common/grid/line_of_sight.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/grid/between_centers.hpp"

namespace aisle::grid {
namespace {

using geometry::Point2;
constexpr double kNever = std::numeric_limits<double>::infinity();

/// One coordinate of a walk along a segment through squares of edge 1, which begin at whole numbers; time runs from 0 to 1.
struct Axis {
  double start;
  double change;
  int square{0};

  double at(double time) const { return start + time * change; }
  /// The square that the walk goes through right after `time`.
  void enter(double time) {
    const double u = BetweenCenters::snapped(at(time));
    square = static_cast<int>(std::floor(u));
    if (change < 0.0 && u == std::floor(u)) --square;
  }
  double next_border_time() const {
    if (change == 0.0) return kNever;
    return (static_cast<double>(square) + (change > 0.0 ? 1.0 : 0.0) - start) / change;
  }
  void step() { square += change > 0.0 ? 1 : -1; }
  /// Where the walk is at `time`, within the square.
  double local(double time) const { return std::clamp(BetweenCenters::snapped(at(time) - square), 0.0, 1.0); }
};

}  // namespace

bool is_line_free(const ClearanceField& clearance, Point2 from_in_map, Point2 to_in_map, double radius_m) {
  const auto is_free_at = [&](Point2 p) {
    const double here = clearance.clearance_m(p);
    return here > 0.0 && here >= radius_m;
  };
  if (!is_free_at(from_in_map) || !is_free_at(to_in_map)) return false;  // also whatever lies outside the grid
  const Geometry& g = clearance.geometry();
  const auto in_cells = [&](double map, double origin) { return BetweenCenters::snapped((map - origin) / g.resolution_m - 0.5); };
  Axis x{in_cells(from_in_map.x, g.origin_in_map.x), 0.0};
  Axis y{in_cells(from_in_map.y, g.origin_in_map.y), 0.0};
  x.change = in_cells(to_in_map.x, g.origin_in_map.x) - x.start;
  y.change = in_cells(to_in_map.y, g.origin_in_map.y) - y.start;
  const double length_m = std::hypot(x.change, y.change) * g.resolution_m;
  if (length_m == 0.0) return true;

  x.enter(0.0);
  y.enter(0.0);
  for (double time = 0.0; time < 1.0;) {
    const BetweenCenters square(clearance, x.square, y.square);
    const BetweenCenters::Point here{x.local(time), y.local(time)};
    const double spare_m = square.clearance_m(here) - radius_m;
    if (spare_m > 2.0 * g.resolution_m) {
      time += 0.999999 * spare_m / length_m;
      x.enter(time);
      y.enter(time);
      continue;
    }
    const double x_time = x.next_border_time();
    const double y_time = y.next_border_time();
    const double until = std::clamp(std::min(x_time, y_time), time, 1.0);
    if (!square.is_free_along(here, {x.local(until), y.local(until)}, radius_m)) return false;
    if (x_time <= y_time) x.step();
    if (y_time <= x_time) y.step();
    time = until;
  }
  return true;
}

double cast_ray(const OccupancyGrid& grid, Point2 from_in_map, double angle_rad, double max_range_m) {
  const Geometry& g = grid.geometry();
  if (g.cells() == 0) return max_range_m;
  const Point2 direction{std::cos(angle_rad), std::sin(angle_rad)};
  const Point2 start{(from_in_map.x - g.origin_in_map.x) / g.resolution_m, (from_in_map.y - g.origin_in_map.y) / g.resolution_m};
  const double range = max_range_m / g.resolution_m;  // lengths are in cells from here on

  // Where the ray enters and leaves the grid.
  double travelled = 0.0;
  double leaves = range;
  const auto clip = [&](double begin, double change, double size) {
    if (change == 0.0) {
      if (begin < 0.0 || begin >= size) leaves = -1.0;
      return;
    }
    const double at_low = -begin / change;
    const double at_high = (size - begin) / change;
    travelled = std::max(travelled, std::min(at_low, at_high));
    leaves = std::min(leaves, std::max(at_low, at_high));
  };
  clip(start.x, direction.x, g.width);
  clip(start.y, direction.y, g.height);
  if (travelled > leaves) return max_range_m;

  const auto entered = [&](double begin, double change, int size) {
    return std::clamp(static_cast<int>(std::floor(begin + travelled * change)), 0, size - 1);
  };
  Cell cell{entered(start.x, direction.x, g.width), entered(start.y, direction.y, g.height)};
  const Cell step{direction.x > 0.0 ? 1 : -1, direction.y > 0.0 ? 1 : -1};
  const auto first_border = [](double begin, double change, int at) {
    return change == 0.0 ? kNever : (static_cast<double>(at) + (change > 0.0 ? 1.0 : 0.0) - begin) / change;
  };
  Point2 border{first_border(start.x, direction.x, cell.x), first_border(start.y, direction.y, cell.y)};
  const Point2 spacing{direction.x == 0.0 ? kNever : 1.0 / std::fabs(direction.x), direction.y == 0.0 ? kNever : 1.0 / std::fabs(direction.y)};
  while (travelled <= range) {
    if (!g.contains(cell)) return max_range_m;
    if (grid.at(cell) != Occupancy::kFree) return std::min(max_range_m, std::max(0.0, travelled) * g.resolution_m);
    if (border.x < border.y) {
      travelled = border.x;
      border.x += spacing.x;
      cell.x += step.x;
    } else {
      travelled = border.y;
      border.y += spacing.y;
      cell.y += step.y;
    }
  }
  return max_range_m;
}

}  // namespace aisle::grid
