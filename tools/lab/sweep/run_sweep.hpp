#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <vector>

#include "tools/lab/results/result_text.hpp"
#include "tools/lab/sweep/sweep.hpp"

namespace aisle::lab {

/// Runs one trial; none when it was interrupted. Called by several threads.
using RunTrial = std::function<std::optional<Row>(const Trial&, const std::function<bool()>& is_interrupted)>;

/// How a sweep is run.
struct SweepRun {
  int workers{2};                        // threads
  std::function<bool()> is_interrupted;  // asked often, by every thread
  std::function<void(const Row&)> take;  // rows in the order of the trials, in the caller's thread
  std::function<void(std::size_t done, std::size_t all)> tell{};  // after each row
};

/// Runs the trials that are not among `kept`, each once, and hands over their rows. Ends early once interrupted, with
/// the rows until then handed over. What a trial throws is thrown here, after the rows before it.
/// @returns all rows in the order of the trials, the kept ones among them
std::vector<Row> run_sweep(const std::vector<Trial>& trials, const std::map<std::size_t, Row>& kept,
                           const RunTrial& run, const SweepRun& how);

}  // namespace aisle::lab
