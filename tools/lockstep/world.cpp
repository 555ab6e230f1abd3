#include "tools/lockstep/world.hpp"

#include <algorithm>
#include <cmath>

#include "common/grid/line_of_sight.hpp"

namespace aisle::lockstep {

using geometry::Point2;
using geometry::Pose2;
using geometry::Twist2;

Wheels::Wheels(const VehicleSetup& setup, double dead_time_s)
    : limits_(setup.vehicle.limits), base_in_map_(setup.start_in_map), dead_time_s_(dead_time_s) {}

void Wheels::step(const Twist2& command, double dt_s) {
  const auto delay = static_cast<std::size_t>(std::lround(dead_time_s_ / dt_s));
  pipe_.push_back(command);
  Twist2 wanted;
  if (pipe_.size() > delay) {
    wanted = pipe_.front();
    pipe_.erase(pipe_.begin());
  }
  twist_ = kinematics::limit_change(twist_, wanted, limits_, dt_s);
  base_in_map_ = kinematics::advance(base_in_map_, twist_, dt_s);
}

Walker::Walker(const MoverSetup& setup) : setup_(setup), position_(setup.waypoints_in_map.front()) {}

void Walker::step(double t_s, double dt_s, const std::vector<local_planner::Disc>& vehicles) {
  velocity_ = {};
  if (t_s < setup_.start_s) return;
  const auto count = setup_.waypoints_in_map.size();
  present_ = next_ < count;
  if (!present_) return;
  const Point2 target = setup_.waypoints_in_map[next_];
  const double left = geometry::distance(position_, target);
  const double step = setup_.speed_mps * dt_s;
  if (left <= step) {
    position_ = target;
    const bool at_end = (direction_ > 0 && next_ + 1 == count) || (direction_ < 0 && next_ == 0);
    if (at_end && !setup_.loop) next_ = count;
    else {
      if (at_end) direction_ = -direction_;
      next_ = static_cast<std::size_t>(static_cast<int>(next_) + direction_);
    }
    return;
  }
  const Point2 heading = (1.0 / left) * (target - position_);
  if (setup_.courteous)
    for (const local_planner::Disc& vehicle : vehicles) {
      const Point2 d = vehicle.position - position_;
      if (geometry::norm(d) < vehicle.radius_m + setup_.radius_m + 0.6 && geometry::dot(d, heading) > 0.0) return;
    }
  velocity_ = setup_.speed_mps * heading;
  position_ = position_ + step * heading;
}

void PerfectTracker::scan(const std::vector<Body>& bodies, const std::vector<Pose2>& sensors, const grid::OccupancyGrid& grid) {
  std::normal_distribution<double> noise(0.0, 1.0);
  memory_.resize(bodies.size());
  tracks_.clear();
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const Body& body = bodies[i];
    Memory& memory = memory_[i];
    const bool visible = body.present && std::any_of(sensors.begin(), sensors.end(), [&](const Pose2& sensor) {
      const double d = geometry::distance(sensor.position(), body.position);
      return d < range_m_ && (d <= body.radius_m || grid::cast_ray(grid, sensor.position(), geometry::bearing(sensor.position(), body.position), d) >= d - body.radius_m);
    });
    if (!visible) {
      memory.lost_s += 0.1;
      if (memory.lost_s > 1.0) memory.seen_s = 0.0;
    } else {
      if (memory.seen_s == 0.0) memory = {}, memory.velocity = 0.5 * body.velocity;
      memory.seen_s += 0.1;
      memory.lost_s = 0.0;
      memory.velocity = memory.velocity + 0.35 * (body.velocity - memory.velocity);
      memory.standing_s = geometry::norm(body.velocity) < 0.05 ? memory.standing_s + 0.1 : 0.0;
      memory.position = body.position;
    }
    if (memory.seen_s < 0.25) continue;
    if (memory.lost_s > 0.0) memory.position = memory.position + 0.1 * memory.velocity;
    local_planner::SeenTrack seen;
    seen.track.id = i + 1;
    seen.track.is_static = memory.standing_s > 3.0;
    seen.track.position_in_map = memory.position + Point2{0.03 * noise(random_), 0.03 * noise(random_)};
    seen.track.velocity_in_map = seen.track.is_static ? Point2{} : memory.velocity + Point2{0.05 * noise(random_), 0.05 * noise(random_)};
    seen.track.radius_m = body.radius_m;
    seen.track.covariance[0] = seen.track.covariance[5] = 0.03 * 0.03;
    seen.track.covariance[10] = seen.track.covariance[15] = 0.1 * 0.1;
    seen.track.age_s = memory.seen_s;
    seen.track.unseen_s = memory.lost_s > 1e8 ? 0.0 : memory.lost_s;
    tracks_.push_back(seen);
  }
}

double distance_to_square_m(Point2 p, Point2 center, double edge_m) {
  const double dx = std::max(0.0, std::abs(p.x - center.x) - 0.5 * edge_m);
  const double dy = std::max(0.0, std::abs(p.y - center.y) - 0.5 * edge_m);
  return std::hypot(dx, dy);
}

double distance_to_walls_m(const grid::OccupancyGrid& grid, Point2 p) {
  const auto& g = grid.geometry();
  const grid::Cell c = g.cell_at(p);
  const int reach = static_cast<int>(std::ceil(1.0 / g.resolution_m));
  double least = 2.0;
  for (int y = c.y - reach; y <= c.y + reach; ++y)
    for (int x = c.x - reach; x <= c.x + reach; ++x)
      if (!grid.is_free({x, y})) least = std::min(least, distance_to_square_m(p, g.center_in_map({x, y}), g.resolution_m));
  return least;
}

}  // namespace aisle::lockstep
