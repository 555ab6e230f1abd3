#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "tools/lab/results/result_text.hpp"
#include "tools/sim/setup.hpp"
#include "tools/sim/snapshot.hpp"
#include "tools/sim/totals.hpp"

namespace aisle::lab {

/// The figures of drives: goals, contacts, least_clearance_m (null: nothing came near), distance_m, driven_s, replans,
/// turn_sign_changes, jerk_rms, trace_hash (hexadecimal), and mean and 99 % quantile of what the local planners' cycles
/// took (CPU time; null without any), which alone differ from run to run.
Row drive_figures(const sim::Totals& totals, const std::vector<double>& compute_us);

/// Its keys, in order.
std::vector<std::string> drive_columns();

/// Collects a drive's rows while it runs: of kind "cycle" one a cycle of a local planner (50 a second), of kind
/// "waypoint" one a point of each plan when it is first seen.
///
/// A cycle has seed, query (which of a map's queries is driven, from 0), agv, t_s (since the start of the run), x_m,
/// y_m, yaw_rad (true base in map), v_mps, w_radps and sideways_mps (as commanded), clearance_m (from the vehicle's
/// outline to the nearest wall or thing, at most kLookM), compute_us (CPU time of the planner; it alone differs from
/// run to run) and phase.
class DriveRows {
 public:
  static constexpr double kLookM = 2.0;

  /// `setup` must outlive it. `query` stands in each row.
  explicit DriveRows(const sim::Setup& setup, std::size_t query = 0) : setup_(setup), query_(query) {}

  void take(const sim::Cycle& cycle);

  const std::vector<Row>& rows() const { return rows_; }

 private:
  void take_plan(const sim::Cycle& cycle, std::size_t vehicle);
  double clearance_m(const sim::Cycle& cycle, std::size_t vehicle) const;

  const sim::Setup& setup_;
  std::size_t query_;
  std::map<std::string, std::uint64_t> newest_plan_;  // of each vehicle, by id
  std::vector<Row> rows_;
};

}  // namespace aisle::lab
