#pragma once

#include <string>
#include <vector>

#include "services/global-planner/core/path_checker.hpp"
#include "services/global-planner/core/path_figures.hpp"
#include "services/global-planner/core/planner.hpp"

namespace aisle::lab {

/// One answer of one planner.
struct Answer {
  global_planner::PlannedPath plan;
  global_planner::PathFigures figures;  // when found
  std::string fault;                    // what the path checker says, empty when nothing
  double time_us{0.0};
};

/// Asks, checks and measures; checks a rectangle as such.
Answer ask(global_planner::Planner& planner, const global_planner::Problem& problem,
           const global_planner::Outline& outline = {});

/// What one planner did over many queries: counts, and means and quantiles of its figures over the
/// solved ones.
class Tally {
 public:
  /// `planner`: its name.
  explicit Tally(std::string planner) : planner_(std::move(planner)) {}

  /// `optimum_m`: 0 when not known.
  void add(const Answer& answer, double optimum_m);

  const std::string& planner() const { return planner_; }

  /// Counts of queries: asked, solved, and solved with a path that the checker refuses.
  int asked() const { return asked_; }
  int solved() const { return solved_; }

  /// Solved queries whose path the independent checker refuses.
  int checker_failures() const { return checker_failures_; }
  const std::string& first_fault() const { return first_fault_; }

  /// Length over the known optimum.
  double length_ratio_mean() const { return mean(ratio_); }
  double length_ratio_max() const;

  /// Means over the solved queries; not a number when there are none.
  double length_mean_m() const { return mean(length_m_); }
  double nodes_mean() const { return mean(nodes_); }
  double turning_points_mean() const { return mean(turning_points_); }
  double turning_angle_mean_rad() const { return mean(turning_angle_rad_); }
  double expanded_mean() const { return mean(expanded_); }
  double expanded_p99() const { return quantile(expanded_, 0.99); }
  double length_ratio_p99() const { return quantile(ratio_, 0.99); }
  double time_us(double part) const { return quantile(time_us_, part); }
  double least_clearance_m() const { return least_clearance_m_; }

 private:
  static double mean(const std::vector<double>& of);
  static double quantile(std::vector<double> of, double part);  // nearest rank

  std::string planner_;
  int asked_{0}, solved_{0}, checker_failures_{0};
  std::string first_fault_;
  std::vector<double> ratio_, length_m_, nodes_, turning_points_, turning_angle_rad_, expanded_, time_us_;
  double least_clearance_m_{0.0};
};

}  // namespace aisle::lab
