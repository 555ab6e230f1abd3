// What one scan makes of things that it shows in part: one detection, as sure as it may be.
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "services/obstacle-tracker/core/detections.hpp"
#include "services/obstacle-tracker/core/tracker.hpp"
#include "tests/unit/obstacle-tracker/stage.hpp"

namespace aisle::obstacle_tracker::test {
namespace {

constexpr double kHonestNees = 3.0;  // 2 degrees of freedom: 2 on average, and some for shapes that are guessed

Vehicle vehicle_at(double x, double y, double yaw = 0.0) { return {"a", {x, y, yaw}, {}, 0.35, 10.0, 360}; }

std::vector<Detection> detections_of(const World& world, const Vehicle& vehicle, unsigned seed) {
  Lidar lidar(seed);
  const time::Stamp now{std::chrono::seconds(100)};
  const Scan scan = lidar.scan(world, vehicle, {vehicle}, now);
  const TrackerParams params;
  const SortedScan sorted =
      sort_rays(scan, world.clearance, lidar.known({vehicle}, now), params.noise, params.explained);
  return find_detections(scan, sorted, find_clusters(scan, sorted, params.clustering), {}, params.noise, params.shape);
}

double nees_of(const Detection& detection, Point2 truth) {
  const Point2 off = detection.position_in_map - truth;
  const Eigen::Vector2d error(off.x, off.y);
  return error.dot(detection.covariance.inverse() * error);
}

/// Standard deviation of the position in a direction.
double sigma_m(const Detection& detection, Point2 direction) {
  const Eigen::Vector2d d(direction.x, direction.y);
  return std::sqrt(d.dot(detection.covariance * d) / d.squaredNorm());
}

double uncovered_m(const Detection& detection) {
  double worst_m = 0.0;
  for (const Point2 hit : detection.surface_in_map) {
    worst_m = std::max(worst_m, geometry::distance(hit, detection.position_in_map) - detection.radius_m);
  }
  return worst_m;
}

TEST(PartialView, TakesAPersonHalfBehindAPillarForOneAndIsLessSureAcross) {
  for (const double shown_m : {0.2, 0.3, 0.4}) {  // of the person's 0.5 m
    grid::OccupancyGrid walls = room(16.0, 12.0);
    fill(walls, {8.0, 4.0}, {9.5, 4.3});  // seen from (8, 1): hides all to the right of x = 8
    World world(walls);
    const Point2 person{8.25 - shown_m, 6.0};
    world.discs = {{person, 0.25}};
    double nees = 0.0;
    constexpr unsigned kSeeds = 60;
    double across_m = 0.0;
    double whole_m = 0.0;
    for (unsigned seed = 1; seed <= kSeeds; ++seed) {
      const std::vector<Detection> found = detections_of(world, vehicle_at(8.0, 1.0, 0.1 * seed), seed);
      ASSERT_EQ(found.size(), 1U) << shown_m << ", seed " << seed;
      EXPECT_TRUE(found[0].is_partial) << shown_m << ", seed " << seed;
      nees += nees_of(found[0], person) / kSeeds;
      across_m += sigma_m(found[0], {1.0, 0.0}) / kSeeds;
      World open(room(16.0, 12.0));
      open.discs = world.discs;
      const std::vector<Detection> whole = detections_of(open, vehicle_at(8.0, 1.0, 0.1 * seed), seed);
      ASSERT_EQ(whole.size(), 1U);
      whole_m += sigma_m(whole[0], {1.0, 0.0}) / kSeeds;
    }
    RecordProperty("nees_" + std::to_string(static_cast<int>(100 * shown_m)), std::to_string(nees));
    EXPECT_LT(nees, kHonestNees) << shown_m;
    EXPECT_GT(nees, 0.8) << shown_m;  // nor far less sure than it may be: one of the edges shows
    EXPECT_GT(across_m, 1.05 * whole_m) << shown_m;
  }
}

TEST(PartialView, TakesThePartOfAPersonThatAnotherLeavesInSightForOne) {
  World world(room(16.0, 12.0));
  const Point2 rear{8.3, 6.0};
  world.discs = {{{8.0, 4.5}, 0.25}, {rear, 0.25}};  // from (8, 1): the nearer one hides the left part of the other
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const std::vector<Detection> found = detections_of(world, vehicle_at(8.0, 1.0), seed);
    ASSERT_EQ(found.size(), 2U) << "seed " << seed;
    const auto back = std::max_element(found.begin(), found.end(), [](const Detection& a, const Detection& b) {
      return a.position_in_map.y < b.position_in_map.y;
    });
    EXPECT_TRUE(back->is_partial) << "seed " << seed;
    EXPECT_LT(nees_of(*back, rear), 13.8) << "seed " << seed;
  }
}

/// A pallet with two faces in sight, at slants at which the rays do not just graze one of them.
TEST(PartialView, TakesTwoFacesOfAPalletForOneDetection) {
  double nees = 0.0;
  int count = 0;
  for (const Box& size : {Box{{}, 0.8, 0.8}, Box{{}, 1.0, 0.8}, Box{{}, 0.8, 0.6}}) {
    for (int slant = 3; slant < 6; ++slant) {
      for (unsigned seed = 1; seed <= 5; ++seed) {
        World world(room(16.0, 12.0));
        const double yaw = slant * geometry::kPi / 16.0;
        world.boxes = {{{8.0, 6.0, yaw}, size.length_m, size.width_m}};
        const std::vector<Detection> found = detections_of(world, vehicle_at(8.0, 2.5, 0.3 * seed), seed);
        ASSERT_EQ(found.size(), 1U) << size.length_m << " x " << size.width_m << " at " << slant << "/16 pi, seed "
                                    << seed;
        EXPECT_LT(uncovered_m(found[0]), 0.01);
        EXPECT_LT(found[0].radius_m, 0.5 * std::hypot(size.length_m, size.width_m) + 0.15);
        nees += nees_of(found[0], {8.0, 6.0});
        ++count;
      }
    }
  }
  RecordProperty("nees", std::to_string(nees / count));
  EXPECT_LT(nees / count, kHonestNees);
}

}  // namespace
}  // namespace aisle::obstacle_tracker::test
