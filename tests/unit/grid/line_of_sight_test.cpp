#include "common/grid/line_of_sight.hpp"

#include <gtest/gtest.h>

#include "tests/unit/grid/random_grid.hpp"

namespace aisle::grid {
namespace {

using geometry::Point2;
using testing::random_grid;
using testing::random_point;
using testing::true_clearance_m;

/// Least true clearance of many points of the segment.
double sampled_clearance_m(const OccupancyGrid& grid, Point2 a, Point2 b) {
  const int samples = 200;
  double least = 1e9;
  for (int i = 0; i <= samples; ++i) least = std::min(least, true_clearance_m(grid, a + (i / static_cast<double>(samples)) * (b - a)));
  return least;
}

TEST(LineOfSight, NeverSaysFreeWhereADiscWouldTouch) {
  int free = 0;
  int blocked_by_caution = 0;
  for (unsigned seed = 0; seed < 150; ++seed) {
    std::mt19937 random(seed);
    const OccupancyGrid grid = random_grid(random, 20);
    const double cell_m = grid.geometry().resolution_m;
    const ClearanceField field(grid, 100.0 * cell_m);
    for (int i = 0; i < 60; ++i) {
      const Point2 a = random_point(random, grid.geometry());
      const Point2 b = random_point(random, grid.geometry());
      const double radius_m = i % 4 == 0 ? 0.0 : cell_m * std::uniform_real_distribution<double>(0.0, 2.5)(random);
      const double truth = sampled_clearance_m(grid, a, b);
      if (is_line_free(field, a, b, radius_m)) {
        ++free;
        ASSERT_GT(truth, 0.0) << "seed " << seed << " line " << i;
        ASSERT_GE(truth, radius_m - 1e-6 * cell_m) << "seed " << seed << " line " << i;
      } else if (truth > radius_m + 0.75 * cell_m) {
        ++blocked_by_caution;
      }
    }
  }
  EXPECT_GT(free, 500);
  EXPECT_EQ(blocked_by_caution, 0);
}

TEST(LineOfSight, WithoutARadiusIsExactlyThatNoSquareIsTouched) {
  int free = 0;
  for (unsigned seed = 0; seed < 150; ++seed) {
    std::mt19937 random(seed);
    const OccupancyGrid grid = random_grid(random, 20);
    const ClearanceField field(grid, 1e3);
    for (int i = 0; i < 60; ++i) {
      const Point2 a = random_point(random, grid.geometry());
      const Point2 b = random_point(random, grid.geometry());
      const bool is_free = is_line_free(field, a, b, 0.0);
      if (is_free != (sampled_clearance_m(grid, a, b) > 0.0)) {
        // Samples may jump over a corner, never the other way.
        ASSERT_FALSE(is_free) << "seed " << seed << " line " << i;
        ASSERT_LT(sampled_clearance_m(grid, a, b), 0.2 * grid.geometry().resolution_m) << "seed " << seed << " line " << i;
      }
      free += is_free ? 1 : 0;
    }
  }
  EXPECT_GT(free, 500);
}

TEST(LineOfSight, AgreesWithTraversableNeighbours) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    std::mt19937 random(seed);
    const OccupancyGrid grid = random_grid(random, 30);
    const Geometry& g = grid.geometry();
    const ClearanceField field(grid);
    const double radius_m = seed % 5 == 0 ? 0.0 : g.resolution_m * std::uniform_real_distribution<double>(0.0, 4.0)(random);
    const auto ok = [&](int x, int y) { return field.is_traversable({x, y}, radius_m); };
    const auto line = [&](Cell a, Cell b) { return is_line_free(field, g.center_in_map(a), g.center_in_map(b), radius_m); };
    for (int y = 0; y < g.height; ++y) {
      for (int x = 0; x < g.width; ++x) {
        ASSERT_EQ(line({x, y}, {x + 1, y}), ok(x, y) && ok(x + 1, y)) << "seed " << seed << " at " << x << " " << y;
        ASSERT_EQ(line({x, y + 1}, {x, y}), ok(x, y) && ok(x, y + 1)) << "seed " << seed << " at " << x << " " << y;
        if (ok(x, y) && ok(x + 1, y) && ok(x, y + 1) && ok(x + 1, y + 1)) {
          ASSERT_TRUE(line({x, y}, {x + 1, y + 1})) << "seed " << seed << " at " << x << " " << y;
          ASSERT_TRUE(line({x, y + 1}, {x + 1, y})) << "seed " << seed << " at " << x << " " << y;
        }
        ASSERT_EQ(line({x, y}, {x, y}), ok(x, y));
      }
    }
  }
}

TEST(LineOfSight, IsTheSameBothWays) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    const OccupancyGrid grid = random_grid(random, 20);
    const ClearanceField field(grid, 1e3);
    for (int i = 0; i < 60; ++i) {
      const Point2 a = random_point(random, grid.geometry());
      const Point2 b = random_point(random, grid.geometry());
      ASSERT_EQ(is_line_free(field, a, b, 0.0), is_line_free(field, b, a, 0.0)) << "seed " << seed << " line " << i;
    }
  }
}

TEST(LineOfSight, EndsAtTheMapAndAtNonsense) {
  const ClearanceField field(OccupancyGrid({10, 10, 0.1, {0.0, 0.0}}));
  EXPECT_TRUE(is_line_free(field, {0.2, 0.2}, {0.8, 0.7}, 0.1));
  EXPECT_FALSE(is_line_free(field, {0.2, 0.2}, {1.2, 0.7}, 0.0));
  EXPECT_FALSE(is_line_free(field, {0.2, 0.2}, {std::nan(""), 0.7}, 0.0));
  EXPECT_FALSE(is_line_free(field, {0.2, 0.2}, {1e300, 0.7}, 0.0));
}

/// The nearest of the ray's ways into each square (slab method).
double brute_ray_m(const OccupancyGrid& grid, Point2 from, double angle, double max_m) {
  const Geometry& g = grid.geometry();
  const double direction[2] = {std::cos(angle), std::sin(angle)};
  double nearest = max_m;
  for (int y = 0; y < g.height; ++y) {
    for (int x = 0; x < g.width; ++x) {
      if (grid.is_free({x, y})) continue;
      const Point2 low = g.origin_in_map + Point2{x * g.resolution_m, y * g.resolution_m};
      const double begin[2] = {low.x - from.x, low.y - from.y};
      double enter = 0.0;
      double leave = 1e18;
      for (int axis = 0; axis < 2; ++axis) {
        const double t0 = begin[axis] / direction[axis];
        const double t1 = (begin[axis] + g.resolution_m) / direction[axis];
        enter = std::max(enter, std::min(t0, t1));
        leave = std::min(leave, std::max(t0, t1));
      }
      if (enter < leave) nearest = std::min(nearest, enter);
    }
  }
  return nearest;
}

TEST(Ray, HitsWhatBruteForceHits) {
  int hits = 0;
  for (unsigned seed = 0; seed < 200; ++seed) {
    std::mt19937 random(seed);
    const OccupancyGrid grid = random_grid(random, 30);
    const double cell_m = grid.geometry().resolution_m;
    for (int i = 0; i < 100; ++i) {
      const Point2 inside = random_point(random, grid.geometry());
      const Point2 from = i % 3 == 0 ? Point2{inside.x - 20.0 * cell_m, inside.y + 7.0 * cell_m} : inside;
      const double angle = std::uniform_real_distribution<double>(-4.0, 4.0)(random);
      const double max_m = cell_m * std::uniform_real_distribution<double>(1.0, 60.0)(random);
      const double expected = brute_ray_m(grid, from, angle, max_m);
      ASSERT_NEAR(cast_ray(grid, from, angle, max_m), expected, 1e-6 * cell_m) << "seed " << seed << " ray " << i;
      hits += expected < max_m ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 3000);
}

TEST(Ray, AlongTheAxesAndFromWithinAWall) {
  OccupancyGrid grid({10, 10, 0.5, {-1.0, -1.0}});
  grid.set({6, 2}, Occupancy::kOccupied);
  grid.set({2, 8}, Occupancy::kUnknown);
  const Point2 from = grid.geometry().center_in_map({2, 2});
  EXPECT_NEAR(cast_ray(grid, from, 0.0, 10.0), 1.75, 1e-9);
  EXPECT_NEAR(cast_ray(grid, from, geometry::kPi / 2.0, 10.0), 2.75, 1e-9);
  EXPECT_EQ(cast_ray(grid, from, geometry::kPi, 10.0), 10.0);
  EXPECT_EQ(cast_ray(grid, from, 0.0, 1.0), 1.0);
  EXPECT_EQ(cast_ray(grid, grid.geometry().center_in_map({6, 2}), 1.0, 10.0), 0.0);
  EXPECT_EQ(cast_ray(OccupancyGrid(), from, 1.0, 10.0), 10.0);
}

}  // namespace
}  // namespace aisle::grid
