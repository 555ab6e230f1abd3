#pragma once
#include <optional>
#include <vector>

#include "services/local-planner/core/rollout.hpp"
#include "services/local-planner/core/route.hpp"

namespace aisle::local_planner {

/// Where two discs at constant velocity come nearest to each other.
struct Approach {
  double time_s{0.0};               // from now, within the horizon
  double distance_m{0.0};           // of their centres then
};

/// t* = clamp(-p.u / u.u, 0, horizon) of the relative position p and velocity u; without relative motion it is now. WU eqs. 8 to 12 say
/// the same by the law of cosines; eq. 11's minus sign and its "delta >= 0" fail where the other moves away, and are not used.
Approach closest_approach(geometry::Point2 relative_position, geometry::Point2 relative_velocity, double horizon_s);

/// What will be met in the window, WU section 4.
enum class Encounter { kNone, kStatic, kOncoming, kCrossing, kOvertaking };
const char* name(Encounter encounter);

struct Meeting {
  Encounter encounter{Encounter::kNone};
  Approach approach;
  geometry::Point2 at_in_map;       // where the other is then
};

/// The first predicted collision within the window: |p + u t*| less than both radii and the margin, which grows with time and the track's
/// uncertainty. None: keep to the global path.
/// @param window_m what is farther than this is not looked at; the sensor's range
Meeting predict_meeting(const Scene& scene, double window_m, double horizon_s);

/// WU eq. 13: the goal where it is inside the window, else the route's last point inside it.
geometry::Point2 local_sub_target(const Route& route, double s_m, geometry::Point2 here_in_map, double window_m);

}  // namespace aisle::local_planner
