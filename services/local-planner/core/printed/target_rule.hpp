#pragma once
#include <cstddef>

#include "services/local-planner/core/printed/as_printed.hpp"
#include "services/local-planner/core/room.hpp"
#include "services/local-planner/core/route.hpp"
#include "services/local-planner/core/scene.hpp"

namespace aisle::local_planner {

/// What a target rule looks at, at the moment when the next command acts.
struct TargetQuestion {
  const Route& path;         // through the plan's nodes, as they are
  double s_m{0.0};           // of the vehicle's place along it
  std::size_t next_node{1};  // of the path, aimed at last; those before it are reached
  const Scene& scene;        // vehicle, movers, walls
  const Room& room;          // walls and what stands
  const AsPrinted& printed;
};

struct PrintedTarget {
  geometry::Point2 target_in_map;      // of the heading critic, and of WU's dist-2
  geometry::Point2 sub_target_in_map;  // of LI's Yheading
  std::size_t next_node{1};            // of the path, aimed at now
  bool follows_path{false};            // WU: no dynamic window; the target is a point of the path
};

}  // namespace aisle::local_planner
