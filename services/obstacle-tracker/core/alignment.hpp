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

/// Removes the error of the scanning vehicle's pose from a scan's detections, as far as the tracks show it.
///
/// The error of the pose shifts and turns all detections of a scan alike, so that the differences between detections
/// and the tracks' predictions estimate it. The estimate is subtracted from the detections' positions, and their
/// covariances keep only what remains unknown of the pose.
///
/// How: linear least squares over e = (x, y, yaw) of the pose, with the noise of the pose as prior. A detection at p is
/// off by J e, J = [1 0 -(p - s)_y; 0 1 (p - s)_x] with s the sensor. Each detection is corrected by an estimate from
/// the *other* ones, so that no track pulls its own measurement towards its prediction. Pairs beyond `gate` (squared
/// Mahalanobis distance) are left out: their obstacle turned or started.
/// @param detections of one scan; changed in place
/// @param predictions one for each detection; none where no track was expected
/// @param sensor_in_map place of the scanner at the middle of the sweep
void align(std::vector<Detection>& detections, const std::vector<std::optional<Prediction>>& predictions,
           geometry::Point2 sensor_in_map, const SensorNoise& noise, double gate);

}  // namespace aisle::obstacle_tracker
