#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "common/grid/clearance.hpp"

namespace aisle::global_planner {

/// Plan from start to goal for a vehicle whose centre keeps `radius_m` (its radius and safety margin) from whatever is not free.
struct Problem {
  const grid::ClearanceField& clearance;
  geometry::Point2 start_in_map;
  geometry::Point2 goal_in_map;
  double radius_m{0.0};
};

enum class Outcome { kFound, kNoPath, kStartBlocked, kGoalBlocked, kOutOfMap, kOutOfTime };

struct Plan {
  Outcome outcome{Outcome::kNoPath};
  std::vector<geometry::Point2> waypoints_in_map;   // first the start, last the goal, both exact; empty unless kFound
  double length_m{0.0};
  std::size_t expanded{0};                          // cells popped and not stale
};

/// Looked at between expansions.
using OutOfTime = std::function<bool()>;

/// A search and its list of passes. Not for several threads at once: it keeps its memory between calls.
class Planner {
 public:
  virtual ~Planner() = default;
  /// Checks the problem (in the map, start and goal traversable), then searches.
  [[nodiscard]] Plan plan(const Problem& problem, const OutOfTime& out_of_time);

 private:
  virtual Plan search(const Problem& problem, const OutOfTime& out_of_time) = 0;
};

}  // namespace aisle::global_planner
