#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tools/lab/tracking/contestant.hpp"
#include "tools/lab/tracking/scene.hpp"
#include "tools/lab/tracking/scoring.hpp"

namespace aisle::tracking {

/// The properties of the sensors. Every vehicle scans at 10 Hz, one after another within the tenth of a
/// second.
struct Sensing {
  double range_noise_m{0.02};
  double pose_noise_m{0.02};
  double yaw_noise_rad{0.5 * geometry::kPi / 180.0};
  double range_m{10.0};
  int rays{360};
  double sweep_s{0.1};  // from the first ray to the last, while vehicle and people move on
};

/// How one contestant did.
struct Row {
  std::string tracker;
  Score score;
  double coverage{0.0};  // share of people-seconds in which a ray touched the person within the last second
  double scan_ms_p50{0.0};
  double scan_ms_p99{0.0};
  double core_share{0.0};  // CPU time over simulated time
};

/// One moment of a trial for a drawing, ten times a second.
struct Glance {
  double t_s{0.0};
  const Moment& truth;
  const std::vector<std::vector<fleet::Track>>& tracks;  // of each contestant
};

/// The same scans for all contestants, judged together ten times a second; ends with the scene or after `longest_s`.
/// The same seed gives the same rows, but for the times.
std::vector<Row> run_trial(Scene& scene, const Sensing& sensing, std::uint64_t seed,
                           const std::vector<std::unique_ptr<Contestant>>& contestants, double longest_s = 1e9,
                           const std::function<void(const Glance&)>& watch = {});

}  // namespace aisle::tracking
