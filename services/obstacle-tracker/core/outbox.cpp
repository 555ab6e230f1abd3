#include "services/obstacle-tracker/core/outbox.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::obstacle_tracker {

std::vector<Track> Outbox::due(const std::vector<Track>& tracks, const std::vector<std::uint64_t>& seen,
                               time::Stamp now) {
  std::vector<Track> due;
  for (const Track& track : tracks) {
    const bool is_seen = std::find(seen.begin(), seen.end(), track.id) != seen.end();
    if (!is_due(track, is_seen, now)) continue;

    sent_[track.id] = {track, now};
    due.push_back(track);
  }

  return due;
}

bool Outbox::is_due(const Track& track, bool is_seen, time::Stamp now) const {
  const auto found = sent_.find(track.id);
  if (found == sent_.end()) return true;

  const Sent& sent = found->second;

  // A change between moving and standing is news at once.
  if (track.is_static != sent.track.is_static) return true;
  if (!track.is_static) return is_seen || now - sent.at >= params_.moving_every;

  return now - sent.at >= params_.static_every || std::abs(track.radius_m - sent.track.radius_m) > params_.changed_m ||
         geometry::distance(track.position_in_map, sent.track.position_in_map) > params_.changed_m;
}

}  // namespace aisle::obstacle_tracker
