#include "common/grid/clearance_batch.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <limits>
#include <random>

#include "tests/unit/grid/random_grid.hpp"

namespace aisle::grid {
namespace {

using geometry::Point2;

/// Inside and outside, on centres, on the lines between them, beside occupied cells, and what no map has.
Point2 some_point(std::mt19937& random, const Geometry& g) {
  const Point2 p = testing::random_point(random, g);
  const Point2 center = g.center_in_map(g.cell_at(p));
  switch (std::uniform_int_distribution<int>(0, 11)(random)) {
    case 0:
      return center;
    case 1:
      return {center.x, p.y};
    case 2:
      return {p.x, center.y};
    case 3:
      return {p.x + g.width * g.resolution_m, p.y};
    case 4:
      return {p.x, p.y - g.height * g.resolution_m};
    case 5:
      return {p.x, std::numeric_limits<double>::quiet_NaN()};
    case 6:
      return {-std::numeric_limits<double>::infinity(), 1e300};
    default:
      return p;
  }
}

TEST(ClearancesOfManyPoints, AreThoseOfEachToTheBit) {
  int free = 0, far_less = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    std::mt19937 random(seed);
    const OccupancyGrid grid = testing::random_grid(random);
    const ClearanceField field(grid, 5.0);
    const ClearanceBatch clearances(field);
    for (int round = 0; round < 160; ++round) {
      geometry::Batch x, y;
      geometry::BatchMask wanted;
      for (std::size_t i = 0; i < geometry::kBatch; ++i) {
        const Point2 p = some_point(random, grid.geometry());
        x[i] = p.x, y[i] = p.y;
        wanted[i] = random() % 4 == 0 ? 0 : -1;
      }
      const geometry::Batch found_m = clearances.clearance_m(x, y, wanted), rough_m = clearances.rough_m(x, y);
      for (std::size_t i = 0; i < geometry::kBatch; ++i) {
        const Point2 p{x[i], y[i]};
        ASSERT_LE(rough_m[i], field.clearance_m(p)) << "seed " << seed << " at " << p.x << " " << p.y;
        ASSERT_EQ(rough_m[i], clearances.rough_m(p)) << "seed " << seed << " at " << p.x << " " << p.y;
        if (field.clearance_m(p) - rough_m[i] > 2.0 * field.geometry().resolution_m) ++far_less;
        if (wanted[i] == 0 && found_m[i] == 0.0) continue;
        ASSERT_EQ(found_m[i], field.clearance_m(p)) << "seed " << seed << " at " << p.x << " " << p.y;
        if (found_m[i] > 0.0) ++free;
      }
    }
  }
  EXPECT_GT(free, 40000);
  EXPECT_EQ(far_less, 0);
}

}  // namespace
}  // namespace aisle::grid
