#pragma once

#include <limits>
#include <vector>

#include "services/local-planner/core/detours.hpp"
#include "services/local-planner/core/moment.hpp"
#include "services/local-planner/core/settings.hpp"
#include "services/local-planner/core/stuck.hpp"
#include "services/local-planner/core/surroundings.hpp"
#include "services/local-planner/core/way.hpp"

namespace aisle::local_planner {

/// How far and how freely the vehicle may drive its lane.
struct Leave {
  double stop_at_m{std::numeric_limits<double>::infinity()};  // of the lane: where what is granted ends
  bool is_in_tube{false};                                     // it may not leave the lane
};

/// What comes of it in this cycle.
struct Ruling {
  double stop_at_m{std::numeric_limits<double>::infinity()};  // of the current way; do not pass it
  std::vector<Event> events;
};

/// Leads the vehicle around what stands on its way, and back a metre where trying does not help. Changes the way, and
/// says how far it may be driven.
///
///   on the lane ── obstructed ──► detour ──► on the lane
///               ── stuck ──► backs off ── there, or after 20 s ──► on the lane
///
/// In a tube it does neither, and stops before what stands there.
class Avoidance {
 public:
  /// @param knows_path false: no detours
  Avoidance(const Settings& settings, bool knows_path);

  /// There is a new lane.
  void begin() { detours_.begin(); }

  /// One cycle. Changes `way` and `stuck`.
  Ruling rule(const Moment& moment, const Surroundings& around, const Leave& leave, Way& way, Stuck& stuck);

  /// What obstructs the lane, and no way was found around it.
  const std::optional<Blocked>& blocked() const { return detours_.blocked(); }

  /// What keeps the vehicle from going on along its current way; none while it backs off.
  const Blocked* blocking(const Way& way) const;

 private:
  struct Cycle;  // the arguments of `rule`

  /// The parts of rule(), in its order.
  void go_around(Cycle& cycle);
  void limit(Cycle& cycle) const;
  void come_back(Cycle& cycle);
  void back_off(Cycle& cycle);

  Settings settings_;
  bool knows_path_;
  Detours detours_;
  time::Stamp backed_off_{};  // when last
};

/// The way to the nearest place 0.7 m away or farther, in map, from where the vehicle is, among walls, what stands and
/// peers. Where there is none, or for a vehicle that cannot turn on the spot: empty.
std::vector<geometry::Point2> way_back(const Moment& moment, const Surroundings& around, const Way& way);

}  // namespace aisle::local_planner
