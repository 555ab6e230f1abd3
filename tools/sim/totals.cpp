#include "tools/sim/totals.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::sim {

template <class Part>
void Totals::add_stands(const Part& part) {
  if (part.longest_standoff_s > longest_standoff_s) {
    longest_standoff_s = part.longest_standoff_s;
    longest_standoff = part.longest_standoff;
  }
  if (part.longest_wait_s > longest_wait_s) {
    longest_wait_s = part.longest_wait_s;
    longest_wait = part.longest_wait;
  }

  vehicle_hours += part.vehicle_hours;
  own_way_m += part.own_way_m;
  plan_way_m += part.plan_way_m;
}

void Totals::add(const Result& result) {
  add_stands(result);
  ++runs;
  goals_assigned += result.goals_assigned;
  goals_reached += result.goals_reached;
  contacts += result.contacts;
  contacts_moving_vehicle += result.contacts_moving_vehicle;
  least_clearance_m = std::min(least_clearance_m, result.least_clearance_m);
  distance_m += result.distance_m;
  time_s += result.time_s;
  driven_s += result.driven_s;
  replans += result.replans;
  omega_sign_changes += result.turn_sign_changes;
  jerk_squared_sum_ += result.jerk_squared_sum;
  jerk_samples_ += result.jerk_samples;
  jerk_rms = jerk_samples_ > 0 ? std::sqrt(jerk_squared_sum_ / static_cast<double>(jerk_samples_)) : 0.0;
  trace_hash = (trace_hash ^ result.trace_hash) * 1099511628211ULL;
}

void Totals::add(const Totals& others) {
  add_stands(others);
  runs += others.runs;
  goals_assigned += others.goals_assigned;
  goals_reached += others.goals_reached;
  contacts += others.contacts;
  contacts_moving_vehicle += others.contacts_moving_vehicle;
  least_clearance_m = std::min(least_clearance_m, others.least_clearance_m);
  distance_m += others.distance_m;
  time_s += others.time_s;
  driven_s += others.driven_s;
  replans += others.replans;
  omega_sign_changes += others.omega_sign_changes;
  jerk_squared_sum_ += others.jerk_squared_sum_;
  jerk_samples_ += others.jerk_samples_;
  jerk_rms = jerk_samples_ > 0 ? std::sqrt(jerk_squared_sum_ / static_cast<double>(jerk_samples_)) : 0.0;
  trace_hash = (trace_hash ^ others.trace_hash) * 1099511628211ULL;
}

}  // namespace aisle::sim
