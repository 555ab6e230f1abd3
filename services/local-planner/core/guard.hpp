#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "services/local-planner/core/inputs.hpp"
#include "services/local-planner/core/settings.hpp"

namespace aisle::local_planner {

/// Why the vehicle may not drive, as its status says it.
struct Stopped {
  Phase phase{Phase::kWaiting};
  Reason reason{Reason::kNone};
  std::string detail{};
};

/// May the vehicle drive? Looks at what is missing, old or late in the inputs, the first of this order:
///
///   state ─ authority ─ fresh state ─ not held ─ in time ─ map ─ plan, not cancelled ─ tracker ─ fresh tracker ─ path
///   ─ of this map
///
/// What never came lets it wait; what came and is gone or old holds it.
class Guard {
 public:
  explicit Guard(const Settings& settings);

  /// A cycle begins. @returns the time since the one before, in s, where this one is late; none: it is in time
  std::optional<double> begin(std::uint64_t map_revision, time::Stamp now);

  /// @param has_arrived the vehicle stands at its goal: it needs no plan of the newest map
  /// @returns none: it may drive; then map, vehicle, state and a plan with a path are there
  std::optional<Stopped> judge(const Inputs& inputs, bool has_arrived, time::Stamp now) const;

 private:
  /// Vehicle, authority and state.
  std::optional<Stopped> judge_state(const Inputs& inputs, time::Stamp now) const;

  /// A status of the tracker, and a fresh one with scans of this vehicle.
  std::optional<Stopped> judge_tracker(const Inputs& inputs, time::Stamp now) const;

  /// A plan with a path, of the newest map, unless the vehicle has arrived.
  std::optional<Stopped> judge_plan(const Inputs& inputs, bool has_arrived, time::Stamp now) const;

  /// What is wrong with the tracker, when it lives but sees nothing of this vehicle.
  std::string tracker_detail(const Inputs& inputs, time::Stamp now) const;

  double late_s_;
  double late_hold_s_;
  double stale_state_s_;
  double stale_tracker_s_;
  double plan_update_s_;

  time::Stamp last_cycle_{};        // 0: none yet
  time::Stamp late_{};              // when a cycle last came too late; 0: never
  std::uint64_t map_revision_{0};   // the newest seen,
  time::Stamp revision_changed_{};  // and since when
};

}  // namespace aisle::local_planner
