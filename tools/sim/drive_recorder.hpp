#pragma once

#include <cstdint>
#include <map>
#include <string>

#include "common/service/shell.hpp"
#include "tools/sim/result.hpp"

namespace aisle::sim {

/// Notes how vehicles drive, from ground truth and from what they report: smoothness, plans, and a hash of every pose.
/// What the referee judges (contacts, goals, distances) is not noted here.
class DriveRecorder {
 public:
  /// Listens to the topics of `shell` from now on.
  explicit DriveRecorder(service::Shell& shell);
  DriveRecorder(const DriveRecorder&) = delete;
  DriveRecorder& operator=(const DriveRecorder&) = delete;

  /// Puts its figures into `result`.
  void fill(Result& result) const;

  /// FNV-1a over the true poses of all bodies with their stamps, in the order in which they were
  /// published.
  std::uint64_t trace_hash() const { return trace_hash_; }

 private:
  /// The newest motion of a vehicle, to compare the next with.
  struct VehicleEntry {
    bool has_state{false};
    double mps{0.0}, mps2{0.0}, turn_radps{0.0};
    std::string planned_goal;  // whose first plan was measured
  };

  /// Each notes what its topic tells.
  void take(const fleet::Obstacle& obstacle, std::int64_t stamp_ns);
  void take(const fleet::VehicleState& state);
  void take(const fleet::Plan& plan);

  std::map<std::string, VehicleEntry> vehicles_;
  std::uint64_t trace_hash_{14695981039346656037ULL};
  double planned_m_{0.0};
  int turn_sign_changes_{0};
  double jerk_squared_sum_{0.0};
  std::uint64_t jerk_samples_{0};
};

}  // namespace aisle::sim
