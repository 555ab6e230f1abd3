#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "tools/lab/page/progress.hpp"
#include "tools/lab/traffic_bounds/fleet_case.hpp"
#include "tools/lab/traffic_bounds/fleet_figures.hpp"
#include "tools/lab/traffic_bounds/one_shot_plan.hpp"

namespace aisle::lab {

/// How good the traffic is, beside what it cannot exceed.
struct TrafficExperiment {
  std::vector<std::size_t> vehicles{5, 10, 20, 50, 75, 100};  // sizes of fleets
  std::uint64_t seed{1};
  double seconds{300.0};  // of each run
  bool with_site{false};  // the simulated site with all services too
  OneShotBudget one_shot;
  std::function<bool()> goes_on;  // false: the experiment ends with the rows that are complete; may be empty
};

inline constexpr std::size_t kMostDriven = 100;  // larger fleets are planned only
inline constexpr std::size_t kMostPlanned = 300;
inline constexpr std::size_t kFreeRunsOfStep = 5;  // tau is measured on so many free runs
inline constexpr double kPauseS = 0.5;             // at a goal

/// Draws a fleet on the floor and measures all its sizes: free runs, the PIBT bound, runs with more goals than can be
/// reached, one shot, plans from nothing. The same experiment gives the same figures, but for computing times.
///
/// @throws config::BadInput when the floor has no room for the fleet
FloorFigures measure_floor(const Floor& floor, const TrafficExperiment& experiment, const Progress& progress);

}  // namespace aisle::lab
