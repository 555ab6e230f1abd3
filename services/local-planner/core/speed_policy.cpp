#include "services/local-planner/core/speed_policy.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace aisle::local_planner {
namespace {

using geometry::Point2;

constexpr double kLateralMps2 = 0.6;         // in bends
constexpr double kMostInTubeMps = 1.35;      // in a tube, where it can only brake: it then stands within a metre
constexpr double kAtWallInTubeMps = 0.5;     // along walls in a tube,
constexpr double kGapRateInTube = 4.0;       // and m/s more a metre of gap
constexpr double kLeastProfileMps = 0.1;     // a way's end is reached at this speed, not at none
constexpr double kStopMarginM = 0.02;        // before the point that is not passed
constexpr double kTurnedAwayRad = 0.35;      // a target farther off the heading slows it down,
constexpr double kTurnedAwayShare = 0.8;     // to this share of the full speed's part towards the target,
constexpr double kLeastTurnedAwayMps = 0.2;  // and no further
constexpr double kBesidePersonM = 0.25;  // so near to a person that stood for long it creeps: a person sets off faster
constexpr double kPersonAheadS[] = {0.0, 0.5, 1.0};  // a walker's nearest place of these times counts
constexpr double kPersonGapM = 0.2;                  // nearer to a person than this it drives at the least speed:
constexpr double kLeastPersonMps = 0.25;
constexpr double kCrossesWithinS = 2.5;  // so soon a walker comes to the way,
constexpr double kCrossStepS = 0.25;     // looked at so finely,
constexpr double kCrossesAheadM = 5.0;   // so far ahead,
constexpr double kBesideWayM = 0.1;      // or so near beside it;
constexpr double kThroughBeforeS = 0.7;  // the vehicle may be through so long before,
constexpr double kBeforeWalkerM = 0.4;   // or stands so far away
constexpr double kBesideZoneM = 0.1;     // so near beside a zone with a speed it is in it,
constexpr double kBeforeZoneM = 0.3;     // and so far before it has that speed
constexpr double kPersonGapRate = 0.5;   // m/s a metre of gap beyond

/// The speed from which it brakes to a stand within the distance: v = sqrt(2 a d).
double bounded_by_braking_mps(double distance_m, double braking_mps2) {
  return std::sqrt(2.0 * braking_mps2 * std::max(0.0, distance_m));
}

/// Beside something that stood for long: a creep where it once walked, else no bound.
double cap_beside_standing_mps(const Moment& moment, const Mover& mover) {
  if (!mover.has_walked) return std::numeric_limits<double>::infinity();

  return kCreepMps + std::max(0.0, moment.gap_then_m(mover) - kBesidePersonM);
}

/// Is it behind the vehicle, and will be for the next second, however slowly the vehicle drives on? Of what stands,
/// where the vehicle drives away from it: behind its middle.
bool stays_behind(const Moment& moment, const Mover& mover) {
  const geometry::Pose2& then = moment.motion.base_then;
  if (!mover.may_walk) return geometry::from_map(then, mover.position_in_map).x < 0.0;

  return std::all_of(std::begin(kPersonAheadS), std::end(kPersonAheadS), [&](double t_s) {
    const Point2 there = mover.position_in_map + t_s * mover.velocity_in_map;
    return geometry::from_map(then, there).x < -moment.vehicle.reach_m();
  });
}

/// By the gap to where a walker is nearest within the next second.
double cap_beside_person_mps(const Moment& moment, const Mover& mover) {
  const Point2 then = moment.motion.base_then.position();
  double distance_m = std::numeric_limits<double>::infinity();

  for (const double t_s : kPersonAheadS)
    distance_m = std::min(distance_m, geometry::distance(then, mover.position_in_map + t_s * mover.velocity_in_map));

  const double gap_m = std::max(0.0, distance_m - moment.vehicle.reach_m() - mover.radius_m - kPersonGapM);

  return kLeastPersonMps + kPersonGapRate * gap_m;
}

/// What brakes before where the walker, going on as now, comes to the way; infinity: nowhere, or long after the
/// vehicle.
double cap_before_crossing_mps(const SpeedQuestion& question, const Mover& mover, double s_m, double braking_mps2) {
  const Route& route = question.way.current();
  const double reach_m = question.moment.vehicle.reach_m() + mover.radius_m;
  const double mps = std::max(kLeastPersonMps, question.moment.motion.measured_mps);

  for (double t_s = 0.0; t_s <= kCrossesWithinS; t_s += kCrossStepS) {
    const Point2 there = mover.position_in_map + t_s * mover.velocity_in_map;
    const double at_m = route.project(there, s_m, s_m + kCrossesAheadM);
    const bool is_on_way = at_m > s_m && geometry::distance(route.at(at_m), there) < reach_m + kBesideWayM;
    const bool is_through_before = (at_m + reach_m - s_m) / mps < t_s - kThroughBeforeS;
    if (is_on_way && !is_through_before)
      return bounded_by_braking_mps(at_m - reach_m - kBeforeWalkerM - s_m, braking_mps2);
  }

  return std::numeric_limits<double>::infinity();
}

/// What brakes in comfort before the zone's speed holds; infinity: the vehicle does not come to it soon.
///
/// How: the zone is looked for along the way, and straight ahead, over the distance that it takes to brake to the
/// zone's speed.
double cap_before_zone_mps(const SpeedQuestion& question, const fleet::Zone& zone, double s_m, double braking_mps2) {
  constexpr double kLookM = 0.1;
  const Moment& moment = question.moment;
  const geometry::Pose2& then = moment.motion.base_then;
  const double reach_m = moment.vehicle.reach_m() + kBesideZoneM;
  const double top_mps = moment.vehicle.limits.max_speed_mps;
  const double brakes_m =
      std::max(0.0, top_mps * top_mps - zone.max_speed_mps * zone.max_speed_mps) / (2.0 * braking_mps2) + kBeforeZoneM;

  const auto is_in = [&](Point2 at) { return fleet::distance_m(zone, at, at) < reach_m; };
  if (is_in(then.position())) return zone.max_speed_mps;
  if (fleet::distance_m(zone, then.position(), then.position()) > reach_m + brakes_m)
    return std::numeric_limits<double>::infinity();

  const Point2 ahead{std::cos(then.yaw), std::sin(then.yaw)};
  for (double on_m = kLookM; on_m <= brakes_m; on_m += kLookM) {
    if (!is_in(question.way.current().at(s_m + on_m)) && !is_in(then.position() + on_m * ahead)) continue;

    const double left_m = std::max(0.0, on_m - kLookM - kBeforeZoneM);
    return std::sqrt(zone.max_speed_mps * zone.max_speed_mps + 2.0 * braking_mps2 * left_m);
  }

  return std::numeric_limits<double>::infinity();
}

/// Where the target is far off the heading: the part of the full speed that leads towards it.
double cap_turned_away_mps(const Moment& moment, Point2 target_in_map) {
  const geometry::Pose2& then = moment.motion.base_then;
  const double error_rad = std::abs(geometry::wrap(geometry::bearing(then.position(), target_in_map) - then.yaw));
  if (error_rad <= kTurnedAwayRad) return std::numeric_limits<double>::infinity();

  return std::max(kLeastTurnedAwayMps, moment.vehicle.limits.max_speed_mps * std::cos(error_rad) * kTurnedAwayShare);
}

}  // namespace

ProfileLimits profile_limits(const kinematics::Limits& limits, const Settings& settings, bool is_in_tube) {
  ProfileLimits profile;
  profile.max_speed_mps = limits.max_speed_mps;
  profile.max_turn_radps = limits.max_turn_radps;
  profile.comfort_mps2 = std::min(settings.comfort_mps2, limits.max_deceleration_mps2);
  profile.lateral_mps2 = kLateralMps2;
  profile.slows_on_the_way = settings.slows_on_the_way;
  if (is_in_tube) {
    profile.max_speed_mps = std::min(profile.max_speed_mps, kMostInTubeMps);
    profile.stops_at_turns = true;
    profile.at_wall_mps = kAtWallInTubeMps;
    profile.gap_rate = kGapRateInTube;
  }

  return profile;
}

double speed_cap_mps(const SpeedQuestion& question, const Settings& settings) {
  const Moment& moment = question.moment;
  const Way& way = question.way;
  const double s_m = way.backs_off() ? way.s_m() : way.s_near_m(moment.motion.base_then.position(), question.stop_at_m);

  double cap = std::max(kLeastProfileMps, way.speed_at(s_m));
  cap = std::min(cap, bounded_by_braking_mps(question.stop_at_m - s_m - kStopMarginM, settings.comfort_mps2));
  cap = std::min(cap, cap_turned_away_mps(moment, question.target_in_map));

  const bool is_of_an_older_map = moment.inputs.plan->map_revision != moment.inputs.map_revision;
  if (is_of_an_older_map) cap = std::min(cap, settings.cautious_mps);

  if (question.is_in_tube)
    for (const Mover& mover : question.around.movers)
      if (mover.velocity_in_map != Point2{})
        cap = std::min(cap, cap_before_crossing_mps(question, mover, s_m, settings.comfort_mps2));

  for (const fleet::Zone& zone : moment.inputs.zones)
    if (zone.kind == fleet::Zone::Kind::kSpeed)
      cap = std::min(cap, cap_before_zone_mps(question, zone, s_m, settings.comfort_mps2));

  for (const Mover& mover : question.around.movers) {
    if (!way.backs_off() && stays_behind(moment, mover)) continue;
    cap = std::min(cap, mover.may_walk ? cap_beside_person_mps(moment, mover) : cap_beside_standing_mps(moment, mover));
  }

  return cap;
}

}  // namespace aisle::local_planner
