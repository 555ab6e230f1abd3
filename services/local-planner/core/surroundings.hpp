#pragma once

#include <map>
#include <string>
#include <vector>

#include "services/local-planner/core/dwa.hpp"
#include "services/local-planner/core/inputs.hpp"
#include "services/local-planner/core/peers.hpp"
#include "services/local-planner/core/room.hpp"

namespace aisle::local_planner {

/// By how much tracks and peers are taken larger than they were seen, and how long a peer is waited for.
struct SurroundingsSettings {
  double dead_time_s{0.1};       // from a command to the wheels
  double track_latency_s{0.05};  // from the scan to the track's arrival
  double mover_margin_m{0.12};
  double mover_growth_mps{0.2};  // besides the track's own uncertainty of velocity
  double standing_margin_m{0.05};
  double standing_mps{0.15};    // slower tracks stand
  double peer_patience_s{3.0};  // a peer that stands for so long is driven around
  double peer_silent_s{0.5};    // then it is taken to stand where it can have come to
};

/// A disc that stands in the way and must be driven around.
struct Standing {
  Disc disc;
  std::string vehicle_id;  // empty: not a vehicle
};

/// The inputs as geometry, when the next command acts: `dead_time_s` from now. All in map.
struct Surroundings {
  std::vector<Mover> movers;             // all tracks
  std::vector<PeerMotion> peer_motions;  // one for each disc that covers the footprint of a peer near here
  std::vector<Standing> standing;
  std::vector<Disc> standing_discs;  // of `standing`, in its order

  /// Adds to both lists. `vehicle_id`: empty when it is no vehicle.
  void add_standing(const Disc& disc, const std::string& vehicle_id);
};

/// Turns a cycle's inputs into its surroundings. Remembers since when each peer stands, and where each track was first
/// seen.
class Observer {
 public:
  explicit Observer(const SurroundingsSettings& settings) : settings_(settings), peers_(settings.peer_silent_s) {}

  /// @param here_in_map where the vehicle is: peers within 6 m of it are looked at
  Surroundings observe(const Inputs& inputs, geometry::Point2 here_in_map, time::Stamp now);

 private:
  /// A peer as the discs of its footprint: where it can come while braking, and, when it stays, as something that
  /// stands.
  void add_peer(Surroundings& out, const Peer& peer, time::Stamp now);

  /// Is the track now farther from where it was first seen than another view of a standing thing would make it?
  bool has_walked(const SeenTrack& seen);

  /// Forgets tracks that are gone.
  void forget_all_but(const std::vector<SeenTrack>& tracks);

  SurroundingsSettings settings_;
  PeerObserver peers_;
  std::map<std::uint64_t, geometry::Point2> first_seen_in_map_;  // each track, by its id
};

}  // namespace aisle::local_planner
