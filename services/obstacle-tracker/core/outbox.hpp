#pragma once

#include <chrono>
#include <cstdint>
#include <map>
#include <vector>

#include "common/fleet/track.hpp"
#include "common/time/stamp.hpp"

namespace aisle::obstacle_tracker {

using fleet::Track;

/// Decides which tracks are worth a sample. A moving one is sent whenever a scan measured it, and at least every
/// `moving_every`; one that stands every `static_every`, and at once when it came to a stand, left it, or changed its
/// place or size.
class Outbox {
 public:
  struct Params {
    std::chrono::milliseconds moving_every{100};
    std::chrono::milliseconds static_every{500};
    double changed_m{0.05};  // of a static track's place or radius
  };

  Outbox() = default;
  explicit Outbox(const Params& params) : params_(params) {}

  /// The tracks to send now; they count as sent. `tracks`: all published ones; `seen`: ids that the newest scan
  /// measured.
  std::vector<Track> due(const std::vector<Track>& tracks, const std::vector<std::uint64_t>& seen, time::Stamp now);

  /// The track is gone; nothing is remembered of it.
  void forget(std::uint64_t id) { sent_.erase(id); }

 private:
  /// The sample sent last of a track, and when.
  struct Sent {
    Track track;
    time::Stamp at{};
  };

  /// Is this track worth a sample now?
  bool is_due(const Track& track, bool is_seen, time::Stamp now) const;

  Params params_;
  std::map<std::uint64_t, Sent> sent_;
};

}  // namespace aisle::obstacle_tracker
