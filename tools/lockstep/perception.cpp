#include "tools/lockstep/perception.hpp"

#include <algorithm>
#include <cmath>

#include "common/grid/line_of_sight.hpp"
#include "services/fake-vehicle/core/lidar.hpp"

namespace aisle::lockstep {
namespace {

using geometry::Body;
using geometry::Point2;

constexpr double kPeriodS = 0.1;

Body body_of(const Sensor& sensor) { return geometry::body_of(sensor.footprint, sensor.base_in_map); }

obstacle_tracker::KnownVehicle known_vehicle(const Sensor& s, time::Stamp now) {
  const geometry::Footprint& f = s.footprint;
  return {s.agv_id, !f.is_disc(), geometry::reach_m(f), f.length_m, f.width_m, s.believed_in_map, s.twist,
          now,      f.ahead_m};
}

bool is_in_sight(const Sensor& sensor, const fake_world::Thing& thing, const grid::OccupancyGrid& walls,
                 double range_m) {
  const Point2 from = sensor.base_in_map.position();
  const Point2 to = thing.body.base_in_map.position();
  const double d = geometry::distance(from, to);
  const double reach = geometry::reach_m(thing.body);
  return d < range_m && (d <= reach || grid::cast_ray(walls, from, geometry::bearing(from, to), d) >= d - reach);
}

}  // namespace

void ScanPerceiver::look(const std::vector<Sensor>& sensors, const TrueWorld& world, time::Stamp now) {
  std::vector<obstacle_tracker::KnownVehicle> known;
  for (const Sensor& s : sensors) known.push_back(known_vehicle(s, now));
  for (const Sensor& sensor : sensors) {
    if (!only_scans_of_.empty() && sensor.agv_id != only_scans_of_) continue;
    std::vector<Body> bodies;
    for (const Sensor& other : sensors)
      if (&other != &sensor) bodies.push_back(body_of(other));
    for (const fake_world::Thing& thing : world.things) bodies.push_back(thing.body);
    obstacle_tracker::Scan scan;
    scan.agv_id = sensor.agv_id;
    scan.stamp = now;
    scan.base_in_map = sensor.believed_in_map;
    scan.twist = sensor.twist;
    scan.angle_step_rad = 2.0 * geometry::kPi / lidar_.rays;
    scan.range_min_m = lidar_.range_min_m;
    scan.range_max_m = lidar_.range_max_m;
    scan.ranges_m = fake_vehicle::scan({world.walls, bodies}, sensor.base_in_map, lidar_, random_);
    const obstacle_tracker::TakeResult result = tracker_.take(scan, known, &world.clearance, now);
    for (const std::uint64_t id : result.lost) {
      sent_.erase(id);
      outbox_.forget(id);
    }
    for (const fleet::Track& track : outbox_.due(tracker_.tracks(now), result.seen, now))
      sent_[track.id] = {track, now};
  }
  tracks_.clear();
  for (const auto& [id, seen] : sent_) tracks_.push_back(seen);
  if (told_ == Told::kAsTracked) return;
  for (local_planner::SeenTrack& seen : tracks_) seen.track.velocity_in_map = {};
}

void TruthPerceiver::look(const std::vector<Sensor>& sensors, const TrueWorld& world, time::Stamp now) {
  std::normal_distribution<double> noise(0.0, 1.0);
  for (auto& [id, memory] : memory_) memory.lost_s += kPeriodS;
  for (const fake_world::Thing& thing : world.things) {
    if (std::none_of(sensors.begin(), sensors.end(),
                     [&](const Sensor& s) { return is_in_sight(s, thing, world.walls, range_m_); }))
      continue;
    Memory& memory = memory_[thing.id];
    if (memory.id == 0) memory.id = next_id_++, memory.velocity = 0.5 * thing.velocity_in_map;
    memory.seen_s += kPeriodS;
    memory.lost_s = 0.0;
    memory.velocity = memory.velocity + 0.35 * (thing.velocity_in_map - memory.velocity);
    memory.standing_s = geometry::norm(thing.velocity_in_map) < 0.05 ? memory.standing_s + kPeriodS : 0.0;
    memory.position = thing.body.base_in_map.position();
    memory.radius_m = geometry::reach_m(thing.body);
  }
  tracks_.clear();
  for (auto entry = memory_.begin(); entry != memory_.end();) {
    Memory& memory = entry->second;
    const bool is_static = memory.standing_s > 3.0;
    if (memory.lost_s > 1.0 && !is_static) {
      entry = memory_.erase(entry);
      continue;
    }
    if (memory.lost_s > 0.0) memory.position = memory.position + kPeriodS * memory.velocity;
    if (memory.seen_s > 0.25) {
      fleet::Track track;
      track.id = memory.id;
      track.is_static = is_static;
      track.position_in_map = memory.position + Point2{0.03 * noise(random_), 0.03 * noise(random_)};
      if (!is_static) track.velocity_in_map = memory.velocity + Point2{0.05 * noise(random_), 0.05 * noise(random_)};
      track.radius_m = memory.radius_m;
      track.covariance[0] = track.covariance[5] = 0.03 * 0.03;
      track.covariance[10] = track.covariance[15] = 0.1 * 0.1;
      track.age_s = memory.seen_s;
      track.unseen_s = memory.lost_s;
      tracks_.push_back({track, now});
    }
    ++entry;
  }
}

}  // namespace aisle::lockstep
