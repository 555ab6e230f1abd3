#pragma once

#include <vector>

#include "common/grid/clearance.hpp"
#include "services/local-planner/core/route.hpp"

namespace aisle::local_planner {

/// How a lane is made of a plan's turning points.
struct LaneSettings {
  double margin_m{0.10};  // a lane keeps this from walls, where the plan itself does
  double roomy_m{0.3};    // with so much between vehicle and walls it hardly slows down; 0: walls do not slow it
};

/// The way to drive, and how far along the plan each of its points lies.
struct Lane {
  Lane() = default;

  /// The route is the plan's own.
  explicit Lane(Route plan);

  /// Points closer than 1 cm to the one before are dropped, as a route does.
  Lane(const std::vector<geometry::Point2>& points_in_map, const std::vector<double>& points_plan_m);

  /// What is left of the lane where the plan has been driven so far; detours before that point do not change it.
  double left_m(double along_plan_m) const;

  Route route;
  std::vector<double> plan_m;  // of each point of the route, does not fall
};

/// The plan's turning points as the way to drive where all the free floor is the vehicle's: a point every 0.2 m,
/// rounded at the turns. First and last point are the plan's own. Nowhere nearer to walls than the plan or `radius_m` +
/// margin.
///
/// How: the plan's points are relaxed, each towards the middle of its neighbours and its own place, and away from walls
/// that are so near that the vehicle would slow down. Where the result is too near to walls the plan itself is driven.
Lane make_lane(const std::vector<geometry::Point2>& waypoints_in_map, const grid::ClearanceField& clearance,
               double radius_m, const LaneSettings& settings);

/// A turn of a polyline, and the arc that rounds it.
struct RoundedTurn {
  geometry::Point2 in_map;
  double arc_m{0.0};  // from the arc's begin to the turn, and from there to its end; 0: no arc
};

/// The polyline through the turns, first and last included, with an arc at each turn that has one: tangent to both
/// legs. A point every 0.2 m, on arcs every 0.1 m. @pre arcs do not overlap
Lane rounded_lane(const std::vector<RoundedTurn>& turns);

/// How far the arc's middle lies from a turn by `turn_rad`: arc (1 - cos(turn / 2)) / sin(turn / 2).
double arc_off_turn_m(double arc_m, double turn_rad);

/// What a speed profile keeps to.
struct ProfileLimits {
  double max_speed_mps{1.2};
  double max_turn_radps{1.2};
  double comfort_mps2{0.6};     // braking
  double lateral_mps2{0.6};     // in bends
  bool slows_on_the_way{true};  // false: only to stand at its end
  double at_wall_mps{0.35};     // where a wall is touched,
  double gap_rate{2.2};         // and so much faster, in m/s, a metre of gap
  bool stops_at_turns{false};   // sharp ones are no bends: the vehicle turns there on the spot
};

/// Speed for each point of `route`, in m/s: slow in bends (lateral acceleration and turn rate) and where walls are
/// near, 0 at the end, and reachable by braking with `comfort_mps2`.
///
/// How: first each point's own bound, sqrt(lateral / curvature) and turn rate / curvature in a bend of `curvature`;
/// then from the end backwards v[i-1] <= sqrt(v[i]^2 + 2 comfort ds).
std::vector<double> speed_profile(const Route& route, const grid::ClearanceField& clearance, double radius_m,
                                  const ProfileLimits& limits);

}  // namespace aisle::local_planner
