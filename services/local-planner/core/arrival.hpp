#pragma once

#include <optional>

#include "services/local-planner/core/moment.hpp"

namespace aisle::local_planner {

/// What the vehicle does when nothing is left to drive: it turns, comes to a stand, or has arrived.
struct AtGoal {
  Phase phase{Phase::kDriving};
  geometry::Twist2 wanted;
};

/// Is the vehicle at its goal? Drives at the goal's middle, and stops where it gets no nearer; turns to the goal's
/// heading if that matters; stays.
///
///   under way ── within the tolerance, no nearer ──► [turns ──►] stops ──► arrived
///             ◄── another goal, or pushed twice the tolerance away ──
class Arrival {
 public:
  /// There is another goal.
  void begin(time::Stamp now);

  /// @param in_force the twist before this cycle's command
  /// @returns none: there is more to drive
  std::optional<AtGoal> look(const Moment& moment, const geometry::Twist2& in_force);

  /// It has arrived, and was not pushed away since.
  bool has_arrived() const { return has_arrived_; }

 private:
  /// See above: within the tolerance, and no nearer by driving on.
  bool is_there(const Moment& moment);

  bool has_arrived_{false};
  time::Stamp near_since_{};  // within the goal's tolerance
};

}  // namespace aisle::local_planner
