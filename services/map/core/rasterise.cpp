#include "services/map/core/rasterise.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace aisle::map {
namespace {

using geometry::Point2;

constexpr double kTouch = 1e-6;  // cells; less than this is touching, not overlapping

/// From here on lengths are in cells from the lower left corner of the grid.
std::vector<Point2> to_cells(const fleet::MapEdit& edit, const grid::Geometry& g) {
  std::vector<Point2> points;
  for (const Point2 p : edit.points_in_map) {
    points.push_back({(p.x - g.origin_in_map.x) / g.resolution_m, (p.y - g.origin_in_map.y) / g.resolution_m});
  }

  return points;
}

/// The cells of one axis that [low, high] overlaps.
std::pair<int, int> overlapped(double low, double high, int size) {
  const auto clamped = [size](double v) { return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(size))); };
  return {clamped(std::floor(low + kTouch)), clamped(std::ceil(high - kTouch))};
}

/// Appends the run unless it is empty.
void add_run(std::vector<CellRun>& runs, int y, std::pair<int, int> x) {
  if (x.first < x.second) runs.push_back({y, x.first, x.second});
}

/// The same cells in each row. `a`, `b`: opposite corners, in any order.
std::vector<CellRun> rectangle(Point2 a, Point2 b, const grid::Geometry& g) {
  std::vector<CellRun> runs;
  const auto rows = overlapped(std::min(a.y, b.y), std::max(a.y, b.y), g.height);
  for (int y = rows.first; y < rows.second; ++y)
    add_run(runs, y, overlapped(std::min(a.x, b.x), std::max(a.x, b.x), g.width));

  return runs;
}

/// The cells whose nearest point is less than `radius` away from `center`; both in cells.
std::vector<CellRun> disc(Point2 center, double radius, const grid::Geometry& g) {
  std::vector<CellRun> runs;
  const auto rows = overlapped(center.y - radius, center.y + radius, g.height);

  // In a row the disc is widest at the height nearest to its centre: half = sqrt(r^2 - off^2).
  for (int y = rows.first; y < rows.second; ++y) {
    const double off = std::max({0.0, y - center.y, center.y - (y + 1)});
    const double half = std::sqrt(std::max(0.0, radius * radius - off * off));
    add_run(runs, y, overlapped(center.x - half, center.x + half, g.width));
  }

  return runs;
}

/// One row of a polygon: the cells that its edges pass through, and those between its crossings of the row's middle.
class PolygonRow {
 public:
  PolygonRow(const std::vector<Point2>& corners, const grid::Geometry& g)
      : corners_(corners), width_(g.width), covered_(static_cast<std::size_t>(g.width)) {}

  void add_runs(int y, std::vector<CellRun>& runs) {
    // The border: the cells of this row through which an edge passes.
    // The inside: from an odd crossing of the row's middle to the next even one (even-odd rule).
    std::fill(covered_.begin(), covered_.end(), std::uint8_t{0});

    std::vector<double> crossings;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const Point2 a = corners_[i];
      const Point2 b = corners_[(i + 1) % corners_.size()];
      cover_edge(a, b, y);

      const double middle = y + 0.5;
      if ((a.y <= middle) != (b.y <= middle)) crossings.push_back(a.x + (middle - a.y) / (b.y - a.y) * (b.x - a.x));
    }

    std::sort(crossings.begin(), crossings.end());
    for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) cover(overlapped(crossings[i], crossings[i + 1], width_));

    // Runs of covered cells, from left to right.
    for (int x = 0; x < width_; ++x) {
      if (covered_[static_cast<std::size_t>(x)] == 0) continue;

      const int begin = x;
      while (x < width_ && covered_[static_cast<std::size_t>(x)] != 0) ++x;
      runs.push_back({y, begin, x});
    }
  }

 private:
  /// Marks the cells of one interval.
  void cover(std::pair<int, int> x) {
    if (x.first < x.second) std::fill(covered_.begin() + x.first, covered_.begin() + x.second, std::uint8_t{1});
  }

  /// Marks the cells that the part of the edge within this row passes over.
  void cover_edge(Point2 a, Point2 b, int y) {
    if (a.y > b.y) std::swap(a, b);

    // The part of the edge between the row's lower and upper border, less the width of a touch.
    const double low = std::max(a.y, y + kTouch);
    const double high = std::min(b.y, y + 1 - kTouch);
    if (low > high) return;

    // The straight line: x(y) = a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x).
    const auto x_at = [&](double at) { return b.y > a.y ? a.x + (at - a.y) / (b.y - a.y) * (b.x - a.x) : a.x; };
    const double x0 = b.y > a.y ? x_at(low) : a.x;
    const double x1 = b.y > a.y ? x_at(high) : b.x;

    cover(overlapped(std::min(x0, x1), std::max(x0, x1), width_));
  }

  const std::vector<Point2>& corners_;
  int width_;
  std::vector<std::uint8_t> covered_;
};

/// Row by row from its lowest to its highest corner (scan line).
std::vector<CellRun> polygon(const std::vector<Point2>& corners, const grid::Geometry& g) {
  std::vector<CellRun> runs;
  const auto [lowest, highest] =
      std::minmax_element(corners.begin(), corners.end(), [](Point2 a, Point2 b) { return a.y < b.y; });
  const auto rows = overlapped(lowest->y, highest->y, g.height);

  PolygonRow row(corners, g);
  for (int y = rows.first; y < rows.second; ++y) row.add_runs(y, runs);

  return runs;
}

}  // namespace

std::vector<CellRun> rasterise(const fleet::MapEdit& edit, const grid::Geometry& geometry) {
  const std::vector<Point2> points = to_cells(edit, geometry);
  switch (edit.shape) {
    case fleet::MapEdit::Shape::kRectangle:
      return rectangle(points[0], points[1], geometry);
    case fleet::MapEdit::Shape::kPolygon:
      return polygon(points, geometry);
    case fleet::MapEdit::Shape::kDisc:
      return disc(points[0], edit.radius_m / geometry.resolution_m, geometry);
  }

  return {};
}

}  // namespace aisle::map
