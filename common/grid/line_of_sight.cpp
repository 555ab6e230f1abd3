#include "common/grid/line_of_sight.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "common/grid/between_centers.hpp"

namespace aisle::grid {
namespace {

using geometry::Point2;

constexpr double kNever = std::numeric_limits<double>::infinity();

/// One coordinate of a walk along a segment through squares of edge 1, which begin at whole numbers; time runs from 0
/// to 1.
struct Axis {
  double start;
  double change;
  int square{0};

  double at(double time) const { return start + time * change; }

  /// The square that the walk goes through right after `time`.
  void enter(double time) {
    const double u = BetweenCenters::snapped(at(time));
    square = static_cast<int>(u);  // toward zero
    if (u < square || (change < 0.0 && u == square)) --square;
  }

  /// When the walk leaves the square on this axis; never, where it does not move along it.
  double next_border_time() const {
    if (change == 0.0) return kNever;
    return (static_cast<double>(square) + (change > 0.0 ? 1.0 : 0.0) - start) / change;
  }

  void step() { square += change > 0.0 ? 1 : -1; }

  /// Where the walk is at `time`, within the square.
  double local(double time) const { return std::clamp(BetweenCenters::snapped(at(time) - square), 0.0, 1.0); }
};

/// Two corners of an axis-parallel box.
struct Box {
  Point2 low;
  Point2 high;
};

double squared(Point2 p) { return geometry::dot(p, p); }

/// From a point to a box; 0 within it.
double squared_distance(Point2 p, const Box& box) {
  return squared(
      {std::max({box.low.x - p.x, 0.0, p.x - box.high.x}), std::max({box.low.y - p.y, 0.0, p.y - box.high.y})});
}

/// Does the segment touch the box? Clipping: the parts of the segment within each pair of sides must
/// overlap.
bool enters(Point2 a, Point2 b, const Box& box) {
  double from = 0.0;
  double to = 1.0;

  const auto clip = [&](double begin, double end, double low, double high) {
    const double change = end - begin;
    if (change == 0.0) {
      if (begin < low || begin > high) to = -1.0;
      return;
    }

    const double at_low = (low - begin) / change;
    const double at_high = (high - begin) / change;

    from = std::max(from, std::min(at_low, at_high));
    to = std::min(to, std::max(at_low, at_high));
  };

  clip(a.x, b.x, box.low.x, box.high.x);
  clip(a.y, b.y, box.low.y, box.high.y);

  return from <= to;
}

/// From a segment to a box; 0 where they touch. Otherwise an end of the segment, or a corner of the
/// box, is nearest.
double squared_distance(Point2 a, Point2 b, const Box& box) {
  if (enters(a, b, box)) return 0.0;

  const Point2 ab = b - a;
  const double length2 = squared(ab);
  double least = std::min(squared_distance(a, box), squared_distance(b, box));

  for (const Point2 corner : {box.low, box.high, Point2{box.low.x, box.high.y}, Point2{box.high.x, box.low.y}}) {
    const double along = length2 > 0.0 ? std::clamp(geometry::dot(corner - a, ab) / length2, 0.0, 1.0) : 0.0;
    least = std::min(least, squared(a + along * ab - corner));
  }

  return least;
}

constexpr double kShrunk_cells = 1e-4;  // far more than rounding

/// The cell's square, a little smaller: what touches it surely touches the cell.
Box shrunk_cell(const Geometry& g, Cell cell) {
  const double half_m = (0.5 - kShrunk_cells) * g.resolution_m;
  const Point2 center = g.center_in_map(cell);
  return {center - Point2{half_m, half_m}, center + Point2{half_m, half_m}};
}

/// The cell that is not free at the end of the way down the field: from cell to the lowest neighbour,
/// until the clearance is 0. None where the field is flat (beyond its cap).
std::optional<Cell> downhill(const ClearanceField& clearance, Cell at) {
  for (double here_m = clearance.clearance_m(at); here_m > 0.0;) {
    const Cell from = at;
    const double from_m = here_m;

    for (int y = from.y - 1; y <= from.y + 1; ++y) {
      for (int x = from.x - 1; x <= from.x + 1; ++x) {
        const double there_m = clearance.clearance_m(Cell{x, y});
        if (there_m >= here_m) continue;
        here_m = there_m;
        at = {x, y};
      }
    }

    if (here_m == from_m) return {};
  }

  return at;
}

/// The cell that a disc touches which stands at `time` of the walk: nearly always the one downhill;
/// otherwise the nearest occupied one within reach.
std::optional<Cell> touched_cell(const ClearanceField& clearance, const Axis& x, const Axis& y, double time,
                                 double radius_m) {
  const Geometry& g = clearance.geometry();
  const Point2 here{g.origin_in_map.x + (x.at(time) + 0.5) * g.resolution_m,
                    g.origin_in_map.y + (y.at(time) + 0.5) * g.resolution_m};

  // Cells to each side; beyond them none can touch.
  const int reach = std::clamp(static_cast<int>(std::ceil(radius_m / g.resolution_m - 0.5)), 0, 64);

  const std::optional<Cell> likely = downhill(clearance, g.cell_at(here));
  if (likely && squared_distance(here, shrunk_cell(g, *likely)) < radius_m * radius_m) return likely;

  // Rare: the nearest occupied square of all within reach.
  std::optional<Cell> nearest;
  double nearest_m2 = kNever;

  for (int cy = y.square - reach; cy <= y.square + 1 + reach; ++cy) {
    for (int cx = x.square - reach; cx <= x.square + 1 + reach; ++cx) {
      if (clearance.clearance_m(Cell{cx, cy}) > 0.0) continue;

      const double distance_m2 = squared_distance(here, shrunk_cell(g, {cx, cy}));
      if (distance_m2 < nearest_m2) {
        nearest_m2 = distance_m2;
        nearest = Cell{cx, cy};
      }
    }
  }

  return nearest;
}

/// The clearances at the four centres of squares, without looking twice at what is known of the field.
class Squares {
 public:
  explicit Squares(const ClearanceField& field)
      : cells_m_(field.cells_m().data()), width_(field.geometry().width), height_(field.geometry().height) {}

  /// False where some of the four lie outside the grid.
  bool look(int x, int y) {
    if (x < 0 || y < 0 || x + 1 >= width_ || y + 1 >= height_) return false;

    const float* below =
        cells_m_ + static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
    const float* above = below + width_;

    least_m = std::min(std::min(below[0], below[1]), std::min(above[0], above[1]));
    greatest_m = std::max(std::max(below[0], below[1]), std::max(above[0], above[1]));

    return true;
  }

  float least_m{0.0F};
  float greatest_m{0.0F};

 private:
  const float* cells_m_;
  int width_;
  int height_;
};

/// The walk of is_line_free from the first centre to the last (Amanatides, Woo 1987, with jumps). In
/// each square between centres:
///
///   1. all four centres clear enough: the square is free;
///   2. much more room than the radius: jump ahead by the spare clearance, less a little for rounding;
///   3. otherwise the piece within the square decides exactly (BetweenCenters).
///
/// `blocked_at`: the time at which the walk was stopped, 0 to 1.
bool is_walk_free(const ClearanceField& clearance, Axis& x, Axis& y, double length_m, double radius_m,
                  double& blocked_at) {
  const double plenty_m = 2.0 * clearance.geometry().resolution_m;
  Squares squares(clearance);

  x.enter(0.0);
  y.enter(0.0);

  double x_time = x.next_border_time();
  double y_time = y.next_border_time();

  for (double time = 0.0; time < 1.0;) {
    // Most squares are decided by their four centres: no room for a jump, or enough for the disc wherever in the square
    // it is.
    const bool is_inside = squares.look(x.square, y.square);
    const bool may_jump = !is_inside || squares.greatest_m > radius_m + 0.999999 * plenty_m;
    const bool is_open = is_inside && squares.least_m > 0.0F && squares.least_m >= radius_m;

    if (may_jump || !is_open) {
      const BetweenCenters square(clearance, x.square, y.square);
      const BetweenCenters::Point here{x.local(time), y.local(time)};
      const double spare_m = may_jump ? square.clearance_m(here) - radius_m : 0.0;

      if (spare_m > plenty_m) {
        time += 0.999999 * spare_m / length_m;
        x.enter(time);
        y.enter(time);
        x_time = x.next_border_time();
        y_time = y.next_border_time();
        continue;
      }

      const double until = std::clamp(std::min(x_time, y_time), time, 1.0);
      if (!is_open && !square.is_free_along(here, {x.local(until), y.local(until)}, radius_m)) {
        blocked_at = 0.5 * (time + until);
        return false;
      }
    }

    time = std::clamp(std::min(x_time, y_time), time, 1.0);

    const bool steps_x = x_time <= y_time;
    const bool steps_y = y_time <= x_time;

    if (steps_x) {
      x.step();
      x_time = x.next_border_time();
    }

    if (steps_y) {
      y.step();
      y_time = y.next_border_time();
    }
  }

  return true;
}

/// A part of a ray, as lengths from its start; empty when it enters after it leaves.
struct Stretch {
  double enters;
  double leaves;
};

/// The part of the ray, at most `range` long, that lies in the grid: within the columns, and within the
/// rows. All lengths are in cells, `start` from the grid's lower left corner.
Stretch stretch_in_grid(const Geometry& g, Point2 start, Point2 direction, double range) {
  Stretch inside{0.0, range};

  const auto clip = [&](double begin, double change, double size) {
    if (change == 0.0) {
      if (begin < 0.0 || begin >= size) inside.leaves = -1.0;
      return;
    }

    const double at_low = -begin / change;
    const double at_high = (size - begin) / change;

    inside.enters = std::max(inside.enters, std::min(at_low, at_high));
    inside.leaves = std::min(inside.leaves, std::max(at_low, at_high));
  };

  clip(start.x, direction.x, g.width);
  clip(start.y, direction.y, g.height);

  return inside;
}

}  // namespace

bool Blocker::blocks(const Geometry& geometry, Point2 from_in_map, Point2 to_in_map, double radius_m) const {
  return cell_ && squared_distance(from_in_map, to_in_map, shrunk_cell(geometry, *cell_)) < radius_m * radius_m;
}

/// Coordinates are in cells from the first centre during the walk, and snapped to lines of centres that
/// rounding just missed.
bool is_line_free(const ClearanceField& clearance, Point2 from_in_map, Point2 to_in_map, double radius_m,
                  Blocker* blocker) {
  const Geometry& g = clearance.geometry();
  if (blocker != nullptr) *blocker = {};

  const auto is_free_at = [&](Point2 p) {
    const double here = clearance.clearance_m(p);
    return here > 0.0 && here >= radius_m;
  };

  if (!is_free_at(from_in_map) || !is_free_at(to_in_map)) return false;  // also whatever lies outside the grid
  const auto in_cells = [&](double map, double origin) {
    return BetweenCenters::snapped((map - origin) / g.resolution_m - 0.5);
  };

  Axis x{in_cells(from_in_map.x, g.origin_in_map.x), 0.0};
  Axis y{in_cells(from_in_map.y, g.origin_in_map.y), 0.0};

  x.change = in_cells(to_in_map.x, g.origin_in_map.x) - x.start;
  y.change = in_cells(to_in_map.y, g.origin_in_map.y) - y.start;

  const double length_m = std::sqrt(x.change * x.change + y.change * y.change) * g.resolution_m;
  if (length_m == 0.0) return true;

  double blocked_at = 0.0;
  if (is_walk_free(clearance, x, y, length_m, radius_m, blocked_at)) return true;

  if (blocker != nullptr) *blocker = Blocker(touched_cell(clearance, x, y, blocked_at, radius_m));
  return false;
}

/// Clips the ray to the grid, then goes from border to border: the nearer of the next border in x and
/// in y is crossed next.
double cast_ray(const OccupancyGrid& grid, Point2 from_in_map, double angle_rad, double max_range_m) {
  const Geometry& g = grid.geometry();
  if (g.cells() == 0) return max_range_m;

  const Point2 direction{std::cos(angle_rad), std::sin(angle_rad)};
  const Point2 start{(from_in_map.x - g.origin_in_map.x) / g.resolution_m,
                     (from_in_map.y - g.origin_in_map.y) / g.resolution_m};
  const double range = max_range_m / g.resolution_m;  // lengths are in cells from here on

  const Stretch inside = stretch_in_grid(g, start, direction, range);
  if (inside.enters > inside.leaves) return max_range_m;

  // The first cell, and how far along the ray the next borders are.
  double travelled = inside.enters;
  const auto entered = [&](double begin, double change, int size) {
    return std::clamp(static_cast<int>(std::floor(begin + travelled * change)), 0, size - 1);
  };

  const Cell cell{entered(start.x, direction.x, g.width), entered(start.y, direction.y, g.height)};
  const Cell step{direction.x > 0.0 ? 1 : -1, direction.y > 0.0 ? 1 : -1};
  const auto first_border = [](double begin, double change, int at) {
    return change == 0.0 ? kNever : (static_cast<double>(at) + (change > 0.0 ? 1.0 : 0.0) - begin) / change;
  };

  Point2 border{first_border(start.x, direction.x, cell.x), first_border(start.y, direction.y, cell.y)};
  const Point2 spacing{direction.x == 0.0 ? kNever : 1.0 / std::fabs(direction.x),
                       direction.y == 0.0 ? kNever : 1.0 / std::fabs(direction.y)};

  // From cell to cell: the nearer border is crossed next. The grid ends where no column or row is left.
  const Occupancy* here = grid.cells().data() + g.index(cell);
  const std::ptrdiff_t row = step.y * static_cast<std::ptrdiff_t>(g.width);
  int columns_left = step.x > 0 ? g.width - cell.x : cell.x + 1;
  int rows_left = step.y > 0 ? g.height - cell.y : cell.y + 1;

  while (travelled <= range) {
    if (*here != Occupancy::kFree) return std::min(max_range_m, std::max(0.0, travelled) * g.resolution_m);

    if (border.x < border.y) {
      if (--columns_left == 0) break;
      travelled = border.x;
      border.x += spacing.x;
      here += step.x;
    } else {
      if (--rows_left == 0) break;
      travelled = border.y;
      border.y += spacing.y;
      here += row;
    }
  }

  return max_range_m;
}

}  // namespace aisle::grid
