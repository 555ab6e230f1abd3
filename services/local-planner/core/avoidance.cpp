#include "services/local-planner/core/avoidance.hpp"

#include <algorithm>

#include "services/local-planner/core/local_search.hpp"
#include "services/local-planner/core/speed_policy.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;

constexpr double kBeforeObstacleM = 0.1;  // it stops before where its lane is obstructed
constexpr double kThereM = 0.12;          // so near to its end a way back is driven
constexpr double kLongestBackS = 20.0;    // then it comes back, whether or not it got there
constexpr double kReachM = 8.0;           // of the search for a way back, from the vehicle
constexpr double kTowardsM = 1.0;         // the lane's point so far ahead says what is left and right
constexpr double kLeastAwayM = 0.7;
constexpr double kWallMarginM = 0.06;  // of a way back
constexpr double kDiscMarginM = 0.10;

const char* told(Detour::Kind kind) {
  switch (kind) {
    case Detour::Kind::kAroundThing:
      return "detour around an obstacle";
    case Detour::Kind::kPastWalker:
      return "past somebody who walks on the lane";
    case Detour::Kind::kBackToLane:
      break;
  }

  return "back to the lane";
}

}  // namespace

/// The arguments of one call of rule(), and its answer so far.
struct Avoidance::Cycle {
  const Moment& moment;
  const Surroundings& around;
  const Leave& leave;
  Way& way;
  Stuck& stuck;
  Ruling ruling{};
};

Avoidance::Avoidance(const Settings& settings, bool knows_path)
    : settings_(settings), knows_path_(knows_path), detours_(settings.lane) {}

Ruling Avoidance::rule(const Moment& moment, const Surroundings& around, const Leave& leave, Way& way, Stuck& stuck) {
  Cycle cycle{moment, around, leave, way, stuck};
  go_around(cycle);
  limit(cycle);

  if (way.backs_off()) come_back(cycle);
  back_off(cycle);

  return cycle.ruling;
}

const Blocked* Avoidance::blocking(const Way& way) const {
  return blocked() && !way.backs_off() ? &*blocked() : nullptr;
}

/// Splices a way around what stands on the lane, or back to the lane.
void Avoidance::go_around(Cycle& cycle) {
  Way& way = cycle.way;
  if (way.backs_off()) return;
  if (cycle.leave.is_in_tube) return detours_.look_in_tube(cycle.moment, cycle.around, way, cycle.leave.stop_at_m);
  if (!knows_path_) return;

  const auto detour = detours_.look(cycle.moment, cycle.around, way, cycle.leave.stop_at_m);
  if (!detour) return;

  cycle.ruling.events.push_back({told(detour->kind)});
  const double left_before_m = way.lane().length_m() - way.lane_s_m();
  way.detour(detour->points_in_map, detour->rejoin_m);
  cycle.stuck.lengthen(way.lane().length_m() - way.lane_s_m() - left_before_m);
}

/// Speeds of the current way, and where it ends for now: with what is granted, or before what obstructs the lane.
void Avoidance::limit(Cycle& cycle) const {
  const Moment& moment = cycle.moment;
  Way& way = cycle.way;
  way.profile(*moment.inputs.clearance, moment.way_radius_m(),
              profile_limits(moment.vehicle.limits, settings_, cycle.leave.is_in_tube));

  cycle.ruling.stop_at_m = std::numeric_limits<double>::infinity();
  if (way.backs_off()) return;

  cycle.ruling.stop_at_m = cycle.leave.stop_at_m;
  if (const Blocked* by = blocking(way))
    cycle.ruling.stop_at_m = std::min(cycle.ruling.stop_at_m, by->where.begin_m - kBeforeObstacleM);
}

/// Leaves the way back once the vehicle stands at its end, or it has taken too long.
void Avoidance::come_back(Cycle& cycle) {
  const bool is_there = cycle.way.left_m() < kThereM && cycle.moment.motion.stands();
  if (!is_there && time::seconds(cycle.moment.now - backed_off_) <= kLongestBackS) return;
  cycle.way.come_back();

  detours_.hasten();
  cycle.way.progress(cycle.moment.here());
  go_around(cycle);
  limit(cycle);
}

/// Once trying has gone on for long enough: drives to a place a metre away, to try again from there.
void Avoidance::back_off(Cycle& cycle) {
  const bool waits = cycle.way.s_m() > cycle.leave.stop_at_m - kThereM;
  const bool is_closed = blocked() && blocked()->vehicle_id.empty();
  const double left_m = cycle.way.lane().length_m() - cycle.way.lane_s_m();
  const Attempt attempt{left_m, waits, cycle.way.backs_off(), is_closed, cycle.moment.vehicle.limits};

  if (!cycle.stuck.has_tried_enough(attempt, cycle.moment.now) || cycle.leave.is_in_tube) return;

  const std::vector<Point2> points = way_back(cycle.moment, cycle.around, cycle.way);
  if (points.empty()) return;

  cycle.way.back_off(points);
  backed_off_ = cycle.moment.now;
  limit(cycle);
  cycle.ruling.events.push_back({"backs off to try again"});
}

std::vector<Point2> way_back(const Moment& moment, const Surroundings& around, const Way& way) {
  if (!moment.vehicle.turns_on_the_spot()) return {};

  // Peers stand where they are, and what stands for good is in the way as well.
  std::vector<Disc> discs = around.standing_discs;
  for (const PeerMotion& peer : around.peer_motions) discs.push_back({peer.stopping_in_map.front(), peer.radius_m});
  const Room room{*moment.inputs.clearance, discs, moment.vehicle.reach_m(), kWallMarginM, kDiscMarginM};

  const Point2 here = moment.here();
  const auto accepts = [&](Point2 p) { return geometry::distance(p, here) >= kLeastAwayM; };
  const Point2 towards = way.lane().at(way.lane_s_m() + kTowardsM);
  auto points = search_way(room, here, towards, kReachM, accepts);

  return points.size() < 2 ? std::vector<Point2>{} : points;
}

}  // namespace aisle::local_planner
