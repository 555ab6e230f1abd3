#include "services/local-planner/core/right_of_way/right_of_way.hpp"

#include <algorithm>
#include <limits>

#include "common/kinematics/vehicle_model.hpp"
#include "services/local-planner/core/right_of_way/stepping_aside.hpp"
#include "services/local-planner/core/speed_policy.hpp"

namespace aisle::local_planner {
namespace {

constexpr double kReactionS = 0.15;       // from now to when a vehicle that must stop begins to brake
constexpr double kBeforeObstacleM = 0.1;  // it stops before where its lane is obstructed
constexpr double kThereM = 0.12;          // so near to its end a way aside is driven
constexpr double kLongestAsideS = 20.0;   // then it comes back, whether or not it got there
constexpr double kStopsForAskingS = 0.5;  // a vehicle that has stood for so long stays where it is asked for room,
constexpr double kMakesRoomS = 1.0;       // and one that has stood for so long looks for a place aside,
constexpr double kLookAgainS = 2.0;       // so often

}  // namespace

/// The arguments of one call of rule(), and its answer so far.
struct RightOfWay::Cycle {
  const Moment& moment;
  const Surroundings& around;
  const geometry::Twist2& in_force;
  Way& way;
  Stuck& stuck;
  Ruling ruling{};
};

RightOfWay::RightOfWay(const Settings& settings, bool knows_path)
    : settings_(settings), knows_path_(knows_path), detours_(settings.lane) {}

Ruling RightOfWay::rule(const Moment& moment, const Surroundings& around, const geometry::Twist2& in_force, Way& way,
                        Stuck& stuck) {
  Cycle cycle{moment, around, in_force, way, stuck};
  go_around(cycle);
  ask(cycle);

  if (way.is_aside())
    come_back(cycle);
  else
    make_room(cycle);

  back_off(cycle);
  return cycle.ruling;
}

const Blocked* RightOfWay::blocking(const Way& way) const {
  return blocked() && !way.is_aside() ? &*blocked() : nullptr;
}

double RightOfWay::claim_end_m(const Advice& advice, const Way& way) const {
  const double end_m = advice.follows ? std::numeric_limits<double>::infinity() : advice.stop_at_m;
  const Blocked* by = blocking(way);
  return by != nullptr && by->vehicle_id.empty() ? std::min(end_m, by->where.begin_m) : end_m;
}

/// Splices a way around what stands on the lane, or back to the lane.
void RightOfWay::go_around(Cycle& cycle) {
  Way& way = cycle.way;
  if (!knows_path_ || way.is_aside()) return;
  const auto detour = detours_.look(cycle.moment, cycle.around, way);
  if (!detour) return;

  cycle.ruling.events.push_back({detour->is_around_something ? "detour around an obstacle" : "back to the lane"});
  const double left_before_m = way.lane().length_m() - way.lane_s_m();
  way.detour(detour->points_in_map, detour->rejoin_m);
  cycle.stuck.lengthen(way.lane().length_m() - way.lane_s_m() - left_before_m);
}

/// Asks the fleet's rules about the current way.
void RightOfWay::ask(Cycle& cycle) {
  const Moment& moment = cycle.moment;
  const kinematics::Limits& limits = moment.vehicle.limits;
  Way& way = cycle.way;
  way.profile(*moment.inputs.clearance, moment.way_radius_m(), profile_limits(limits, settings_));

  const double speed_mps = std::max(0.0, cycle.in_force.linear_mps);

  // How far it goes before it can stand: braking, after the time to react.
  const double stopping_m =
      kinematics::stopping_distance_m(speed_mps, limits.max_deceleration_mps2) + speed_mps * kReactionS;
  cycle.ruling.advice = advise({moment.vehicle.id, moment.vehicle.reach_m(), way.s_m(), speed_mps, stopping_m,
                                moment.here(), way.current(), way.profile_mps()},
                               cycle.around.peers, settings_.traffic);

  // Before what obstructs the lane it stops, whatever the rules say.
  cycle.ruling.stop_at_m = cycle.ruling.advice.stop_at_m;
  if (const Blocked* by = blocking(way))
    cycle.ruling.stop_at_m = std::min(cycle.ruling.stop_at_m, by->where.begin_m - kBeforeObstacleM);
}

/// Leaves the way aside once the vehicle stands at its end, or it has taken too long.
void RightOfWay::come_back(Cycle& cycle) {
  const bool is_there = cycle.way.left_m() < kThereM && cycle.moment.motion.stands();
  if (!is_there && time::seconds(cycle.moment.now - stepped_aside_) <= kLongestAsideS) return;
  cycle.way.come_back();

  detours_.hasten();
  cycle.way.progress(cycle.moment.here());
  go_around(cycle);
  ask(cycle);
}

/// Steps aside for peers that go first and whose way runs through here.
void RightOfWay::make_room(Cycle& cycle) {
  const std::vector<std::string> asking = asking_for_room(cycle.ruling.advice, cycle.around, cycle.moment);
  if (asking.empty()) return;

  const double stood_s = cycle.stuck.stood_s(cycle.moment.now);
  if (stood_s > kStopsForAskingS) cycle.ruling.stop_at_m = std::min(cycle.ruling.stop_at_m, cycle.way.s_m());

  const bool is_due = stood_s > kMakesRoomS && time::seconds(cycle.moment.now - stepped_aside_) > kLookAgainS;
  if (is_due && step_aside(cycle, asking)) cycle.ruling.events.push_back({"steps aside for " + asking.front()});
}

/// Once trying has gone on for long enough: drives away from the peers that it is stuck with, or anywhere a metre away.
void RightOfWay::back_off(Cycle& cycle) {
  const Advice& advice = cycle.ruling.advice;
  const bool waits = !advice.yields_to.empty() && !advice.follows;
  const bool is_closed = blocked() && blocked()->vehicle_id.empty();
  const double left_m = cycle.way.lane().length_m() - cycle.way.lane_s_m();
  const Attempt attempt{left_m, waits, cycle.way.is_aside(), is_closed, cycle.moment.vehicle.limits};

  if (!cycle.stuck.has_tried_enough(attempt, cycle.moment.now)) return;

  const std::vector<std::string> with = stuck_with(cycle.around, cycle.moment);
  if (!step_aside(cycle, with) && !with.empty()) step_aside(cycle, {});

  backs_off_ = cycle.way.is_aside();
  if (backs_off_) cycle.ruling.events.push_back({"backs off to try again"});
}

bool RightOfWay::step_aside(Cycle& cycle, const std::vector<std::string>& for_whom) {
  stepped_aside_ = cycle.moment.now;
  const auto points = way_aside(cycle.moment, cycle.around, cycle.way, for_whom, settings_.traffic.margin_m);
  if (points.empty()) return false;

  cycle.way.step_aside(points);
  backs_off_ = false;
  ask(cycle);

  return true;
}

}  // namespace aisle::local_planner
