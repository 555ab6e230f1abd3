#pragma once
#include <functional>
#include <set>
#include <vector>

#include "services/obstacle-tracker/core/tracker.hpp"
#include "tests/unit/obstacle-tracker/simulated_lidar.hpp"

namespace aisle::obstacle_tracker::test {

/// Runs a tracker on simulated scans: each vehicle scans at 10 Hz, the vehicles one after another within the tenth of a
/// second.
class Stage {
 public:
  Stage(const grid::OccupancyGrid& walls, std::vector<Vehicle> vehicles, unsigned seed, const Noise& noise = {})
      : world(walls), fleet(std::move(vehicles)), lidar(seed, noise) {}

  /// Before each scan `arrange(seconds)` puts things in their places; after it `judge(seconds)` looks.
  void run(double until_s, const std::function<void(double)>& arrange, const std::function<void(double)>& judge = {}) {
    while (now_s < until_s - 1e-9) {
      const auto turn = static_cast<std::size_t>(scans % static_cast<int>(fleet.size()));
      arrange(now_s);
      const time::Stamp stamp = start + time::from_seconds(now_s);
      const Scan scan = lidar.scan(world, fleet[turn], fleet, stamp);
      newest = tracker.take(scan, lidar.known(fleet, stamp), &world.clearance, stamp);
      tracks = tracker.tracks(stamp);
      for (const Track& track : tracks) ids.insert(track.id);
      if (judge) judge(now_s);
      ++scans;
      now_s += 0.1 / static_cast<double>(fleet.size());
    }
  }

  /// The published track nearest to a point; nullptr when none is within `within_m`.
  const Track* track_at(Point2 in_map, double within_m = 0.5) const {
    const Track* best = nullptr;
    for (const Track& track : tracks) {
      const double away_m = geometry::distance(track.position_in_map, in_map);
      if (away_m < within_m) {
        within_m = away_m;
        best = &track;
      }
    }
    return best;
  }

  World world;
  std::vector<Vehicle> fleet;
  Lidar lidar;
  Tracker tracker;
  TakeResult newest;
  std::vector<Track> tracks;
  std::set<std::uint64_t> ids;  // every id that was ever published
  time::Stamp start{std::chrono::hours(1)};
  double now_s{0.0};
  int scans{0};
};

}  // namespace aisle::obstacle_tracker::test
