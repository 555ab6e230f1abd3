#include "services/obstacle-tracker/core/alignment.hpp"

#include <Eigen/Dense>
#include <algorithm>

namespace aisle::obstacle_tracker {
namespace {

using Effect = Eigen::Matrix<double, 2, 3>;  // of an error of the pose (x, y, yaw) on a point

/// J at a point: by how much it moves when the pose is off by (1 m, 1 m, 1 rad).
Effect effect_on(geometry::Point2 in_map, geometry::Point2 sensor_in_map) {
  const geometry::Point2 arm = in_map - sensor_in_map;

  Effect effect;
  effect << 1.0, 0.0, -arm.y, 0.0, 1.0, arm.x;

  return effect;
}

/// What is known of the pose's error.
struct Knowledge {
  Eigen::Matrix3d information{Eigen::Matrix3d::Zero()};
  Eigen::Vector3d sum{Eigen::Vector3d::Zero()};  // information x mean
};

/// Before any detection is compared: the error is 0, give or take the noise of the pose.
Knowledge prior(const SensorNoise& noise) {
  constexpr double kLeast = 1e-5;  // a noise of 0 has no inverse
  const double pose_m = std::max(kLeast, noise.pose_m);

  const double yaw_rad = std::max(kLeast, noise.yaw_rad);

  Knowledge knowledge;
  knowledge.information.diagonal() << 1.0 / (pose_m * pose_m), 1.0 / (pose_m * pose_m), 1.0 / (yaw_rad * yaw_rad);

  return knowledge;
}

/// What one detection says of it, as information: J' W J and J' W r with the residual r = detection - prediction; none
/// when the residual is beyond the gate.
std::optional<Knowledge> told_by(const Detection& detection, const Prediction& prediction, const Effect& effect,
                                 double gate) {
  // Gate: r' S^-1 r with the whole covariance S, the pose's part included.

  const Eigen::Vector2d residual =
      Eigen::Vector2d(detection.position_in_map.x, detection.position_in_map.y) - prediction.position;
  const Eigen::Matrix2d whole = prediction.covariance + detection.covariance;
  if (residual.dot(whole.inverse() * residual) > gate) return std::nullopt;

  // Weight: without the pose's part, as that is what is to be estimated.
  const Eigen::Matrix2d weight = (prediction.covariance + detection.view_covariance).inverse();

  Knowledge told;
  told.information = effect.transpose() * weight * effect;
  told.sum = effect.transpose() * weight * residual;

  return told;
}

}  // namespace

void align(std::vector<Detection>& detections, const std::vector<std::optional<Prediction>>& predictions,
           geometry::Point2 sensor_in_map, const SensorNoise& noise, double gate) {
  // Sum what all detections say.
  Knowledge all = prior(noise);
  std::vector<std::optional<Knowledge>> told(detections.size());
  for (std::size_t d = 0; d < detections.size(); ++d) {
    if (!predictions[d]) continue;

    told[d] = told_by(detections[d], *predictions[d], effect_on(detections[d].position_in_map, sensor_in_map), gate);
    if (!told[d]) continue;

    all.information += told[d]->information;
    all.sum += told[d]->sum;
  }

  // Correct each by the estimate of all others: e = (sum of information)^-1 (sum of information x mean).
  for (std::size_t d = 0; d < detections.size(); ++d) {
    Detection& detection = detections[d];
    const Effect effect = effect_on(detection.position_in_map, sensor_in_map);
    const Knowledge others = told[d] ? Knowledge{all.information - told[d]->information, all.sum - told[d]->sum} : all;
    const Eigen::Matrix3d covariance = others.information.inverse();

    // p -= J e, and the covariance that stays: R_view + J P J'.
    const Eigen::Vector2d shift = effect * (covariance * others.sum);
    detection.position_in_map = detection.position_in_map - geometry::Point2{shift.x(), shift.y()};
    for (geometry::Point2& hit : detection.surface_in_map) hit = hit - geometry::Point2{shift.x(), shift.y()};

    detection.covariance = detection.view_covariance + effect * covariance * effect.transpose();
  }
}

}  // namespace aisle::obstacle_tracker
