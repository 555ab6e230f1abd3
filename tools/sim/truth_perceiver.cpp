#include "tools/sim/truth_perceiver.hpp"

#include <algorithm>

#include "common/grid/line_of_sight.hpp"

namespace aisle::sim {
namespace {

using geometry::Point2;

constexpr double kPeriodS = 0.1;

/// In range, and no wall on the line between.
bool is_in_sight(const Sensor& sensor, const fake_world::Thing& thing, const grid::OccupancyGrid& walls,
                 double range_m) {
  const Point2 from = sensor.base_in_map.position();
  const Point2 to = thing.body.base_in_map.position();
  const double d = geometry::distance(from, to);
  const double reach = geometry::reach_m(thing.body);

  return d < range_m && (d <= reach || grid::cast_ray(walls, from, geometry::bearing(from, to), d) >= d - reach);
}

}  // namespace

/// Velocities approach the truth by a share each time; a moving thing that is out of sight moves on for
/// a second, a standing one stays.
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

}  // namespace aisle::sim
