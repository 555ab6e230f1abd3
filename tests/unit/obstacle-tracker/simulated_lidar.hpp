#pragma once
// A world of walls, discs and boxes, and lidars in it, with noise by seed: what the tracker's tests are judged against.
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "common/geometry/pose.hpp"
#include "common/grid/clearance.hpp"
#include "common/grid/line_of_sight.hpp"
#include "common/grid/occupancy_grid.hpp"
#include "common/kinematics/vehicle_model.hpp"
#include "services/obstacle-tracker/core/scan.hpp"

namespace aisle::obstacle_tracker::test {

using geometry::Point2;
using geometry::Pose2;

struct Disc {
  Point2 center_in_map;
  double radius_m{0.25};
};

struct Box {
  Pose2 center_in_map;
  double length_m{0.8};
  double width_m{0.8};

  std::vector<Point2> corners_in_map() const {
    const double x = 0.5 * length_m;
    const double y = 0.5 * width_m;
    return {geometry::to_map(center_in_map, {x, y}), geometry::to_map(center_in_map, {-x, y}),
            geometry::to_map(center_in_map, {-x, -y}), geometry::to_map(center_in_map, {x, -y})};
  }
};

/// A room of the given size with walls one cell thick all around, at 5 cm a cell.
inline grid::OccupancyGrid room(double width_m, double height_m) {
  grid::Geometry geometry;
  geometry.resolution_m = 0.05;
  geometry.width = static_cast<int>(std::lround(width_m / 0.05));
  geometry.height = static_cast<int>(std::lround(height_m / 0.05));
  grid::OccupancyGrid grid(geometry);
  for (int x = 0; x < geometry.width; ++x) {
    grid.set({x, 0}, grid::Occupancy::kOccupied);
    grid.set({x, geometry.height - 1}, grid::Occupancy::kOccupied);
  }
  for (int y = 0; y < geometry.height; ++y) {
    grid.set({0, y}, grid::Occupancy::kOccupied);
    grid.set({geometry.width - 1, y}, grid::Occupancy::kOccupied);
  }
  return grid;
}

inline void fill(grid::OccupancyGrid& grid, Point2 low_in_map, Point2 high_in_map) {
  const grid::Cell low = grid.geometry().cell_at(low_in_map);
  const grid::Cell high = grid.geometry().cell_at(high_in_map);
  for (int y = low.y; y < high.y; ++y) {
    for (int x = low.x; x < high.x; ++x) grid.set({x, y}, grid::Occupancy::kOccupied);
  }
}

inline double ray_to_disc_m(Point2 from, double angle_rad, const Disc& disc) {
  const Point2 direction{std::cos(angle_rad), std::sin(angle_rad)};
  const Point2 to_center = disc.center_in_map - from;
  const double along = geometry::dot(to_center, direction);
  const double across = geometry::cross(direction, to_center);
  const double half = disc.radius_m * disc.radius_m - across * across;
  if (half < 0.0 || along < 0.0) return std::numeric_limits<double>::infinity();
  return std::max(0.0, along - std::sqrt(half));
}

inline double ray_to_segment_m(Point2 from, double angle_rad, Point2 a, Point2 b) {
  const Point2 direction{std::cos(angle_rad), std::sin(angle_rad)};
  const Point2 edge = b - a;
  const double crossing = geometry::cross(direction, edge);
  if (std::abs(crossing) < 1e-12) return std::numeric_limits<double>::infinity();
  const double along = geometry::cross(a - from, edge) / crossing;
  const double part = geometry::cross(a - from, direction) / crossing;
  return along >= 0.0 && part >= 0.0 && part <= 1.0 ? along : std::numeric_limits<double>::infinity();
}

struct Noise {
  double range_m{0.02};
  double pose_m{0.02};
  double yaw_rad{0.5 * geometry::kPi / 180.0};
};

/// Everything a ray can meet at one moment.
struct World {
  explicit World(const grid::OccupancyGrid& walls) : grid(walls), clearance(walls) {}

  double ray_m(Point2 from, double angle_rad, double max_range_m) const {
    double range_m = grid::cast_ray(grid, from, angle_rad, max_range_m);
    for (const Disc& disc : discs) range_m = std::min(range_m, ray_to_disc_m(from, angle_rad, disc));
    for (const Box& box : boxes) {
      const std::vector<Point2> corners = box.corners_in_map();
      for (std::size_t i = 0; i < 4; ++i)
        range_m = std::min(range_m, ray_to_segment_m(from, angle_rad, corners[i], corners[(i + 1) % 4]));
    }
    return range_m;
  }

  grid::OccupancyGrid grid;
  grid::ClearanceField clearance;
  std::vector<Disc> discs;
  std::vector<Box> boxes;
};

/// A vehicle of the fleet with its lidar: 360 rays, 10 m.
struct Vehicle {
  std::string agv_id;
  Pose2 base_in_map;
  geometry::Twist2 twist;
  double radius_m{0.35};
  double range_m{10.0};
  int rays{360};
};

class Lidar {
 public:
  explicit Lidar(unsigned seed, const Noise& noise = {}) : noise_(noise), random_(seed) {}

  Pose2 believed(const Pose2& base_in_map) {
    return {base_in_map.x + draw(noise_.pose_m), base_in_map.y + draw(noise_.pose_m),
            geometry::wrap(base_in_map.yaw + draw(noise_.yaw_rad))};
  }

  /// What `vehicle` sees, other vehicles included; the rays follow each other within `sweep_s` while it drives on.
  Scan scan(const World& world, const Vehicle& vehicle, const std::vector<Vehicle>& fleet, time::Stamp stamp,
            double sweep_s = 0.0) {
    Scan scan;
    scan.agv_id = vehicle.agv_id;
    scan.stamp = stamp;
    scan.base_in_map = believed(vehicle.base_in_map);
    scan.position_sigma_m = noise_.pose_m;
    scan.yaw_sigma_rad = noise_.yaw_rad;
    scan.twist = vehicle.twist;
    scan.sweep_s = sweep_s;
    scan.first_angle_rad = -geometry::kPi;
    scan.angle_step_rad = 2.0 * geometry::kPi / vehicle.rays;
    scan.range_min_m = 0.05;
    scan.range_max_m = vehicle.range_m;
    for (int ray = 0; ray < vehicle.rays; ++ray) {
      const Pose2 base =
          sweep_s > 0.0 ? kinematics::advance(vehicle.base_in_map, vehicle.twist, sweep_s * ray / (vehicle.rays - 1))
                        : vehicle.base_in_map;
      const double angle_rad = base.yaw + scan.first_angle_rad + ray * scan.angle_step_rad;
      double range_m = world.ray_m(base.position(), angle_rad, vehicle.range_m);
      for (const Vehicle& other : fleet) {
        if (other.agv_id == vehicle.agv_id) continue;
        range_m = std::min(range_m,
                           ray_to_disc_m(base.position(), angle_rad, {other.base_in_map.position(), other.radius_m}));
      }
      if (range_m < vehicle.range_m) range_m = std::clamp(range_m + draw(noise_.range_m), 0.05, vehicle.range_m);
      scan.ranges_m.push_back(static_cast<float>(range_m));
    }
    return scan;
  }

  /// What the fleet says of itself.
  std::vector<KnownVehicle> known(const std::vector<Vehicle>& fleet, time::Stamp stamp) {
    std::vector<KnownVehicle> known;
    for (const Vehicle& vehicle : fleet) {
      known.push_back(
          {vehicle.agv_id, false, vehicle.radius_m, 0.0, 0.0, believed(vehicle.base_in_map), vehicle.twist, stamp});
    }
    return known;
  }

 private:
  double draw(double sigma) { return sigma > 0.0 ? std::normal_distribution<double>(0.0, sigma)(random_) : 0.0; }
  Noise noise_;
  std::mt19937 random_;
};

}  // namespace aisle::obstacle_tracker::test
