#pragma once

#include <string>
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::referee {

/// Why a vehicle stands or slows, as the speed picture shades it.
enum class Standing { kNone, kWaits, kHolds };

/// Where a vehicle was and how it moved.
struct DrivePoint {
  double t_s{0.0};
  geometry::Pose2 base_in_map;
  double speed_mps{0.0};
  Standing standing{Standing::kNone};
};

/// One vehicle's way from ground truth: metres driven, and stops. A stop: the vehicle stood, neither
/// driving nor turning, for kStand_s with a goal still open, after it had moved.
class DriveBook {
 public:
  /// One sample of ground truth; in order of time.
  void drove(double t_s, const geometry::Pose2& base_in_map, double speed_mps, bool goal_open, Standing standing);
  double distance_m() const { return distance_m_; }
  int stops() const { return stops_; }
  double max_speed_mps() const { return max_speed_mps_; }

  /// Does it neither drive nor turn at the newest sample?
  bool stands() const { return still_since_s_ >= 0.0; }

  /// Since when it has stood; less than 0 while it moves.
  double stands_since_s() const { return still_since_s_; }
  bool seen() const { return seen_; }

  /// Where it was at the newest sample. @pre seen()
  const geometry::Pose2& base_in_map() const { return last_.base_in_map; }

  /// At most one point per kTrace_s, and one where `standing` changes.
  const std::vector<DrivePoint>& trace() const { return trace_; }

  static constexpr double kStand_s = 0.5;
  static constexpr double kTrace_s = 0.1;

 private:
  bool seen_{false};
  DrivePoint last_;
  double distance_m_{0.0};
  double max_speed_mps_{0.0};
  int stops_{0};
  double still_since_s_{-1.0};
  bool moved_since_stop_{false};
  std::vector<DrivePoint> trace_;
};

}  // namespace aisle::referee
