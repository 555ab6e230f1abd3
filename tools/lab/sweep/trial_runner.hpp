#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/grid/clearance.hpp"
#include "tools/lab/results/result_text.hpp"
#include "tools/lab/sweep/drive_rows.hpp"
#include "tools/lab/sweep/plan_rows.hpp"
#include "tools/lab/sweep/sweep.hpp"

namespace aisle::lab {

/// Runs the trials of a sweep. Reads the map files once, and scenario files to check them; run() may be called by
/// several threads.
class TrialRunner {
 public:
  /// `sweep` must outlive it. @throws config::BadInput for what check() refuses, and for a map or scenario that cannot
  /// be read
  explicit TrialRunner(const Sweep& sweep);

  /// Of each subject, for trials_of.
  std::vector<std::size_t> queries() const;

  /// The columns of every row: trial, subject, query, seed, planner, with drives also local, the full name of each
  /// parameter that varies, the figures of plan_rows.hpp or drive_rows.hpp, and refusal.
  std::vector<std::string> columns() const;

  /// The trial's row, null where a parameter is not of its planners. A trial that cannot be run, such as a drive from a
  /// start in a wall, has null figures, and `refusal` says why; else `refusal` is null. None when it was interrupted.
  std::optional<Row> run(const Trial& trial, const std::function<bool()>& is_interrupted) const;

  /// Everything that decides the rows of these trials but the commit, as a short hash: cells and queries of the maps as
  /// they were read, the bytes of scenario files and their maps and recordings, the parameters. Files of results with
  /// the same one hold the same trials.
  std::string fingerprint(const std::vector<Trial>& trials) const;

 private:
  struct Loaded {
    Subject subject;
    std::unique_ptr<grid::ClearanceField> clearance;  // for paths
  };

  /// The map of a file, or drawn for the trial.
  std::shared_ptr<const Loaded> loaded(const Trial& trial) const;
  Loaded with_clearance(Subject subject) const;

  std::vector<std::string> figure_columns() const { return sweep_.drives ? drive_columns() : plan_columns(); }

  Row leading(const Trial& trial) const;
  Row figures(const Trial& trial, const std::function<bool()>& is_interrupted) const;
  Row refused(const std::string& why) const;
  Row planned(const Trial& trial, const std::function<bool()>& is_interrupted) const;
  Row driven(const Trial& trial, const std::function<bool()>& is_interrupted) const;
  std::vector<ParameterValue> values_of(const Trial& trial) const;

  const Sweep& sweep_;
  std::vector<std::shared_ptr<const Loaded>> maps_;
};

}  // namespace aisle::lab
