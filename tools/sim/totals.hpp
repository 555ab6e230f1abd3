#pragma once
#include <cstdint>

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
  double jerk_rms{0.0};                               // m/s^3
  std::uint64_t trace_hash{14695981039346656037ULL};  // of all runs' poses, in order: the same seeds give the same

  void add(const Result& result);
  void add(const Totals& others);
  bool is_good() const { return goals_reached == goals_assigned && contacts_moving_vehicle == 0; }

 private:
  double jerk_squared_sum_{0.0};
  std::uint64_t jerk_samples_{0};
};

}  // namespace aisle::sim
