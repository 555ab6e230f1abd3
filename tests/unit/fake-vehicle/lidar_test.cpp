#include "services/fake-vehicle/core/lidar.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace aisle::fake_vehicle {
namespace {

/// 20 x 20 m, walls in the outermost cells.
grid::OccupancyGrid room() {
  grid::OccupancyGrid grid(grid::Geometry{400, 400, 0.05, {0.0, 0.0}});
  for (int i = 0; i < 400; ++i) {
    for (const grid::Cell c : {grid::Cell{i, 0}, grid::Cell{i, 399}, grid::Cell{0, i}, grid::Cell{399, i}})
      grid.set(c, grid::Occupancy::kOccupied);
  }
  return grid;
}

LidarParameters exact() {
  LidarParameters lidar;
  lidar.range_noise_m = 0.0;
  return lidar;
}

geometry::Body disc(double x, double y, double radius_m) {
  geometry::Body body;
  body.base_in_map = {x, y, 0.0};
  body.radius_m = radius_m;
  return body;
}

class Lidar : public ::testing::Test {
 protected:
  grid::OccupancyGrid walls_{room()};
  std::mt19937_64 random_{1};
};

TEST_F(Lidar, SeesWallsAheadAndNothingBeyondItsRange) {
  const std::vector<float> ranges = scan({walls_, {}}, {5.0, 10.0, geometry::kPi}, exact(), random_);
  ASSERT_EQ(ranges.size(), 360u);
  EXPECT_NEAR(ranges[0], 4.95, 1e-4);   // ahead is the wall at x = 0.05
  EXPECT_FLOAT_EQ(ranges[180], 10.0f);  // behind it is 14.95 m away
  EXPECT_NEAR(ranges[90], 9.95, 1e-4);  // to the left is the wall at y = 0.05
}

TEST_F(Lidar, SeesBodiesInFrontOfWallsAtTheirAngleOnly) {
  const std::vector<geometry::Body> bodies{disc(10.0, 13.0, 0.5)};
  const std::vector<float> ranges = scan({walls_, bodies}, {10.0, 10.0, 0.0}, exact(), random_);
  EXPECT_NEAR(ranges[90], 2.5, 1e-4);
  const int half = static_cast<int>(std::asin(0.5 / 3.0) * 180.0 / geometry::kPi);
  EXPECT_LT(ranges[static_cast<std::size_t>(90 - half)], 3.0f);
  EXPECT_GT(ranges[static_cast<std::size_t>(90 - half - 1)], 9.0f);
}

TEST_F(Lidar, FindsTheSameAsEveryRayAgainstEveryBody) {
  std::vector<geometry::Body> bodies{disc(7, 7, 0.3), disc(10.2, 10.1, 0.05), disc(3, 12, 1.0)};
  geometry::Body block;
  block.shape = geometry::Body::Shape::kRectangle;
  block.base_in_map = {13.0, 9.0, 0.4};
  block.length_m = 0.8;
  block.width_m = 2.0;
  bodies.push_back(block);
  for (double yaw = -3.0; yaw < 3.1; yaw += 0.7) {
    const geometry::Pose2 base{10.0, 10.0, yaw};
    const std::vector<float> with = scan({walls_, bodies}, base, exact(), random_);
    const std::vector<float> without = scan({walls_, {}}, base, exact(), random_);
    for (std::size_t i = 0; i < with.size(); ++i) {
      double nearest = without[i];
      for (const geometry::Body& body : bodies) {
        nearest = std::min(nearest, geometry::ray_hit_m(body, base.position(),
                                                        yaw + static_cast<double>(i) * geometry::kPi / 180.0, 10.0));
      }
      EXPECT_NEAR(with[i], nearest, 1e-4) << "yaw " << yaw << " ray " << i;
    }
  }
}

TEST_F(Lidar, NoiseHasTheGivenSpreadAndNeverHidesAWall) {
  LidarParameters lidar;
  lidar.range_noise_m = 0.02;
  const std::vector<float> ideal = scan({walls_, {}}, {10.0, 10.0, 0.0}, exact(), random_);
  double sum2 = 0.0;
  int count = 0;
  for (int n = 0; n < 20; ++n) {
    const std::vector<float> noisy = scan({walls_, {}}, {10.0, 10.0, 0.0}, lidar, random_);
    for (std::size_t i = 0; i < noisy.size(); ++i) {
      if (ideal[i] >= 10.0f) {
        EXPECT_FLOAT_EQ(noisy[i], 10.0f);
        continue;
      }
      EXPECT_LT(noisy[i], 10.0f);
      if (ideal[i] > 9.96f) continue;  // cut off by the range
      sum2 += std::pow(noisy[i] - ideal[i], 2);
      ++count;
    }
  }
  ASSERT_GT(count, 100);
  EXPECT_NEAR(std::sqrt(sum2 / count), 0.02, 0.004);
}

}  // namespace
}  // namespace aisle::fake_vehicle
