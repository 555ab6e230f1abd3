#pragma once
#include <cstdint>
#include <string>
#include <vector>

namespace aisle::sim {

/// Clearance where nothing came near.
inline constexpr double kNothingNearM = 1e9;

/// What one run gave.
struct Result {
  int goals_assigned{0};
  int goals_reached{0};
  int contacts{0};                          // beginnings of contacts, of each vehicle
  int contacts_moving_vehicle{0};           // the vehicle was faster than 0.05 m/s
  double least_clearance_m{kNothingNearM};  // of moving vehicles to anything
  double distance_m{0.0};
  double time_s{0.0};        // simulated, the site's start included
  double first_goal_s{0.0};  // when the first goal was given

  /// From the first goal given to the last one reached, or to the end of the run where one was missed: what drivers are
  /// compared by. The site's start and the dispatcher's greeting are no part of it, its pauses between goals are.
  double driven_s{0.0};

  std::vector<int> reached;    // goals of each vehicle
  std::vector<int> replanned;  // how often
  std::vector<double> done_s;  // of each vehicle: when its last goal was reached, since the start of the run; -1: never
  double planned_m{0.0};       // length of the first plan of each goal
  int replans{0};
  int turn_sign_changes{0};      // of turn rates beyond 0.05 rad/s: dithering
  double jerk_squared_sum{0.0};  // (m/s^3)^2 of each vehicle and control period, of true speeds
  std::uint64_t jerk_samples{0};
  std::uint64_t trace_hash{0};

  /// How long vehicles stood with an open goal: see StandoffWatch.
  double longest_standoff_s{0.0};
  std::string longest_standoff;  // when, which vehicle and why; empty: there was none
  double longest_wait_s{0.0};
  std::string longest_wait;
  double vehicle_hours{0.0};  // from the first goal given on, of all vehicles together
  double own_way_m{0.0};      // driven on the vehicle's own way, not on the roadmap
  double plan_way_m{0.0};     // driven with a plan, on either

  std::vector<std::string> log;  // contacts, violations of authority and goals missed, with time and vehicle
};

}  // namespace aisle::sim
