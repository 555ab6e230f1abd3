#pragma once

#include <optional>
#include <string>

#include "common/geometry/pose.hpp"

namespace aisle::fleet {

/// A person says that the vehicle drives no more: nobody waits for its word. Ends when the vehicle is heard again.
struct SignOff {
  std::string agv_id;
  std::optional<geometry::Point2> place_in_map;  // where the person sees it; none: it holds all that it may drive
};

}  // namespace aisle::fleet
