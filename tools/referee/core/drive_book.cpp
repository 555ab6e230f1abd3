#include "tools/referee/core/drive_book.hpp"

#include <algorithm>
#include <cmath>

namespace aisle::referee {
namespace {
/// Slower than this, in both, is standing.
constexpr double kStill_mps = 0.03;
constexpr double kStill_radps = 0.08;
}  // namespace

/// The first sample only says where it stands.
void DriveBook::drove(double t_s, const geometry::Pose2& base_in_map, double speed_mps, bool goal_open,
                      Standing standing) {
  const DrivePoint point{t_s, base_in_map, speed_mps, standing};
  if (!seen_) {
    seen_ = true;
    last_ = point;
    still_since_s_ = t_s;
    trace_.push_back(point);

    return;
  }

  const double dt_s = t_s - last_.t_s;
  if (dt_s <= 0.0) return;

  // Way and speed since the sample before.
  distance_m_ += geometry::distance(last_.base_in_map.position(), base_in_map.position());
  max_speed_mps_ = std::max(max_speed_mps_, speed_mps);

  const double turning_radps = std::fabs(geometry::wrap(base_in_map.yaw - last_.base_in_map.yaw)) / dt_s;
  if (speed_mps > kStill_mps || turning_radps > kStill_radps) {
    still_since_s_ = -1.0;
    moved_since_stop_ = true;
  } else if (still_since_s_ < 0.0) {
    still_since_s_ = t_s;
  }

  // Once for each time that it stands.
  if (still_since_s_ >= 0.0 && moved_since_stop_ && t_s - still_since_s_ >= kStand_s) {
    moved_since_stop_ = false;
    if (goal_open) ++stops_;
  }

  last_ = point;
  if (t_s - trace_.back().t_s >= kTrace_s || standing != trace_.back().standing) trace_.push_back(point);
}

}  // namespace aisle::referee
