#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/grid/clearance.hpp"

namespace aisle::global_planner {

/// How a vehicle drives that cannot turn on the spot, for planners that know headings (`hybrid`). The others ignore it.
struct Steering {
  double turning_radius_m{0.0};  // of the tightest forward arc; 0: it turns on the spot, and headings do not matter
  double start_yaw_rad{0.0};
  std::optional<double> goal_yaw_rad;  // none: any heading will do
  bool may_reverse{true};

  /// Centres of further discs of the problem's radius, ahead of the vehicle's frame: together they cover a long
  /// footprint.
  std::vector<double> discs_ahead_m{};
};

/// Plan from start to goal for a vehicle whose centre keeps `radius_m` (its radius and safety margin) away from every
/// cell that is not free.
///
/// A vehicle may stand nearer to an obstacle than its margin allows, and a goal may lie so. Within `tight_range_m` of
/// such a start or goal the radius shrinks to what its cell offers, but never below `least_radius_m` (the bare
/// vehicle).
struct Problem {
  const grid::ClearanceField& clearance;
  geometry::Point2 start_in_map;
  geometry::Point2 goal_in_map;
  double radius_m{0.0};
  double least_radius_m{1e9};  // radius_m and more: starts and goals get no exception
  double tight_range_m{1.5};

  /// The distance that passes with a safe distance (QU, YU) keep beside the lines they draw, when more than `radius_m`.
  double safe_distance_m{0.0};

  /// A metre nearer to an obstacle than this costs more, for planners that prefer clearance (`clear`); 0: twice the
  /// radius.
  double preferred_clearance_m{0.0};
  Steering steering{};
};

/// kOutOfMap also says that the problem's numbers make no sense.
enum class Outcome { kFound, kNoPath, kStartBlocked, kGoalBlocked, kOutOfMap, kOutOfTime };

/// The result of a search.
struct PlannedPath {
  Outcome outcome{Outcome::kNoPath};
  std::vector<geometry::Point2> waypoints_in_map;  // first the start, last the goal, both exact; empty unless kFound
  double length_m{0.0};
  std::size_t expanded{0};           // cells popped and not stale
  std::vector<double> headings_rad;  // at each waypoint; empty unless the planner knows headings and they matter
};

/// True when a search must end. Asked between expansions, every 256 of them.
using OutOfTime = std::function<bool()>;

class Drivable;

/// A search and its list of passes. Keeps its memory between calls, so that an object serves one thread only.
class Planner {
 public:
  virtual ~Planner() = default;

  /// Checks the problem (in the map, start and goal traversable), then searches. A blocked or unreachable goal is an
  /// outcome, never an exception.
  [[nodiscard]] PlannedPath plan(const Problem& problem, const OutOfTime& out_of_time);

  /// The same into `plan`, whose memory is used again: planners that take a blank() plan allocate nothing once it is
  /// large enough.
  void plan(const Problem& problem, const OutOfTime& out_of_time, PlannedPath& plan);

  /// Gives the search's memory back, until the next search.
  virtual void rest() {}

 protected:
  /// A plan to fill, with the memory of one that is no longer needed.
  PlannedPath blank();

 private:
  /// Called when both ends are in the map and drivable, and lie in different cells. length_m is set by the caller.
  virtual PlannedPath search(const Problem& problem, const Drivable& drivable, const OutOfTime& out_of_time) = 0;

  std::vector<geometry::Point2> spare_;  // empty, with room
};

/// Does the point lie in the grid? False also for points that are not finite.
bool is_in_map(const grid::Geometry& geometry, geometry::Point2 in_map);

/// Sum of the distances between neighbouring points.
double path_length_m(const std::vector<geometry::Point2>& path);

}  // namespace aisle::global_planner
