#pragma once
#include <Eigen/Core>
#include <optional>
#include <vector>

#include "services/obstacle-tracker/core/detections.hpp"

namespace aisle::obstacle_tracker {

/// A track's predicted position at a detection's moment.
struct Prediction {
  Eigen::Vector2d position;  // in map
  Eigen::Matrix2d covariance;
};

/// The error of the vehicle's pose shifts and turns all detections of a scan alike, so that the differences between
/// detections and the tracks' predictions estimate it. Removes the estimate from the detections, and what is known of
/// the pose by then from their covariances.
///
/// How: least squares over (x, y, yaw) with the noise of the pose as prior. Each detection is corrected by an estimate
/// from the *other* ones, so that no track pulls its own measurement towards its prediction. Pairs beyond `gate`
/// (squared Mahalanobis distance) are left out: they are of an obstacle that turned or started. `predictions`: one for
/// each detection; none where no track was expected.
void align(std::vector<Detection>& detections, const std::vector<std::optional<Prediction>>& predictions,
           geometry::Point2 sensor_in_map, const SensorNoise& noise, double gate);

}  // namespace aisle::obstacle_tracker
