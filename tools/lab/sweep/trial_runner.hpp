#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "common/grid/clearance.hpp"
#include "tools/lab/results/result_text.hpp"
#include "tools/lab/sweep/sweep.hpp"

namespace aisle::lab {

/// Runs the trials of a sweep. Reads the map files once; run() may be called by several threads.
class TrialRunner {
 public:
  /// `sweep` must outlive it. @throws config::BadInput for what check() refuses, and for a map that cannot be read
  explicit TrialRunner(const Sweep& sweep);

  /// Of each subject, for trials_of.
  std::vector<std::size_t> queries() const;

  /// The columns that every trial's row begins with: trial, subject, query, seed, planner, with drives also local, and
  /// the full name of each parameter that varies.
  std::vector<std::string> leading_columns() const;

  /// The trial's row: the columns above (null where a parameter is not of its planners), then the figures of
  /// plan_rows.hpp or drive_rows.hpp. None when it was interrupted.
  /// @throws config::BadInput for a start or goal in a wall
  std::optional<Row> run(const Trial& trial, const std::function<bool()>& is_interrupted) const;

 private:
  struct Loaded {
    Subject subject;
    std::unique_ptr<grid::ClearanceField> clearance;  // for paths
  };

  /// The map of a file, or drawn for the trial.
  std::shared_ptr<const Loaded> loaded(const Trial& trial) const;
  Loaded with_clearance(Subject subject) const;

  Row leading(const Trial& trial) const;
  Row planned(const Trial& trial, const std::function<bool()>& is_interrupted) const;
  Row driven(const Trial& trial, const std::function<bool()>& is_interrupted) const;
  std::vector<ParameterValue> values_of(const Trial& trial) const;

  const Sweep& sweep_;
  std::vector<std::shared_ptr<const Loaded>> maps_;
};

/// Everything that decides the rows of a sweep but the commit, as a short hash: files of results with the same one hold
/// the same trials.
std::string fingerprint(const Sweep& sweep, const std::vector<Trial>& trials);

}  // namespace aisle::lab
