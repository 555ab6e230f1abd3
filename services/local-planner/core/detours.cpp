#include "services/local-planner/core/detours.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "services/local-planner/core/local_search.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;

constexpr double kSearchPeriodS = 0.2;
constexpr double kLookFromM = 0.2;          // ahead of the vehicle the lane is looked at for obstacles,
constexpr double kLookForObstaclesM = 4.0;  // and so far on
constexpr double kOffLaneM = 0.9;           // so far beside its lane the vehicle is off it,
constexpr double kBackAheadM = 1.0;         // and comes back to it so far ahead
constexpr double kRejoinM = 0.3;            // behind what obstructs the lane
constexpr double kReachM = 7.0;             // of the search, from the vehicle
constexpr double kJoinedM = 0.21;  // so near to the lane's point the detour ends: a bit more than the lattice's step

// Margins to walls and to discs that stand: of a lane that is not obstructed (in a tube), of a usual detour, of a tight
// one.
constexpr double kObstructedWallM = 0.0, kObstructedDiscM = 0.08, kInTubeDiscM = 0.05;
constexpr double kUsualDiscM = 0.15;
constexpr double kTightWallM = 0.05, kTightDiscM = 0.10;

// Walkers that are passed.
constexpr double kSlowShare = 0.6;    // of the vehicle's top speed,
constexpr double kAlongCosine = 0.8;  // of the angle between their way and the lane
constexpr double kWalksForS = 3.0;    // they are looked at for so long,
constexpr double kWalkStepS = 0.5;
constexpr double kBesideWalkerM = 0.35;  // and passed with so much room

/// Does somebody walk ahead along the lane, towards the vehicle, or so slowly that it would drive behind them? On a
/// detour those who come towards it are being passed already.
bool is_to_be_passed(const Mover& mover, const Moment& moment, const Way& way) {
  const double mps = geometry::norm(mover.velocity_in_map);
  if (mps == 0.0) return false;

  const double s_m = way.lane().project(mover.position_in_map, way.s_m(), way.s_m() + kLookForObstaclesM);
  const double yaw = way.lane().heading_at(s_m);
  const double along_mps = geometry::dot(mover.velocity_in_map, {std::cos(yaw), std::sin(yaw)});
  const bool is_slow = mps <= kSlowShare * moment.vehicle.limits.max_speed_mps;
  const bool comes_towards = along_mps < -kAlongCosine * mps && !way.is_on_detour();
  return s_m > way.s_m() && (comes_towards || (is_slow && along_mps > kAlongCosine * mps));
}

/// With what stands nearest to where the lane is obstructed.
Blocked blocked_by(const Obstructed& where, const Surroundings& around) {
  double nearest_m = std::numeric_limits<double>::infinity();
  Blocked blocked{where, {}, {}};
  for (const Standing& standing : around.standing) {
    const double d = geometry::distance(standing.disc.position, where.at_in_map) - standing.disc.radius_m;
    if (d >= nearest_m) continue;
    nearest_m = d;
    blocked.vehicle_id = standing.vehicle_id;
    blocked.thing = standing.disc;
  }

  return blocked;
}

}  // namespace

void Detours::begin() {
  blocked_.reset();
  hasten();
}

std::optional<Detour> Detours::look(const Moment& moment, const Surroundings& around, const Way& way, double most_m) {
  if (time::seconds(moment.now - searched_) < kSearchPeriodS) return std::nullopt;
  searched_ = moment.now;

  const double s_m = way.s_m();
  const double ahead_m = std::min(kLookForObstaclesM, most_m - s_m - kLookFromM);
  const auto obstructed = first_obstructed(way.lane(), s_m + kLookFromM, ahead_m,
                                           moment.room(around, kObstructedWallM, kObstructedDiscM), 0.0);

  const bool is_off_lane = geometry::distance(moment.here(), way.lane().at(s_m)) > kOffLaneM;
  if (!obstructed && !is_off_lane) {
    blocked_.reset();
    return search_past_walkers(moment, around, way, most_m);
  }

  auto detour = search(moment, around, way, obstructed, most_m);
  if (detour) blocked_.reset();
  if (!detour && obstructed) blocked_ = blocked_by(*obstructed, around);

  return detour;
}

void Detours::look_in_tube(const Moment& moment, const Surroundings& around, const Way& way, double most_m) {
  if (time::seconds(moment.now - searched_) < kSearchPeriodS) return;
  searched_ = moment.now;

  Surroundings things;
  for (const Standing& standing : around.standing)
    if (standing.vehicle_id.empty()) things.add_standing(standing.disc, {});

  const double s_m = way.s_m();
  const double ahead_m = std::min(kLookForObstaclesM, most_m - s_m - kLookFromM);
  const auto obstructed =
      first_obstructed(way.lane(), s_m + kLookFromM, ahead_m, moment.room(things, kObstructedWallM, kInTubeDiscM), 0.0);
  blocked_.reset();
  if (obstructed && !things.standing.empty()) blocked_ = blocked_by(*obstructed, things);
}

std::optional<Detour> Detours::search_past_walkers(const Moment& moment, const Surroundings& around, const Way& way,
                                                   double most_m) const {
  Surroundings with_walkers;
  with_walkers.standing_discs = around.standing_discs;
  const std::size_t standing = with_walkers.standing_discs.size();
  for (const Mover& mover : around.movers)
    if (is_to_be_passed(mover, moment, way))
      for (double t_s = 0.0; t_s <= kWalksForS; t_s += kWalkStepS)
        with_walkers.standing_discs.push_back(
            {mover.position_in_map + t_s * mover.velocity_in_map, mover.radius_m + kBesideWalkerM});
  if (with_walkers.standing_discs.size() == standing) return std::nullopt;

  const auto obstructed = first_obstructed(way.lane(), way.s_m() + kLookFromM, kLookForObstaclesM,
                                           moment.room(with_walkers, kObstructedWallM, 0.0), 0.0);
  if (!obstructed || obstructed->end_m > way.lane().length_m()) return std::nullopt;

  const double rejoin_m = std::min(way.lane().length_m(), obstructed->end_m + kRejoinM);
  if (rejoin_m > most_m || !moment.vehicle.turns_on_the_spot()) return std::nullopt;

  const Point2 join = way.lane().at(rejoin_m);
  auto points = search_way(moment.room(with_walkers, lane_.margin_m, 0.0), moment.here(), join, kReachM,
                           [&](Point2 p) { return geometry::distance(p, join) < kJoinedM; });
  if (points.empty()) return std::nullopt;

  return Detour{std::move(points), rejoin_m, Detour::Kind::kPastWalker};
}

std::optional<Detour> Detours::search(const Moment& moment, const Surroundings& around, const Way& way,
                                      const std::optional<Obstructed>& obstructed, double most_m) const {
  const Route& lane = way.lane();

  // Where the detour ends: behind what obstructs the lane, or a metre ahead where the vehicle is off it.
  const double behind_m = obstructed ? obstructed->end_m : std::min(lane.length_m(), way.s_m() + kBackAheadM);
  if (behind_m > lane.length_m() || !moment.vehicle.turns_on_the_spot()) return std::nullopt;

  const double rejoin_m = std::min(lane.length_m(), behind_m + kRejoinM);
  if (rejoin_m > most_m) return std::nullopt;

  const Point2 join = lane.at(rejoin_m);

  const auto accepts = [&](Point2 p) { return geometry::distance(p, join) < kJoinedM; };

  const Room usual = moment.room(around, lane_.margin_m, kUsualDiscM);
  const Room tight = moment.room(around, kTightWallM, kTightDiscM);

  auto points = search_way(usual, moment.here(), join, kReachM, accepts);
  if (points.empty()) points = search_way(tight, moment.here(), join, kReachM, accepts);
  if (points.empty()) return std::nullopt;

  return Detour{std::move(points), rejoin_m, obstructed ? Detour::Kind::kAroundThing : Detour::Kind::kBackToLane};
}

}  // namespace aisle::local_planner
