#pragma once
#include <cstdint>
#include <map>
#include <string>

#include "tools/lockstep/simulation.hpp"
#include "tools/referee/core/run_report.hpp"

namespace aisle::cli {

/// Collects a lock-step run for the picture that the referee draws of real ones.
class DrivePicture {
 public:
  explicit DrivePicture(const lockstep::Setup& setup);
  /// To be handed to lockstep::run.
  lockstep::Watch watch();
  /// fleet.svg of the run so far.
  std::string svg(const lockstep::Result& result) const;

 private:
  void look(const lockstep::Snapshot& now);
  void look_at_plan(double t_s, const fleet::Plan& plan, referee::VehicleRow& row);
  void add_goals(const lockstep::Result& result, referee::RunReport& report) const;
  void add_edits(referee::RunReport& report) const;
  static void add_contacts(const lockstep::Result& result, referee::RunReport& report);

  const lockstep::Setup& setup_;
  referee::RunReport report_;
  std::map<std::string, std::uint64_t> latest_plans_;  // ids, of each vehicle
};

}  // namespace aisle::cli
