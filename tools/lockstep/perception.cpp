#include "tools/lockstep/perception.hpp"

#include "services/fake-vehicle/core/lidar.hpp"

namespace aisle::lockstep {
namespace {

using geometry::Body;

Body body_of(const Sensor& sensor) { return geometry::body_of(sensor.footprint, sensor.base_in_map); }

obstacle_tracker::KnownVehicle known_vehicle(const Sensor& s, time::Stamp now) {
  const geometry::Footprint& f = s.footprint;
  return {s.agv_id, !f.is_disc(), geometry::reach_m(f), f.length_m, f.width_m, s.believed_in_map, s.twist,
          now,      f.ahead_m};
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

}  // namespace aisle::lockstep
