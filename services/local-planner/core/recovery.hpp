#pragma once

#include <limits>
#include <optional>

#include "common/time/stamp.hpp"
#include "services/local-planner/core/dwa.hpp"

namespace aisle::local_planner {

/// What a vehicle does that wants to move and cannot, in the order in which it is tried:
///
///   slower ─► a finer look ─► turns to where there is room ─► backs off to try again ─► stops and asks for another
///   plan
///
/// The first three are answers to one cycle's look (`way_out`), the others to some seconds of them (`Patience`).
enum class Grade { kNone, kSlower, kFiner, kTurn, kBackOff, kAsk };

/// As the status tells it; empty for kNone, and for kAsk, which has a phase of its own.
const char* told(Grade grade);

/// Nothing that moves was free, though something was tried.
bool is_refused(const Choice& choice);

/// One cycle's look in which every speed was refused.
struct Refusal {
  const Scene& scene;
  const Aim& aim;
  const Choice& choice;
  bool stands{false};
  bool may_turn{false};       // on the spot, without looking where corners go: a disc
  double to_target_rad{0.0};  // the turn that would face the target, to the left
};

/// What gets the vehicle over a refusal.
struct WayOut {
  Grade grade{Grade::kNone};         // never kNone after a refusal
  Choice choice;                     // of the finer look where that helped, else the refusal's own
  std::optional<double> turn_rad{};  // on the spot, to the left, instead of what was chosen
};

/// Slower while the vehicle moves. When it stands and only walls refuse: twice as many speeds and turn rates in the
/// same window, for a gap between walls may be so narrow that few arcs lead into it; else a turn to the heading nearest
/// to the target's from which it may set off, as beside a corner that was cut too nearly. Before people and other
/// vehicles it waits, there is more room in a moment; what was chosen may turn it meanwhile.
WayOut way_out(const Refusal& refusal, const Variant& variant, const DwaSettings& settings);

/// How a vehicle gets on along its way.
struct Attempt {
  double left_m{0.0};     // of the lane
  bool waits{false};      // for road to be granted, or for people who walk by
  bool backs_off{false};  // drives a way back, or stands at its end
  bool is_closed{false};  // what stands, and is no vehicle, leaves no way around
  kinematics::Limits limits{};
};

/// Counts how long a vehicle tries without getting on. Time without a try (waiting, held, at the goal) does not count.
class Patience {
 public:
  /// A new way: everything before is forgotten.
  void begin(time::Stamp now);

  /// No reason to try in this cycle.
  void rest(time::Stamp now) { progressed_ = now; }

  /// A way round is no step back.
  void lengthen(double longer_m);

  /// kBackOff once trying has lasted for 3 s and the time of a turn about, 4 s longer each time that it did not help,
  /// up to 20 s; kAsk where backing off moves nothing; else kNone.
  Grade look(const Attempt& attempt, time::Stamp now);

 private:
  time::Stamp progressed_{};                                      // when the distance left last shrank by a good piece
  double least_left_m_{std::numeric_limits<double>::infinity()};  // since the last recovery
  double best_left_m_{std::numeric_limits<double>::infinity()};   // since the way began
  int recoveries_{0};
};

}  // namespace aisle::local_planner
