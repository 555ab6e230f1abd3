#include "common/grid/clearance_lanes.hpp"

#include <cstdint>
#include <cstring>

#include "common/geometry/wide_vectors.hpp"
#include "common/grid/between_centers.hpp"

namespace aisle::grid {
namespace {

constexpr std::size_t kLanes = kClearanceLanes;
using Lane = std::array<double, kLanes>;

/// Where the points lie between the four centres around them.
struct Places {
  alignas(32) std::array<std::int32_t, kLanes> index;     // of the lower left cell
  alignas(32) Lane s, t;                                  // 0 where the point is not between four cells of the grid
};

/// The cells around each point: pairs of left and right.
struct Corners {
  alignas(32) std::array<float, 2 * kLanes> lower, upper;
};

AISLE_WIDE_VECTORS void find(const Geometry& grid, const double* x, const double* y, Places& places) {
  const double origin_x = grid.origin_in_map.x, origin_y = grid.origin_in_map.y, cell_m = grid.resolution_m;
  const double last_u = grid.width - 1.0, last_v = grid.height - 1.0;
  const std::int32_t width = grid.width;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double u = (x[i] - origin_x) / cell_m - 0.5;
    const double v = (y[i] - origin_y) / cell_m - 0.5;
    const bool is_inside = (u >= 0.0) & (v >= 0.0) & (u < last_u) & (v < last_v);
    const double known_u = is_inside ? u : 0.0;
    const double known_v = is_inside ? v : 0.0;
    const auto column = static_cast<std::int32_t>(known_u);
    const auto row = static_cast<std::int32_t>(known_v);
    places.index[i] = row * width + column;
    places.s[i] = known_u - column;
    places.t[i] = known_v - row;
  }
}

void gather(const ClearanceField& field, const Places& places, Corners& corners) {
  const float* lower = field.cells_m().data();
  const float* upper = lower + field.geometry().width;
  for (std::size_t i = 0; i < kLanes; ++i) {
    std::memcpy(&corners.lower[2 * i], lower + places.index[i], 2 * sizeof(float));
    std::memcpy(&corners.upper[2 * i], upper + places.index[i], 2 * sizeof(float));
  }
}

/// The usual case: four free cells around a point that lies on no line of centres. Otherwise 0. Returns how many are not usual.
AISLE_WIDE_VECTORS int interpolate(const Corners& corners, const Places& places, double cell_m, Lane& clearance_m) {
  constexpr double kOnALine = 1e-8;         // or nearly: snapping is not done here
  int unusual = 0;
  for (std::size_t i = 0; i < kLanes; ++i) {
    const double corner_m[4]{corners.lower[2 * i], corners.lower[2 * i + 1], corners.upper[2 * i], corners.upper[2 * i + 1]};
    const double s = places.s[i], t = places.t[i];
    const bool is_between = (s >= kOnALine) & (t >= kOnALine) & (s <= 1.0 - kOnALine) & (t <= 1.0 - kOnALine);
    const double between_m = BetweenCenters::clearance_m(corner_m, {s, t}, cell_m);
    clearance_m[i] = is_between ? between_m : 0.0;
    unusual += clearance_m[i] > 0.0 ? 0 : 1;
  }
  return unusual;
}

}  // namespace

void clearances_m(const ClearanceField& field, const double* x, const double* y, Lane& clearance_m) {
  const Geometry& grid = field.geometry();
  if (grid.width < 2 || grid.height < 2) {
    clearance_m.fill(0.0);
  } else {
    Places places;
    Corners corners;
    find(grid, x, y, places);
    gather(field, places, corners);
    if (interpolate(corners, places, grid.resolution_m, clearance_m) == 0) return;
  }
  for (std::size_t i = 0; i < kLanes; ++i)
    if (!(clearance_m[i] > 0.0)) clearance_m[i] = field.clearance_m(geometry::Point2{x[i], y[i]});
}

}  // namespace aisle::grid
