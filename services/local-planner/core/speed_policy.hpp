#pragma once

#include "services/local-planner/core/lane.hpp"
#include "services/local-planner/core/moment.hpp"
#include "services/local-planner/core/settings.hpp"
#include "services/local-planner/core/surroundings.hpp"
#include "services/local-planner/core/way.hpp"

namespace aisle::local_planner {

/// What the speed profile of a way keeps to: the vehicle's limits, braked with comfort. In a tube, which is followed to
/// a few centimetres, walls slow down less.
ProfileLimits profile_limits(const kinematics::Limits& limits, const Settings& settings, bool is_in_tube);

/// What a cycle's highest speed looks at.
struct SpeedQuestion {
  const Moment& moment;
  const Way& way;
  const Surroundings& around;

  geometry::Point2 target_in_map;
  double stop_at_m{0.0};   // of the way, not passed; infinity: none
  bool is_in_tube{false};  // it cannot swing away from anybody
};

/// The highest speed of this cycle, in m/s: the least of
/// - the way's profile, where the vehicle will be when the command acts;
/// - what brakes in comfort before `stop_at_m`, v = sqrt(2 a d);
/// - what leaves time to turn, where the target is far off the heading;
/// - a careful speed, while the plan is of an older map;
/// - in a tube, what brakes in comfort before each place of the way that a walker comes to in the next seconds, if the
///   vehicle is not through well before;
/// - the speed of each zone that the vehicle is in, and what brakes in comfort before one;
/// - what the distance to each person allows: 0.25 m/s beside one, 0.5 m/s more a metre of gap; and a creep beside
///   what stood for long and came there on its feet. Who is behind the vehicle, and stays there, does not count.
double speed_cap_mps(const SpeedQuestion& question, const Settings& settings);

}  // namespace aisle::local_planner
