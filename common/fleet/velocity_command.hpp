#pragma once

#include <cstdint>
#include <string>

#include "common/geometry/pose.hpp"

namespace aisle::fleet {

/// How a vehicle shall move until the next command, 50 times a second.
struct VelocityCommand {
  std::string agv_id;
  std::string goal_id;  // empty: no goal
  std::uint64_t plan_id{0};
  std::uint64_t map_revision{0};
  geometry::Twist2 twist;         // in the vehicle's frame; each component within 100
  std::int64_t scan_stamp_ns{0};  // Unix epoch, of the newest scan that this command knows of
  double control_ms{0.0};         // computing time of its cycle
};

}  // namespace aisle::fleet
