#include "services/obstacle-tracker/core/hits.hpp"

#include <algorithm>
#include <cmath>

#include "common/kinematics/vehicle_model.hpp"

namespace aisle::obstacle_tracker {
namespace {

using geometry::Point2;
using geometry::Pose2;

/// A vehicle that may explain hits.
struct Body {
  const KnownVehicle* vehicle;
  Pose2 base_in_map;  // at the scan's stamp
  double margin_m;    // less the part that grows with the range
};

/// The other vehicles that the scan may show, moved on to the moment of its stamp. A vehicle whose state is too old
/// explains nothing. The margin grows with the age of the state.
std::vector<Body> bodies_in_reach(const Scan& scan, const std::vector<KnownVehicle>& vehicles,
                                  const Explained& explained) {
  std::vector<Body> bodies;
  for (const KnownVehicle& vehicle : vehicles) {
    const double age_s = time::seconds(scan.stamp - vehicle.stamp);
    if (vehicle.agv_id == scan.agv_id || std::abs(age_s) > explained.vehicle_max_age_s) continue;

    const Pose2 base_in_map = kinematics::advance(vehicle.base_in_map, vehicle.twist, age_s);
    const double reach_m = scan.range_max_m + vehicle.radius_m + 2.0;
    if (geometry::distance(base_in_map.position(), scan.base_in_map.position()) > reach_m) continue;

    bodies.push_back(
        {&vehicle, base_in_map, explained.vehicle_margin_m + explained.vehicle_growth_mps * std::abs(age_s)});
  }

  return bodies;
}

/// The vehicle's pose at each ray. Rays follow each other at equal times, from the scan's stamp to sweep_s after it,
/// during which the vehicle keeps its twist.
class Sweep {
 public:
  explicit Sweep(const Scan& scan) : scan_(scan), moves_(scan.sweep_s > 0.0 && has_motion(scan.twist)) {
    const auto rays = static_cast<double>(scan.ranges_m.size());
    ray_period_s_ = rays > 1.0 ? scan.sweep_s / (rays - 1.0) : 0.0;
  }

  /// When the ray was measured, and where the vehicle was then; from the scan's stamp.
  double offset_s(std::size_t ray) const { return ray_period_s_ * static_cast<double>(ray); }

  Pose2 base_in_map(double offset_s) const {
    return moves_ ? kinematics::advance(scan_.base_in_map, scan_.twist, offset_s) : scan_.base_in_map;
  }

 private:
  static bool has_motion(const geometry::Twist2& t) {
    return std::abs(t.linear_mps) > 1e-3 || std::abs(t.angular_radps) > 1e-3 || std::abs(t.sideways_mps) > 1e-3;
  }

  const Scan& scan_;
  bool moves_;
  double ray_period_s_{0.0};
};

}  // namespace

SensorNoise SensorNoise::in(const Scan& scan) const {
  return {range_m, std::max(pose_m, scan.position_sigma_m), std::max(yaw_rad, scan.yaw_sigma_rad)};
}

double SensorNoise::across_m(double range_m_of_hit) const {
  return std::sqrt(range_m * range_m + pose_m * pose_m + yaw_rad * yaw_rad * range_m_of_hit * range_m_of_hit);
}

double distance_to_body_m(const KnownVehicle& vehicle, const Pose2& base_in_map, Point2 in_map) {
  if (!vehicle.is_rectangle)
    return std::max(0.0, geometry::distance(base_in_map.position(), in_map) - vehicle.radius_m);

  // To a rectangle, in the vehicle's frame.
  const Point2 in_base = geometry::from_map(base_in_map, in_map);

  const double beyond_x_m = std::max(0.0, std::abs(in_base.x - vehicle.ahead_m) - 0.5 * vehicle.length_m);
  const double beyond_y_m = std::max(0.0, std::abs(in_base.y) - 0.5 * vehicle.width_m);

  return std::hypot(beyond_x_m, beyond_y_m);
}

SortedScan sort_rays(const Scan& scan, const grid::ClearanceField& clearance, const std::vector<KnownVehicle>& vehicles,
                     const SensorNoise& noise, const Explained& explained) {
  const Sweep sweep(scan);
  const std::vector<Body> bodies = bodies_in_reach(scan, vehicles, explained);
  const Pose2 middle_in_map = sweep.base_in_map(0.5 * scan.sweep_s);

  SortedScan sorted;
  sorted.sensor_in_map = middle_in_map.position();
  sorted.middle_bearing_of_first_rad = middle_in_map.yaw + scan.first_angle_rad;
  sorted.ends.assign(scan.ranges_m.size(), RayEnd::kNothing);

  for (std::size_t ray = 0; ray < scan.ranges_m.size(); ++ray) {
    // Rays without a hit.
    const auto range_m = static_cast<double>(scan.ranges_m[ray]);
    if (range_m >= scan.range_max_m) continue;

    if (range_m < scan.range_min_m) {
      sorted.ends[ray] = RayEnd::kTooNear;
      continue;
    }

    // The hit in map: p = base + r (cos b, sin b) with b = yaw + first_angle + i angle_step.
    const double offset_s = sweep.offset_s(ray);
    const Pose2 base_in_map = sweep.base_in_map(offset_s);
    const double bearing_rad = base_in_map.yaw + scan.first_angle_rad + scan.angle_step_rad * static_cast<double>(ray);
    const Point2 hit_in_map{base_in_map.x + range_m * std::cos(bearing_rad),
                            base_in_map.y + range_m * std::sin(bearing_rad)};

    // Walls first, then vehicles; both by a margin and so many sigma of the hit's place.
    const double blur_m = explained.sigmas * noise.across_m(range_m);
    if (clearance.clearance_m(hit_in_map) <= explained.wall_margin_m + blur_m) {
      sorted.ends[ray] = RayEnd::kWall;
      continue;
    }

    const bool is_vehicle = std::any_of(bodies.begin(), bodies.end(), [&](const Body& body) {
      return distance_to_body_m(*body.vehicle, body.base_in_map, hit_in_map) <= body.margin_m + blur_m;
    });

    sorted.ends[ray] = is_vehicle ? RayEnd::kVehicle : RayEnd::kUnknown;
    if (!is_vehicle) sorted.hits.push_back({hit_in_map, range_m, bearing_rad, offset_s, static_cast<int>(ray)});
  }

  return sorted;
}

}  // namespace aisle::obstacle_tracker
