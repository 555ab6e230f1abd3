#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::fleet {

/// One real obstacle as the fleet's tracker estimates it. What does not move is a track too.
struct Track {
  std::uint64_t id{0};
  geometry::Point2 position_in_map;     // m, of its centre
  geometry::Point2 velocity_in_map;     // m/s, each component within 100
  std::array<double, 16> covariance{};  // of (x, y, vx, vy), row by row; m, m/s
  double radius_m{0.25};                // 0 to 100
  double age_s{0.0};                    // since it was first seen
  double unseen_s{0.0};                 // since a ray last touched it
  bool is_static{false};                // has stood for 3 s
  std::int64_t scan_stamp_ns{0};        // Unix epoch, of the newest scan used
};

/// The newest scan of a vehicle that is in the tracks.
struct ScanUse {
  std::string agv_id;
  std::uint64_t scan_sequence{0};  // of the writer of its scans
  std::int64_t scan_stamp_ns{0};   // Unix epoch
};

/// Written after each scan: the tracker works, up to which scans, and which tracks live.
struct TrackingStatus {
  std::string source_id;                      // instance of the tracker
  std::vector<ScanUse> newest_scans;          // at most 256
  std::vector<std::uint64_t> live_track_ids;  // at most 1024
  std::uint64_t scans_used{0};
  std::uint64_t scans_dropped{0};
  double processing_ms{0.0};
};

}  // namespace aisle::fleet
