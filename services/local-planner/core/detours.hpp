#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "services/local-planner/core/lane.hpp"
#include "services/local-planner/core/moment.hpp"
#include "services/local-planner/core/surroundings.hpp"
#include "services/local-planner/core/way.hpp"

namespace aisle::local_planner {

/// The way is obstructed and no detour was found.
struct Blocked {
  Obstructed where;
  std::string vehicle_id;       // of what stands there; empty: not a vehicle
  std::optional<Disc> thing{};  // what stands there; none: a wall
};

/// A way that leaves the lane at once and comes back to it.
struct Detour {
  std::vector<geometry::Point2> points_in_map;
  double rejoin_m{0.0};  // of the lane
  enum class Kind { kAroundThing, kPastWalker, kBackToLane } kind{Kind::kAroundThing};
};

/// Looks for a way around what stands on the lane, past somebody who walks ahead on it more slowly or towards the
/// vehicle, or back to the lane where the vehicle is off it, five times a second: the lattice search to a point of the
/// lane behind what obstructs it, with the usual room, then with less. A walker is looked at as standing wherever they
/// will be in the next seconds.
class Detours {
 public:
  explicit Detours(const LaneSettings& lane) : lane_(lane) {}

  /// A new lane: what was found of the old one says nothing.
  void begin();

  /// The next look is due at once.
  void hasten() { searched_ = {}; }

  /// A detour to drive now; none: none is needed, none was found, or it is not time to look. @pre no way back is being
  /// driven
  /// @param most_m of the lane: what lies beyond does not count, and a detour must be back before
  std::optional<Detour> look(const Moment& moment, const Surroundings& around, const Way& way,
                             double most_m = std::numeric_limits<double>::infinity());

  /// The same in a tube, which has no room for detours: only what obstructs the lane. Vehicles do not count: those that
  /// stand where the road is granted are the business of the leader that granted it.
  void look_in_tube(const Moment& moment, const Surroundings& around, const Way& way, double most_m);

  /// What obstructs the lane since the last look that found no way around.
  const std::optional<Blocked>& blocked() const { return blocked_; }

 private:
  /// The lattice search with the usual margins, then with tight ones. Only vehicles that turn on the spot drive
  /// detours.
  std::optional<Detour> search(const Moment& moment, const Surroundings& around, const Way& way,
                               const std::optional<Obstructed>& obstructed, double most_m) const;

  /// Past the slow walkers ahead, with the usual room only; none: there are none, or there is no room.
  std::optional<Detour> search_past_walkers(const Moment& moment, const Surroundings& around, const Way& way,
                                            double most_m) const;

  LaneSettings lane_;
  time::Stamp searched_{};  // when last; 0: not since it is due
  std::optional<Blocked> blocked_;
};

}  // namespace aisle::local_planner
