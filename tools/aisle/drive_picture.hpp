#pragma once
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

  const lockstep::Setup& setup_;
  referee::RunReport report_;
};

}  // namespace aisle::cli
