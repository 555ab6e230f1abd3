#pragma once

#include <optional>
#include <vector>

#include "services/local-planner/core/rollout.hpp"
#include "services/local-planner/core/room.hpp"
#include "services/local-planner/core/route.hpp"

namespace aisle::local_planner {

// Of the rolling window: the lidar's range r. WU eqs. 6 and 7 ask that (v1 + v2) T < r, so that nothing crosses the
// window between two looks: with T = 0.1 s it holds up to 100 m/s.
inline constexpr double kWindowM = 10.0;
inline constexpr double kMeetingS = 4.0;  // how far ahead the status says what will be met,
inline constexpr double kAvoidS = 3.0;    // and the path is left for: tracks do not keep their course for longer

/// Where two discs at constant velocity come nearest to each other.
struct Approach {
  double time_s{0.0};      // from now, within the horizon
  double distance_m{0.0};  // of their centres then
};

/// t* = clamp(-p.u / u.u, 0, horizon) of the relative position p and velocity u; without relative motion it is now. WU
/// eqs. 8 to 12 say the same by the law of cosines; eq. 11's minus sign and its "delta >= 0" fail where the other moves
/// away, and are not used.
Approach closest_approach(geometry::Point2 relative_position, geometry::Point2 relative_velocity, double horizon_s);

/// What will be met in the window, WU section 4.
enum class Encounter { kNone, kStatic, kOncoming, kCrossing, kOvertaking };
const char* name(Encounter encounter);

struct Meeting {
  Encounter encounter{Encounter::kNone};
  Approach approach;
  geometry::Point2 at_in_map;  // where the other is then
};

/// The first predicted collision within the window: |p + u t*| less than both radii and the margin, which grows with
/// time and the track's uncertainty. None: keep to the global path.
/// @param window_m what is farther than this is not looked at; the sensor's range
Meeting predict_meeting(const Scene& scene, double window_m, double horizon_s);

/// What a sub-target is looked for in.
struct Window {
  const Scene& scene;  // the vehicle, and movers that may be met
  const Room& room;    // walls and what stands
  const Route& route;  // to the goal
  double s_m{0.0};     // where the vehicle is on it
  double radius_m{kWindowM};
  double horizon_s{kAvoidS};
};

/// WU eq. 13: the goal where it is inside the window, else the free point of the window's border that is nearest to the
/// goal, of those that can be reached. Here:
/// - reachable: straight on, within 0.8 rad of the heading and with room all along, for the dynamic window knows no
///   path; and without a predicted collision, or the vehicle would be led to where it is to be led away from;
/// - nearest to the goal: along the border, to where the route leaves the window; in a straight line a building's dead
///   ends would be nearest;
/// - the window: at most the sensor's range, or to the goal. In aisles no point is in sight at that range, so smaller
///   windows are tried too, down to a seventh.
///
/// How: for each window, largest first, the bearing to the route's exit and then bearings ever farther to either side;
/// the first that is reachable gives the point. None: no bearing is reachable; keep to the path.
std::optional<geometry::Point2> local_sub_target(const Window& window);

/// The first predicted collision of the window while the vehicle drives straight at `target_in_map`, as fast as now or
/// at 0.4 m/s.
Meeting meeting_towards(const Window& window, geometry::Point2 target_in_map);

/// WU's strategy: the sub-target while the straight way to `path_target_in_map` ends in a predicted collision with what
/// stands, comes or crosses. None: keep to the path: no collision is predicted, or one with a slower mover ahead, which
/// is followed, or there is no sub-target.
std::optional<geometry::Point2> avoid(const Window& window, geometry::Point2 path_target_in_map);

}  // namespace aisle::local_planner
