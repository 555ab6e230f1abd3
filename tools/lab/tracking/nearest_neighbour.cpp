// The baseline: the same hits, clustered by the gap to the neighbouring ray; a cluster's mean is the position; each
// track takes the nearest one, greedily; velocity by an alpha-beta filter. Published at the third scan, given up half a
// second after it was seen.

#include <algorithm>
#include <cmath>

#include "services/obstacle-tracker/core/hits.hpp"
#include "tools/lab/tracking/contestant.hpp"

namespace aisle::tracking {
namespace {

using geometry::Point2;
using obstacle_tracker::Hit;

constexpr double kGap_m = 0.3;            // between neighbouring rays: a new cluster begins
constexpr double kGate_m = 0.6;           // from a track to a cluster that it may take
constexpr double kAlpha = 0.5;            // share of the residual that the position takes
constexpr double kBeta = 0.15;            // and the velocity, over the time step
constexpr double kShortestStep_s = 0.05;  // bounds of that time step
constexpr double kLongestStep_s = 0.2;
constexpr double kKeep_s = 0.5;  // a track that was not seen for longer is dropped
constexpr int kConfirming = 3;   // clusters until a track is published

/// Runs of hits, each nearer than the gap to the one before; hits come in the order of their rays.
std::vector<Point2> means_of_clusters(const std::vector<Hit>& hits) {
  std::vector<Point2> means;
  for (std::size_t i = 0; i < hits.size();) {
    Point2 sum = hits[i].in_map;
    std::size_t end = i + 1;

    for (; end < hits.size() && geometry::distance(hits[end - 1].in_map, hits[end].in_map) < kGap_m; ++end)
      sum = sum + hits[end].in_map;

    means.push_back((1.0 / static_cast<double>(end - i)) * sum);
    i = end;
  }

  return means;
}

/// Clusters of hits are given to the nearest track within a gate; an alpha-beta filter follows each:
///
///     x' = x + alpha r,    v' = v + (beta / dt) r,    r = z - x, the residual to the predicted place
class NearestNeighbour final : public Contestant {
 public:
  std::string name() const override { return "nearest-neighbour"; }

  /// Predicts all tracks to the end of the sweep, gives each cluster to one of them, and forgets the
  /// old ones.
  void take(const obstacle_tracker::Scan& scan, const std::vector<obstacle_tracker::KnownVehicle>& vehicles,
            const grid::ClearanceField& clearance, time::Stamp) override {
    const time::Stamp end = scan.stamp + time::from_seconds(scan.sweep_s);
    for (Entry& entry : entries_) entry.position = entry.position + time::seconds(end - moment_) * entry.velocity;
    moment_ = end;

    const auto sorted = obstacle_tracker::sort_rays(scan, clearance, vehicles, {}, {});
    for (const Point2 mean : means_of_clusters(sorted.hits)) give(mean);

    for (Entry& entry : entries_) entry.is_taken = false;

    const auto is_old = [&](const Entry& entry) { return time::seconds(moment_ - entry.seen) > kKeep_s; };
    entries_.erase(std::remove_if(entries_.begin(), entries_.end(), is_old), entries_.end());
  }

  std::vector<fleet::Track> tracks(time::Stamp) const override {
    std::vector<fleet::Track> tracks;
    for (const Entry& entry : entries_) {
      if (entry.scans < kConfirming) continue;

      fleet::Track track;
      track.id = entry.id;
      track.position_in_map = entry.position;
      track.velocity_in_map = entry.velocity;
      track.age_s = time::seconds(moment_ - entry.born);
      track.unseen_s = time::seconds(moment_ - entry.seen);
      tracks.push_back(track);
    }

    return tracks;
  }

 private:
  /// A track; position and velocity in map at the end of the newest scan.
  struct Entry {
    std::uint64_t id;
    Point2 position;
    Point2 velocity;
    time::Stamp born;
    time::Stamp seen;
    int scans;
    bool is_taken;  // by a cluster of this scan
  };

  /// To the nearest track within the gate that has no cluster of this scan yet; else a new track begins.
  void give(Point2 mean) {
    Entry* nearest = nullptr;
    double nearest_m = kGate_m;

    for (Entry& entry : entries_) {
      const double away_m = geometry::distance(entry.position, mean);
      if (entry.is_taken || away_m >= nearest_m) continue;
      nearest_m = away_m;
      nearest = &entry;
    }

    if (nearest == nullptr) {
      entries_.push_back({next_id_++, mean, {}, moment_, moment_, 1, true});
      return;
    }

    const double dt_s = std::clamp(time::seconds(moment_ - nearest->seen), kShortestStep_s, kLongestStep_s);
    const Point2 residual = mean - nearest->position;

    nearest->position = nearest->position + kAlpha * residual;
    nearest->velocity = nearest->velocity + (kBeta / dt_s) * residual;
    nearest->seen = moment_;
    nearest->is_taken = true;
    ++nearest->scans;
  }

  std::vector<Entry> entries_;
  std::uint64_t next_id_{1};
  time::Stamp moment_{};
};

}  // namespace

std::unique_ptr<Contestant> make_nearest_neighbour() { return std::make_unique<NearestNeighbour>(); }

}  // namespace aisle::tracking
