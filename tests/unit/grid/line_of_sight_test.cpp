#include "common/grid/line_of_sight.hpp"

#include <gtest/gtest.h>

#include "common/grid/between_centers.hpp"
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
  for (int i = 0; i <= samples; ++i)
    least = std::min(least, true_clearance_m(grid, a + (i / static_cast<double>(samples)) * (b - a)));
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
        ASSERT_LT(sampled_clearance_m(grid, a, b), 0.2 * grid.geometry().resolution_m)
            << "seed " << seed << " line " << i;
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
    const double radius_m =
        seed % 5 == 0 ? 0.0 : g.resolution_m * std::uniform_real_distribution<double>(0.0, 4.0)(random);
    const auto ok = [&](int x, int y) { return field.is_traversable({x, y}, radius_m); };
    const auto line = [&](Cell a, Cell b) {
      return is_line_free(field, g.center_in_map(a), g.center_in_map(b), radius_m);
    };
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

/// The walk of is_line_free as simply as it can be said: each square looked at as a whole, nothing remembered.
class PlainWalk {
 public:
  PlainWalk(const ClearanceField& field, double radius_m) : field_(field), radius_m_(radius_m) {}

  bool is_free(Point2 from, Point2 to) {
    const auto stands = [&](Point2 p) { return field_.clearance_m(p) > 0.0 && field_.clearance_m(p) >= radius_m_; };
    if (!stands(from) || !stands(to)) return false;
    const Geometry& g = field_.geometry();
    const double origin[2] = {g.origin_in_map.x, g.origin_in_map.y};
    const double a[2] = {from.x, from.y};
    const double b[2] = {to.x, to.y};
    for (int i = 0; i < 2; ++i) {
      const auto in_cells = [&](double map) {
        return BetweenCenters::snapped((map - origin[i]) / g.resolution_m - 0.5);
      };
      start_[i] = in_cells(a[i]);
      change_[i] = in_cells(b[i]) - start_[i];
      enter(i, 0.0);
    }
    const double length_m = std::hypot(change_[0], change_[1]) * g.resolution_m;
    for (double time = 0.0; length_m > 0.0 && time < 1.0;) {
      const BetweenCenters square(field_, square_[0], square_[1]);
      const BetweenCenters::Point here{local(0, time), local(1, time)};
      const double spare_m = square.clearance_m(here) - radius_m_;
      if (spare_m > 2.0 * g.resolution_m) {
        time += 0.999999 * spare_m / length_m;
        for (int i = 0; i < 2; ++i) enter(i, time);
        continue;
      }
      const double border[2] = {border_time(0), border_time(1)};
      const double until = std::clamp(std::min(border[0], border[1]), time, 1.0);
      if (!square.is_free_along(here, {local(0, until), local(1, until)}, radius_m_)) return false;
      for (int i = 0; i < 2; ++i) {
        if (border[i] <= border[1 - i]) square_[i] += change_[i] > 0.0 ? 1 : -1;
      }
      time = until;
    }
    return true;
  }

 private:
  double at(int i, double time) const { return start_[i] + time * change_[i]; }
  double local(int i, double time) const {
    return std::clamp(BetweenCenters::snapped(at(i, time) - square_[i]), 0.0, 1.0);
  }
  double border_time(int i) const {
    if (change_[i] == 0.0) return 1e300;
    return (square_[i] + (change_[i] > 0.0 ? 1.0 : 0.0) - start_[i]) / change_[i];
  }
  void enter(int i, double time) {
    const double u = BetweenCenters::snapped(at(i, time));
    square_[i] = static_cast<int>(std::floor(u)) - (change_[i] < 0.0 && u == std::floor(u) ? 1 : 0);
  }

  const ClearanceField& field_;
  double radius_m_;
  double start_[2]{};
  double change_[2]{};
  int square_[2]{};
};

TEST(LineOfSight, AnswersAsThePlainWalkAndBlockersAreRight) {
  int free = 0;
  int known = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    std::mt19937 random(seed);
    const OccupancyGrid grid = random_grid(random, seed % 3 == 0 ? 60 : 20);
    const Geometry& g = grid.geometry();
    const ClearanceField field(grid, 100.0 * g.resolution_m);
    const double radius_m =
        seed % 4 == 0 ? 1e-6 : g.resolution_m * std::uniform_real_distribution<double>(0.0, 4.0)(random);
    for (int i = 0; i < 20; ++i) {
      // A fan of lines from one eye, as the passes try them; half of them between centres.
      const auto place = [&](Point2 p) { return i % 2 == 0 ? p : g.center_in_map(g.cell_at(p)); };
      const Point2 eye = place(random_point(random, g));
      const Point2 begin = place(random_point(random, g));
      const Point2 end = place(random_point(random, g));
      Blocker last;
      for (int k = 0; k <= 20; ++k) {
        const Point2 sample = place(begin + (k / 20.0) * (end - begin));
        const bool expected = PlainWalk(field, radius_m).is_free(eye, sample);
        Blocker blocker;
        ASSERT_EQ(is_line_free(field, eye, sample, radius_m, &blocker), expected)
            << "seed " << seed << " line " << i << " " << k;
        ASSERT_FALSE(expected && last.blocks(g, eye, sample, radius_m)) << "seed " << seed << " line " << i << " " << k;
        free += expected ? 1 : 0;
        known += !expected && blocker.blocks(g, eye, sample, radius_m) ? 1 : 0;
        if (!expected) last = blocker;
      }
    }
  }
  EXPECT_GT(free, 5000);
  EXPECT_GT(known, 10000);
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
