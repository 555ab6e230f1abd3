#include "common/grid/clearance.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "common/grid/between_centers.hpp"
#include "common/grid/row_envelope.hpp"

namespace aisle::grid {
namespace {

// Lengths inside the transform are whole numbers of half cells, squared lengths are their squares: all arithmetic is
// exact.
constexpr int kMaxReachCells = 16000;
constexpr int kFar = 40000;  // more half cells than any reach: no obstacle within it

/// Cells to each side that can matter for clearances of at most `max_m`.
int reach_cells(double max_m, double resolution_m) {
  return static_cast<int>(std::min<double>(kMaxReachCells, std::ceil(max_m / resolution_m) + 1.0));
}

/// A block of cells that are looked at; low included, high not.
struct Window {
  int x0, y0, x1, y1;

  int width() const { return x1 - x0; }
  int height() const { return y1 - y0; }
  bool contains(Cell c) const { return c.x >= x0 && c.y >= y0 && c.x < x1 && c.y < y1; }
};

/// The window with `by` more cells to each side, as far as the grid goes.
Window grown(const Window& w, int by, const Geometry& g) {
  return {std::max(0, w.x0 - by), std::max(0, w.y0 - by), std::min(g.width, w.x1 + by), std::min(g.height, w.y1 + by)};
}

/// The first pass of the transform: along columns. Half cells from the centre of each cell to the edge
/// of the nearest occupied cell in its own column, row by row.
///
/// How: one sweep upwards knows the nearest obstacle below, one downwards that above; the lesser
/// counts. Whole rows are computed at once, which compilers turn into vectors.
class Columns {
 public:
  /// What is farther than `farthest` half cells counts as that far.
  Columns(const Window& seen, int grid_height, int farthest)
      : seen_(seen),
        farthest_(static_cast<std::uint16_t>(farthest)),
        width_(static_cast<std::size_t>(seen.width())),
        half_(width_ * static_cast<std::size_t>(seen.height())) {
    // Below the first and above the last row of the grid everything is occupied; at other borders of the window nothing
    // is known.
    below_.assign(width_, seen.y0 == 0 ? std::uint16_t{0} : farthest_);
    above_.assign(width_, seen.y1 == grid_height ? std::uint16_t{0} : farthest_);
  }

  /// The sweep upwards, over the whole window.
  void look_up_from_below(const OccupancyGrid& grid, const std::vector<Cell>& also_occupied) {
    const Occupancy* cells = grid.cells().data() + grid.geometry().index({seen_.x0, seen_.y0});
    for (int y = seen_.y0; y < seen_.y1; ++y, cells += grid.geometry().width) {
      std::uint16_t* own = row(y);
      for (std::size_t x = 0; x < width_; ++x) own[x] = cells[x] == Occupancy::kFree ? farthest_ : std::uint16_t{0};
    }

    for (const Cell cell : also_occupied) {
      if (seen_.contains(cell)) row(cell.y)[cell.x - seen_.x0] = 0;
    }

    for (int y = seen_.y0; y < seen_.y1; ++y) lower(row(y), y == seen_.y0 ? below_.data() : row(y - 1));
  }

  /// The sweep downwards: to be called for each row once, from the top. @returns the row's finished
  /// distances
  const std::uint16_t* look_down_from_above(int y) {
    lower(row(y), y + 1 == seen_.y1 ? above_.data() : row(y + 1));
    return row(y);
  }

 private:
  std::uint16_t* row(int y) { return half_.data() + static_cast<std::size_t>(y - seen_.y0) * width_; }

  /// From the centre it is half a cell to the edge of the next cell, and a whole one more for each cell between.
  void lower(std::uint16_t* own, const std::uint16_t* next) const {
    for (std::size_t x = 0; x < width_; ++x) {
      const auto through = static_cast<std::uint16_t>(next[x] + (next[x] == 0 ? 1 : 2));
      own[x] = std::min(own[x], through);
    }
  }

  Window seen_;
  std::uint16_t farthest_;
  std::size_t width_;
  std::vector<std::uint16_t> half_, below_, above_;
};

/// The second pass along a row, for obstacles that are near: squared half cells from the centres to the
/// nearest square, found by looking left and right in turn. 32 cells at once, in 16-bit numbers that
/// compilers make vectors of. Exact up to kExact; what is farther is only known to be farther.
///
///     d^2(x) = min over k of (2 k - 1)^2 + column(x +- k)^2,    column(x)^2 for k = 0
class NearRow {
 public:
  static constexpr int kBlock = 32;
  static constexpr int kSteps = 63;  // cells to each side
  static constexpr std::int16_t kExact = (2 * kSteps + 1) * (2 * kSteps + 1);
  static constexpr int kHighest = 130;  // half cells in the column that still matter

  static_assert(kHighest * kHighest > kExact && kHighest * kHighest + (2 * kSteps - 1) * (2 * kSteps - 1) <= INT16_MAX);

  using Block = std::array<std::int16_t, kBlock>;

  explicit NearRow(int width) : squares_(static_cast<std::size_t>(width + 2 * kMargin)) {}

  /// Takes a row of Columns, of the cells x0 to x1-1. Beyond the grid's edges everything is occupied.
  void begin(const std::uint16_t* columns, int x0, int x1, int grid_width) {
    first_ = x0;

    const auto nothing = static_cast<std::int16_t>(kHighest * kHighest);
    std::fill_n(squares_.begin(), kMargin, x0 == 0 ? std::int16_t{0} : nothing);

    std::int16_t* out = squares_.data() + kMargin;
    const auto width = static_cast<std::size_t>(x1 - x0);

    for (std::size_t i = 0; i < width; ++i) {
      const auto half = static_cast<std::int16_t>(std::min<std::uint16_t>(columns[i], kHighest));
      out[i] = static_cast<std::int16_t>(half * half);
    }

    std::fill_n(out + width, kMargin, x1 == grid_width ? std::int16_t{0} : nothing);
  }

  /// Squared half cells of the `count` cells from `x` on, at most kBlock; at most `reach` cells to each
  /// side matter. @returns the greatest of them
  int look(int x, std::size_t count, int reach, Block& nearest) const {
    const std::int16_t* here = squares_.data() + kMargin + (x - first_);
    nearest.fill(0);
    std::copy_n(here, count, nearest.begin());

    int greatest = greatest_of(nearest);
    const int steps = std::min(reach, kSteps);

    for (int k = 1; k <= steps && (2 * k - 1) * (2 * k - 1) < greatest; ++k) {
      const auto across = static_cast<std::int16_t>((2 * k - 1) * (2 * k - 1));
      for (int i = 0; i < kBlock; ++i) {
        const auto through = static_cast<std::int16_t>(std::min(here[i - k], here[i + k]) + across);
        nearest[static_cast<std::size_t>(i)] = std::min(nearest[static_cast<std::size_t>(i)], through);
      }

      if (k % 4 == 0) greatest = greatest_of(nearest);
    }

    return greatest_of(nearest);
  }

 private:
  static constexpr int kMargin = kSteps + kBlock;  // a block may stick out of the row

  static int greatest_of(const Block& squares) {
    std::int16_t greatest = 0;
    for (const std::int16_t square : squares) greatest = std::max(greatest, square);
    return greatest;
  }

  int first_{0};
  std::vector<std::int16_t> squares_;
};

/// The sites of one row, for the second pass along what lies farther than NearRow sees: one on each
/// border of cells, with the lesser column of the two beside it.
void fill(RowEnvelope& envelope, const std::uint16_t* row, const Window& seen, int grid_width, int far) {
  const auto at = [&](int x) -> std::int64_t { return x < 0 || x >= grid_width ? 0 : row[x - seen.x0]; };
  envelope.clear();

  for (int border = seen.x0 == 0 ? 0 : seen.x0 + 1; border < seen.x1 || border == grid_width; ++border) {
    const std::int64_t nearest = std::min(at(border - 1), at(border));
    if (nearest < far) envelope.add(border, nearest * nearest);
  }
}

}  // namespace

ClearanceField::ClearanceField(const OccupancyGrid& grid, double max_m)
    : geometry_(grid.geometry()), max_m_(max_m), clearance_m_(grid.geometry().cells(), 0.0F) {
  if (geometry_.width > 0 && geometry_.height > 0)
    recompute(grid, {}, {0, 0}, {geometry_.width - 1, geometry_.height - 1});
}

/// A clearance changes only within max_m of a changed cell.
void ClearanceField::update(const OccupancyGrid& grid, Cell low, Cell high, const std::vector<Cell>& also_occupied) {
  if (high.x < low.x || high.y < low.y) return;

  const int reach = reach_cells(max_m_, geometry_.resolution_m);
  const Window changed{std::clamp(low.x, 0, geometry_.width - 1), std::clamp(low.y, 0, geometry_.height - 1),
                       std::clamp(high.x + 1, 1, geometry_.width), std::clamp(high.y + 1, 1, geometry_.height)};
  const Window window = grown(changed, reach, geometry_);

  recompute(grid, also_occupied, {window.x0, window.y0}, {window.x1 - 1, window.y1 - 1});
}

/// Exact Euclidean distance transform in two passes (Felzenszwalb, Huttenlocher 2012): columns, then
/// rows. Rows are finished from the top while the second sweep of the columns comes down. A block of 32
/// cells is done by NearRow; where that does not see far enough, by the envelope of parabolas, which is
/// made once for the row.
void ClearanceField::recompute(const OccupancyGrid& grid, const std::vector<Cell>& also_occupied, Cell low, Cell high) {
  static std::atomic<std::uint64_t> newest_revision{0};
  revision_ = ++newest_revision;

  const int reach = reach_cells(max_m_, geometry_.resolution_m);
  const Window window{low.x, low.y, high.x + 1, high.y + 1};
  const Window seen = grown(window, reach, geometry_);
  const int far = std::min(kFar, 2 * reach);
  const auto half_cell_m = static_cast<float>(0.5 * geometry_.resolution_m);
  const auto max_m = static_cast<float>(max_m_);

  Columns columns(seen, geometry_.height, far);
  columns.look_up_from_below(grid, also_occupied);

  // Rows from the top, while the second sweep of the columns comes down with them.
  NearRow near(seen.width());
  RowEnvelope envelope(reach > NearRow::kSteps ? seen.width() : 0);

  for (int y = seen.y1 - 1; y >= window.y0; --y) {
    const std::uint16_t* row = columns.look_down_from_above(y);
    if (y >= window.y1) continue;

    near.begin(row, seen.x0, seen.x1, geometry_.width);
    envelope.clear();

    for (int x = window.x0; x < window.x1; x += NearRow::kBlock) {
      const int end = std::min(window.x1, x + NearRow::kBlock);
      const auto count = static_cast<std::size_t>(end - x);
      float* out = clearance_m_.data() + geometry_.index({x, y});
      NearRow::Block squares;
      const bool is_exact = near.look(x, count, reach, squares) <= NearRow::kExact || reach <= NearRow::kSteps;

      for (std::size_t i = 0; i < count; ++i)
        out[i] = std::min(max_m, half_cell_m * std::sqrt(static_cast<float>(squares[i])));

      if (is_exact) continue;

      // Something in the block is too far for NearRow.
      if (envelope.empty()) fill(envelope, row, seen, geometry_.width, far);

      std::array<double, NearRow::kBlock> squared;
      for (std::size_t i = 0; i < count; ++i)
        squared[i] =
            static_cast<double>(row[x - seen.x0 + static_cast<int>(i)]) * row[x - seen.x0 + static_cast<int>(i)];

      if (!envelope.empty()) envelope.lower(x, end, squared.data());

      for (std::size_t i = 0; i < count; ++i)
        out[i] = std::min(max_m, half_cell_m * std::sqrt(static_cast<float>(squared[i])));
    }
  }
}

/// The usual case first; then the square between four centres that the point lies in, or the centre
/// itself.
double ClearanceField::clearance_m(geometry::Point2 in_map) const {
  if (geometry_.cells() == 0) return 0.0;

  const double x = (in_map.x - geometry_.origin_in_map.x) / geometry_.resolution_m;
  const double y = (in_map.y - geometry_.origin_in_map.y) / geometry_.resolution_m;
  if (!(x >= 0.0 && y >= 0.0 && x <= geometry_.width && y <= geometry_.height)) return 0.0;

  if (const double quick = clearance_between_free_m(x - 0.5, y - 0.5); quick > 0.0) return quick;

  const double u = BetweenCenters::snapped(x - 0.5);
  const double v = BetweenCenters::snapped(y - 0.5);
  const auto below = [](double cells) { return cells < 0.0 ? -1 : static_cast<int>(cells); };  // -1/2 and more

  const Cell lower_left{below(u), below(v)};
  if (u == lower_left.x && v == lower_left.y) return clearance_m(lower_left);

  return BetweenCenters(*this, lower_left.x, lower_left.y).clearance_m({u - lower_left.x, v - lower_left.y});
}

/// The usual case, without BetweenCenters and to the bit what it says: four free cells around the point, which lies on
/// no line of centres. `u`, `v`: in cells from the first centre. Otherwise 0.
double ClearanceField::clearance_between_free_m(double u, double v) const {
  if (u < 0.0 || v < 0.0) return 0.0;

  const auto column = static_cast<int>(u);
  const auto row = static_cast<int>(v);
  if (column + 1 >= geometry_.width || row + 1 >= geometry_.height) return 0.0;

  const BetweenCenters::Point p{u - column, v - row};
  constexpr double kOnALine = 1e-8;  // or nearly: snapping is not done here
  if (p.s < kOnALine || p.t < kOnALine || p.s > 1.0 - kOnALine || p.t > 1.0 - kOnALine) return 0.0;

  const float* corner = clearance_m_.data() + geometry_.index({column, row});
  const double corners[4]{corner[0], corner[1], corner[geometry_.width], corner[geometry_.width + 1]};

  return BetweenCenters::between_free_m(corners, p.s, p.t, geometry_.resolution_m);
}

}  // namespace aisle::grid
