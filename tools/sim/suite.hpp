#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "tools/sim/result.hpp"
#include "tools/sim/setup.hpp"
#include "tools/sim/totals.hpp"

namespace aisle::sim {

/// The suite's families, in the order in which they are shown; each is also one of families().
const std::vector<std::string>& suite_families();

/// One planner over one family.
struct SuiteRow {
  std::string family;
  Totals totals;
  std::vector<std::string> bad;  // seeds with a goal missed or a contact of a moving vehicle, and what happened last
};

/// A goal that takes longer than this, times what the vehicle would need alone at full speed, is missed.
inline constexpr double kFreeRuns = 5.0;

/// One scenario of the suite with a local planner. The time of a goal counts from when the first one was given; a goal
/// reached too late counts as missed, and no run counts as longer than its longest goal may take.
/// @pre each vehicle has one goal
Result run_in_time(Setup setup, const std::string& local);

/// Seeds from `first` on. `is_stopped` is asked before each run.
SuiteRow run_family(const std::string& family, const std::string& local, std::uint64_t first, int seeds,
                    const std::function<bool()>& is_stopped = {});

}  // namespace aisle::sim
