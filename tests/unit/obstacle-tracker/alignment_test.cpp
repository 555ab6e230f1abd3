#include "services/obstacle-tracker/core/alignment.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace aisle::obstacle_tracker {
namespace {

using geometry::Point2;

constexpr double kGate = 6.0;
const Point2 kSensor{1.0, 2.0};
const Eigen::Matrix2d kSmall = Eigen::Matrix2d::Identity() * 0.01 * 0.01;

/// A thing at `truth`, seen from a pose that is wrong by this much.
Detection seen(Point2 truth, const geometry::Pose2& error, const SensorNoise& noise) {
  const Point2 arm = truth - kSensor;
  Detection detection;
  detection.position_in_map = geometry::to_map({kSensor.x + error.x, kSensor.y + error.y, error.yaw}, arm);
  detection.surface_in_map = {detection.position_in_map};
  detection.view_covariance = kSmall;
  const double swing_m = noise.yaw_rad * geometry::norm(arm);
  detection.covariance = kSmall + Eigen::Matrix2d::Identity() * (noise.pose_m * noise.pose_m + swing_m * swing_m);
  return detection;
}

Prediction expected(Point2 truth) { return {{truth.x, truth.y}, kSmall}; }

TEST(Alignment, TakesOutTheErrorOfThePose) {
  const SensorNoise noise;
  const std::vector<Point2> things{{6.0, 2.0}, {1.0, 8.0}, {-4.0, 0.0}, {3.0, -3.0}, {7.0, 6.0}};
  std::vector<Detection> detections;
  std::vector<std::optional<Prediction>> predictions;
  for (const Point2 thing : things) {
    detections.push_back(seen(thing, {0.02, -0.02, 0.01}, noise));
    predictions.emplace_back(expected(thing));
  }
  const std::vector<Detection> before = detections;
  align(detections, predictions, kSensor, noise, kGate);
  for (std::size_t i = 0; i < things.size(); ++i) {
    const double was_m = geometry::distance(before[i].position_in_map, things[i]);
    EXPECT_LT(geometry::distance(detections[i].position_in_map, things[i]), 0.35 * was_m) << i;
    EXPECT_LT(detections[i].covariance.trace(), before[i].covariance.trace()) << i;
    EXPECT_EQ(detections[i].surface_in_map[0], detections[i].position_in_map) << i;
  }
}

TEST(Alignment, PullsNoThingTowardsItsOwnPrediction) {
  const SensorNoise noise;
  std::vector<Detection> detections{seen({6.0, 2.0}, {0.02, 0.0, 0.01}, noise)};
  const Point2 before = detections[0].position_in_map;
  align(detections, {expected({6.0, 2.0})}, kSensor, noise, kGate);
  EXPECT_NEAR(geometry::distance(detections[0].position_in_map, before), 0.0, 1e-9);
}

TEST(Alignment, CorrectsWhatWasNotExpectedAsWell) {
  const SensorNoise noise;
  const geometry::Pose2 error{0.0, 0.0, 0.012};
  std::vector<Detection> detections{seen({8.0, 2.0}, error, noise), seen({-6.0, 2.0}, error, noise),
                                    seen({1.0, 9.0}, error, noise)};
  align(detections, {expected({8.0, 2.0}), expected({-6.0, 2.0}), std::nullopt}, kSensor, noise, kGate);
  EXPECT_LT(geometry::distance(detections[2].position_in_map, {1.0, 9.0}), 0.03);  // it was 8 cm off
}

TEST(Alignment, DoesNotListenToWhoTurned) {
  const SensorNoise noise;
  std::vector<Detection> detections{seen({6.0, 2.0}, {}, noise), seen({1.0, 8.0}, {}, noise)};
  detections[0].position_in_map = {6.0, 2.6};
  align(detections, {expected({6.0, 2.0}), expected({1.0, 8.0})}, kSensor, noise, kGate);
  EXPECT_NEAR(geometry::distance(detections[1].position_in_map, {1.0, 8.0}), 0.0, 1e-9);
}

}  // namespace
}  // namespace aisle::obstacle_tracker
