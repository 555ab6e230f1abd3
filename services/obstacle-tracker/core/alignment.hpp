#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "services/obstacle-tracker/core/detections.hpp"

namespace aisle::obstacle_tracker {

/// Where a known thing was expected at a detection's moment.
struct Prediction {
  Eigen::Vector2d position;  // in map
  Eigen::Matrix2d covariance;
};

/// The error of the vehicle's pose moves and turns everything that one scan shows in the same way; the things that are
/// known already tell how far. Takes that common part out of the detections, and out of their covariance what is known
/// of it by then.
///
/// Least squares over (x, y, yaw) with the noise of the pose as prior. Each detection is corrected by what the *others*
/// say, so that no track pulls its own measurement towards what it expects. Pairs further off than `gate` (squared
/// Mahalanobis distance) say nothing: who turned or started is no mark. `predictions`: one a detection; none where
/// nothing was expected.
void align(std::vector<Detection>& detections, const std::vector<std::optional<Prediction>>& predictions,
           geometry::Point2 sensor_in_map, const SensorNoise& noise, double gate);

}  // namespace aisle::obstacle_tracker
