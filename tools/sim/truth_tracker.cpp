#include "tools/sim/truth_tracker.hpp"

#include <chrono>
#include <utility>
#include <vector>

namespace aisle::sim {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kTick{20};
constexpr int kLookEvery = 5;  // ticks
constexpr int kTellAfter = 2;  // ticks from a look to its tracks: what sensor and tracker take
constexpr double kWallsReachM = 2.0;

/// Ids of a boot begin where those of an earlier one cannot be, and stay exact in JSON (below 2^53).
std::uint64_t first_id(std::uint64_t boot_id_us) { return boot_id_us / 1000 % 10'000'000'000ULL * 100'000; }

}  // namespace

TruthTracker::TruthTracker(service::Shell& shell, double range_m, std::uint64_t seed)
    : shell_(shell),
      map_(shell.map({{}, true, kWallsReachM, milliseconds(300)})),
      tracks_(shell.outbox<topics::Track>()),
      statuses_(shell.outbox<topics::TrackingStatus>()),
      perceiver_(range_m, seed) {
  shell.inbox<topics::WorldObstacle>([this](const fleet::Obstacle& obstacle) { take(obstacle); })
      .on_gone([this](const std::string& id, service::End) { things_.erase(id); });
  shell.inbox<topics::Scan>([this](const fleet::Scan& scan, const service::Sender& from) {
    newest_scans_[scan.agv_id] = fleet::ScanUse{scan.agv_id, from.by.sequence_number, from.by.stamp_ns};
  });

  shell.every(kTick, [this] { tick(); });
  shell.report([this](service::Health& health) {
    if (!map_.has_map()) health.wait_for("map_info, map_tile");
  });
}

void TruthTracker::take(const fleet::Obstacle& obstacle) {
  if (obstacle.kind == fleet::Obstacle::Kind::kVehicle) {
    sensors_[obstacle.id] = {obstacle.id, obstacle.base_in_map};
    return;
  }

  const bool is_person = obstacle.kind == fleet::Obstacle::Kind::kPerson;
  things_[obstacle.id] = {obstacle.id, is_person ? fake_world::Kind::kPerson : fake_world::Kind::kBlock,
                          obstacle.body(), obstacle.velocity_in_map};
}

void TruthTracker::tick() {
  const int phase = ticks_++ % kLookEvery;
  if (!map_.has_map()) return;
  if (phase == 0) look();
  if (phase == kTellAfter) tell();
}

void TruthTracker::look() {
  std::vector<Sensor> sensors;
  for (const auto& [id, sensor] : sensors_) sensors.push_back(sensor);

  std::vector<fake_world::Thing> things;
  for (const auto& [id, thing] : things_) things.push_back(thing);
  perceiver_.look(sensors, {map_.grid(), things}, shell_.now());
}

void TruthTracker::tell() {
  const std::uint64_t first = first_id(shell_.boot_id());
  std::set<std::uint64_t> live;

  for (const local_planner::SeenTrack& seen : perceiver_.tracks()) {
    fleet::Track track = seen.track;
    track.id += first;
    tracks_.write(track);
    live.insert(track.id);
  }

  for (const std::uint64_t id : live_)
    if (live.count(id) == 0) tracks_.dispose(id);

  live_ = std::move(live);

  fleet::TrackingStatus status;
  status.source_id = shell_.instance_id();
  for (const auto& [id, use] : newest_scans_) status.newest_scans.push_back(use);
  status.live_track_ids.assign(live_.begin(), live_.end());
  statuses_.write(status);
}

}  // namespace aisle::sim
