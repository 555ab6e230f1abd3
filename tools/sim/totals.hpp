#pragma once
#include <cstdint>
#include <optional>
#include <string>

#include "tools/sim/result.hpp"

namespace aisle::sim {

/// Several runs as one line.
struct Totals {
  int runs{0};
  int goals_assigned{0};
  int goals_reached{0};
  int contacts{0};
  int contacts_moving_vehicle{0};
  double least_clearance_m{kNothingNearM};  // of moving vehicles to anything, in all runs
  double distance_m{0.0};
  double time_s{0.0};    // simulated
  double driven_s{0.0};  // Result::driven_s, summed
  int replans{0};
  int omega_sign_changes{0};
  double longest_standoff_s{0.0};
  std::string longest_standoff;  // when, which vehicle and why
  double longest_wait_s{0.0};
  std::string longest_wait;
  double vehicle_hours{0.0};
  double own_way_m{0.0};
  double plan_way_m{0.0};
  double jerk_rms{0.0};                               // m/s^3
  std::uint64_t trace_hash{14695981039346656037ULL};  // of all runs' poses, in order: the same seeds give the same

  void add(const Result& result);
  void add(const Totals& others);
  /// None where no goal was given.
  std::optional<double> goals_per_vehicle_hour() const {
    return vehicle_hours > 0.0 ? std::optional(goals_reached / vehicle_hours) : std::nullopt;
  }

  /// Share of the metres driven by plans that vehicles drove on their own ways; none where nothing was driven.
  std::optional<double> own_way_share() const {
    return plan_way_m > 0.0 ? std::optional(own_way_m / plan_way_m) : std::nullopt;
  }

  bool is_good() const { return goals_reached == goals_assigned && contacts_moving_vehicle == 0; }

 private:
  /// What both kinds of add() do alike.
  template <class Part>
  void add_stands(const Part& part);

  double jerk_squared_sum_{0.0};
  std::uint64_t jerk_samples_{0};
};

}  // namespace aisle::sim
