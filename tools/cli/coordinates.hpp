#pragma once

#include <string>
#include <vector>

#include "common/geometry/footprint.hpp"
#include "common/geometry/pose.hpp"

namespace aisle::cli {

/// A pose as a person types it; without a yaw every heading is right.
struct TypedPose {
  geometry::Pose2 in_map;
  bool has_yaw{false};
};

/// "X,Y" or "X,Y,YAW" in metres and radians. @throws config::BadInput with `what`, the text and an example
TypedPose parse_pose(const std::string& what, const std::string& text);

/// "LENGTH,WIDTH" or "LENGTH,WIDTH,AHEAD" in metres, as length_m, width_m and ahead_m in scenarios: a rectangle.
/// @throws config::BadInput also for a length or width that is not above 0, and for more than 100 m
geometry::Footprint parse_footprint(const std::string& what, const std::string& text);

/// "a,b,...": exactly `count` finite numbers within 1e6. @throws config::BadInput
std::vector<double> parse_numbers(const std::string& what, const std::string& text, std::size_t count,
                                  const std::string& example);

}  // namespace aisle::cli
