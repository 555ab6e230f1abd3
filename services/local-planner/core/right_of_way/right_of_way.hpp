#pragma once

#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "services/local-planner/core/moment.hpp"
#include "services/local-planner/core/right_of_way/detours.hpp"
#include "services/local-planner/core/right_of_way/traffic.hpp"
#include "services/local-planner/core/settings.hpp"
#include "services/local-planner/core/stuck.hpp"
#include "services/local-planner/core/surroundings.hpp"
#include "services/local-planner/core/way.hpp"

namespace aisle::local_planner {

/// What others leave of the way in this cycle.
struct Ruling {
  Advice advice;
  double stop_at_m{std::numeric_limits<double>::infinity()};  // of the current way; do not pass it
  std::vector<Event> events;
};

/// Where the vehicle's way leads among others: around what stands on it, aside for peers that go first, back a metre
/// where trying does not help. Changes the way, and says how far it may be driven.
///
///   on the lane ── obstructed ──► detour ──► on the lane
///               ── a peer asks for room, for 1 s ──► aside ── there, or after 20 s ──► on the lane
///               ── stuck ──► backs off (aside for those it is stuck with) ──► on the lane
class RightOfWay {
 public:
  /// @param knows_path false: no detours
  RightOfWay(const Settings& settings, bool knows_path);

  /// There is a new lane.
  void begin() { detours_.begin(); }

  /// One cycle: looks for detours, asks the rules, steps aside or comes back, backs off. Changes `way` and `stuck`.
  /// @param in_force the twist before this cycle's command
  Ruling rule(const Moment& moment, const Surroundings& around, const geometry::Twist2& in_force, Way& way,
              Stuck& stuck);

  /// What obstructs the lane, and no way was found around it.
  const std::optional<Blocked>& blocked() const { return detours_.blocked(); }

  /// What keeps the vehicle from going on along its current way; none while it drives aside.
  const Blocked* blocking(const Way& way) const;

  /// How far along its current way the vehicle claims it; infinity: as far as a claim reaches. A vehicle that follows
  /// claims the way beyond the one before it, too.
  double claim_end_m(const Advice& advice, const Way& way) const;

  /// Is it on a way aside as a recovery, not as a courtesy?
  bool backs_off(const Way& way) const { return way.is_aside() && backs_off_; }

 private:
  struct Cycle;  // the arguments of `rule`

  /// The parts of rule(), in its order.
  void go_around(Cycle& cycle);
  void ask(Cycle& cycle);
  void make_room(Cycle& cycle);
  void come_back(Cycle& cycle);
  void back_off(Cycle& cycle);

  /// Looks for a place aside, and sets off for it; false: there is none.
  bool step_aside(Cycle& cycle, const std::vector<std::string>& for_whom);

  Settings settings_;
  bool knows_path_;
  Detours detours_;

  time::Stamp stepped_aside_{};  // when a place aside was last looked for
  bool backs_off_{false};
};

}  // namespace aisle::local_planner
