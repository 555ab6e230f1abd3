#pragma once

#include <vector>

#include "common/grid/clearance.hpp"
#include "services/local-planner/core/route.hpp"

namespace aisle::local_planner {

/// Where the lane lies in an aisle.
struct LaneSettings {
  double margin_m{0.10};        // a lane keeps this from walls, where the plan itself does
  double half_spacing_m{0.75};  // of two opposite lanes, where there is room
  double shift_m{0.80};         // a lane leaves the plan by at most this
  double passing_gap_m{0.20};   // two vehicles pass when this is left between them
};

/// The plan's turning points as the way to drive: a point every 0.2 m, rounded at the turns, and moved to the right
/// half of the aisle where two vehicles can pass, to its middle where they cannot. So vehicles that meet head-on pass
/// without any exchange. First and last point are the plan's own. Nowhere nearer to walls than the plan or `radius_m` +
/// margin.
///
/// How: at each point the aisle is measured to both sides, which gives a shift to the right; shifts are averaged and
/// their slope is bounded; the shifted points are then relaxed, each towards the middle of its neighbours and its own
/// place. Where the result is too near to walls the plan itself is driven.
Route make_lane(const std::vector<geometry::Point2>& waypoints_in_map, const grid::ClearanceField& clearance,
                double radius_m, const LaneSettings& settings);

/// What a speed profile keeps to.
struct ProfileLimits {
  double max_speed_mps{1.2};
  double max_turn_radps{1.2};
  double comfort_mps2{0.6};     // braking
  double lateral_mps2{0.6};     // in bends
  bool slows_on_the_way{true};  // false: only to stand at its end
};

/// Speed for each point of `route`, in m/s: slow in bends (lateral acceleration and turn rate) and where walls are
/// near, 0 at the end, and reachable by braking with `comfort_mps2`.
///
/// How: first each point's own bound, sqrt(lateral / curvature) and turn rate / curvature in a bend of `curvature`;
/// then from the end backwards v[i-1] <= sqrt(v[i]^2 + 2 comfort ds).
std::vector<double> speed_profile(const Route& route, const grid::ClearanceField& clearance, double radius_m,
                                  const ProfileLimits& limits);

}  // namespace aisle::local_planner
