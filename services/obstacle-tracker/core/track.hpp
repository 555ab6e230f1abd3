#pragma once
#include <array>
#include <cstdint>

#include "common/geometry/pose.hpp"

namespace aisle::obstacle_tracker {

/// One real obstacle as the fleet knows it, in map.
struct Track {
  std::uint64_t id{0};
  geometry::Point2 position_in_map;
  geometry::Point2 velocity_in_map;     // m/s
  std::array<double, 16> covariance{};  // of (x, y, vx, vy), row by row
  double radius_m{0.25};
  double age_s{0.0};
  double unseen_s{0.0};
  bool is_static{false};
};

}  // namespace aisle::obstacle_tracker
