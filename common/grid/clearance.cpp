#include "common/grid/clearance.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "common/grid/between_centers.hpp"

namespace aisle::grid {
namespace {

// Lengths inside the transform are whole numbers of half cells, squared lengths are their squares: all arithmetic is exact.
constexpr int kMaxReachCells = 16000;
constexpr std::int32_t kFar = 40000;  // of more half cells than any reach: no obstacle within it

int reach_cells(double max_m, double resolution_m) {
  return static_cast<int>(std::min<double>(kMaxReachCells, std::ceil(max_m / resolution_m) + 1.0));
}

/// A block of cells that are looked at; low included, high not.
struct Window {
  int x0, y0, x1, y1;
  int width() const { return x1 - x0; }
};

Window grown(const Window& w, int by, const Geometry& g) {
  return {std::max(0, w.x0 - by), std::max(0, w.y0 - by), std::min(g.width, w.x1 + by), std::min(g.height, w.y1 + by)};
}

/// For each cell of `from` (row by row): half cells from the centre to the edge of the nearest occupied cell in its own column.
std::vector<std::uint16_t> column_distances(const OccupancyGrid& grid, const Window& from) {
  const auto width = static_cast<std::size_t>(from.width());
  const auto rows = static_cast<std::size_t>(from.y1 - from.y0);
  std::vector<std::uint16_t> half(width * rows);
  const auto pass = [&](std::size_t row, const std::uint16_t* before, bool first_pass) {
    std::uint16_t* out = half.data() + row * width;
    const Occupancy* cells = grid.cells().data() + grid.geometry().index({from.x0, from.y0 + static_cast<int>(row)});
    for (std::size_t x = 0; x < width; ++x) {
      const std::uint16_t next = before[x] == 0 ? 1 : static_cast<std::uint16_t>(std::min<int>(before[x] + 2, kFar));
      const std::uint16_t own = first_pass ? (cells[x] == Occupancy::kFree ? std::uint16_t{kFar} : std::uint16_t{0}) : out[x];
      out[x] = std::min(own, next);
    }
  };
  // Below the first and above the last row of the grid everything is occupied; at other borders of the window nothing is known.
  const std::vector<std::uint16_t> below(width, from.y0 == 0 ? std::uint16_t{0} : std::uint16_t{kFar});
  const std::vector<std::uint16_t> above(width, from.y1 == grid.geometry().height ? std::uint16_t{0} : std::uint16_t{kFar});
  for (std::size_t row = 0; row < rows; ++row) pass(row, row == 0 ? below.data() : half.data() + (row - 1) * width, true);
  for (std::size_t row = rows; row-- > 0;) pass(row, row + 1 == rows ? above.data() : half.data() + (row + 1) * width, false);
  return half;
}

/// The lower envelope of parabolas over one row. A site stands on each border between two cells of the row.
class RowEnvelope {
 public:
  explicit RowEnvelope(int width) : site_(static_cast<std::size_t>(width) + 1), height_(site_.size()), begin_(site_.size()) {}

  void clear() { count_ = 0; }

  /// Border `j` lies left of cell `j`; borders come in rising order.
  void add(std::int32_t j, std::int64_t height) {
    while (count_ > 0) {
      const std::int32_t begin = first_better(site_[count_ - 1], height_[count_ - 1], j, height);
      if (begin > begin_[count_ - 1]) {
        push(j, height, begin);
        return;
      }
      --count_;
    }
    push(j, height, 0);
  }

  /// Squared half cells from the centres of cells x0..x1-1 to the nearest site; kept where `out` is already less.
  void lower(std::int32_t x0, std::int32_t x1, double* out) const {
    for (std::size_t k = 0; k < count_; ++k) {
      const std::int32_t begin = std::max(x0, begin_[k]);
      const std::int32_t end = k + 1 < count_ ? std::min(x1, begin_[k + 1]) : x1;
      const auto height = static_cast<double>(height_[k]);
      for (std::int32_t x = begin; x < end; ++x) {
        const double across = 2 * (x - site_[k]) + 1;
        out[x - x0] = std::min(out[x - x0], across * across + height);
      }
    }
  }
  bool empty() const { return count_ == 0; }

 private:
  void push(std::int32_t j, std::int64_t height, std::int32_t begin) {
    site_[count_] = j;
    height_[count_] = height;
    begin_[count_++] = begin;
  }

  /// The first cell that is nearer to the later site b than to a: (2(x-a)+1)^2 + A > (2(x-b)+1)^2 + B.
  static std::int32_t first_better(std::int32_t a, std::int64_t height_a, std::int32_t b, std::int64_t height_b) {
    const std::int64_t gap = b - a;
    const std::int64_t top = height_b - height_a + 4 * gap * (static_cast<std::int64_t>(a) + b - 1);
    if (top < 0) return 0;
    // A double holds both exactly, and the quotient is nearer to a whole number than rounding can tell only when it is one.
    return static_cast<std::int32_t>(static_cast<double>(top) / static_cast<double>(8 * gap)) + 1;
  }

  std::vector<std::int32_t> site_;
  std::vector<std::int64_t> height_;
  std::vector<std::int32_t> begin_;
  std::size_t count_{0};
};

}  // namespace

ClearanceField::ClearanceField(const OccupancyGrid& grid, double max_m)
    : geometry_(grid.geometry()), max_m_(max_m), clearance_m_(grid.geometry().cells(), 0.0F) {
  if (geometry_.width > 0 && geometry_.height > 0) recompute(grid, {0, 0}, {geometry_.width - 1, geometry_.height - 1});
}

void ClearanceField::update(const OccupancyGrid& grid, Cell low, Cell high) {
  if (high.x < low.x || high.y < low.y) return;
  const int reach = reach_cells(max_m_, geometry_.resolution_m);
  const Window changed{std::clamp(low.x, 0, geometry_.width - 1), std::clamp(low.y, 0, geometry_.height - 1),
                       std::clamp(high.x + 1, 1, geometry_.width), std::clamp(high.y + 1, 1, geometry_.height)};
  const Window window = grown(changed, reach, geometry_);
  recompute(grid, {window.x0, window.y0}, {window.x1 - 1, window.y1 - 1});
}

void ClearanceField::recompute(const OccupancyGrid& grid, Cell low, Cell high) {
  const int reach = reach_cells(max_m_, geometry_.resolution_m);
  const Window window{low.x, low.y, high.x + 1, high.y + 1};
  const Window seen = grown(window, reach, geometry_);
  const std::vector<std::uint16_t> columns = column_distances(grid, seen);
  const auto far = static_cast<std::uint16_t>(std::min<std::int32_t>(kFar, 2 * reach));
  const auto half_cell_m = static_cast<float>(0.5 * geometry_.resolution_m);
  const auto max_m = static_cast<float>(max_m_);
  const double far_squared = static_cast<double>(kFar) * kFar;

  RowEnvelope envelope(seen.width());
  std::vector<double> squared(static_cast<std::size_t>(window.width()));
  for (int y = window.y0; y < window.y1; ++y) {
    const std::uint16_t* row = columns.data() + static_cast<std::size_t>(y - seen.y0) * static_cast<std::size_t>(seen.width());
    const auto at = [&](int x) -> std::int64_t { return x < 0 || x >= geometry_.width ? 0 : row[x - seen.x0]; };
    envelope.clear();
    for (int border = seen.x0 == 0 ? 0 : seen.x0 + 1; border < seen.x1 || border == geometry_.width; ++border) {
      const std::int64_t nearest = std::min(at(border - 1), at(border));
      if (nearest < far) envelope.add(border, nearest * nearest);
    }
    float* out = clearance_m_.data() + geometry_.index({window.x0, y});
    for (int x = window.x0; x < window.x1; ++x) {
      const double own = row[x - seen.x0];
      squared[static_cast<std::size_t>(x - window.x0)] = own < far ? own * own : far_squared;
    }
    if (!envelope.empty()) envelope.lower(window.x0, window.x1, squared.data());
    for (std::size_t i = 0; i < squared.size(); ++i) {
      out[i] = std::min(max_m, half_cell_m * std::sqrt(static_cast<float>(squared[i])));
    }
  }
}

double ClearanceField::clearance_m(geometry::Point2 in_map) const {
  if (geometry_.cells() == 0) return 0.0;
  const double x = (in_map.x - geometry_.origin_in_map.x) / geometry_.resolution_m;
  const double y = (in_map.y - geometry_.origin_in_map.y) / geometry_.resolution_m;
  if (!(x >= 0.0 && y >= 0.0 && x <= geometry_.width && y <= geometry_.height)) return 0.0;
  const double u = BetweenCenters::snapped(x - 0.5);
  const double v = BetweenCenters::snapped(y - 0.5);
  const BetweenCenters square(*this, static_cast<int>(std::floor(u)), static_cast<int>(std::floor(v)));
  return square.clearance_m({u - std::floor(u), v - std::floor(v)});
}

}  // namespace aisle::grid
