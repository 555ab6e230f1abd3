#pragma once

#include "services/local-planner/core/recovery.hpp"

namespace aisle::local_planner {

/// How long the vehicle has stood with a reason to move, and how long it has tried without getting on.
///
///   gets on ── stands ──► waits ── tries for long ──► backs off ── ... ──► gets on
///                         lets people pass, for up to 10 s
class Stuck {
 public:
  /// A new lane: everything before is forgotten.
  void begin(time::Stamp now);

  /// There is no reason to move: held, or at the goal.
  void rest(time::Stamp now);

  /// It moved in this cycle, or turns.
  void move(time::Stamp now) { moved_ = now; }

  /// The way round is longer than what was left; that is no step back.
  void lengthen(double longer_m) { patience_.lengthen(longer_m); }

  /// Since it last moved or had no reason to, in s.
  double stood_s(time::Stamp now) const { return time::seconds(now - moved_); }

  /// @param are_refusing people who walk by refuse every speed that moves: it lets them pass first, for a while
  void notice_people(bool are_refusing, time::Stamp now);

  /// It has tried for long enough: true once for each time that it should back off. Time in which people are let pass
  /// does not count.
  bool has_tried_enough(Attempt attempt, time::Stamp now);

 private:
  time::Stamp moved_{};
  bool lets_pass_{false};  // in the cycle before
  Patience patience_;
};

}  // namespace aisle::local_planner
