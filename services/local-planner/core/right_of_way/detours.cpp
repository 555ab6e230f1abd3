#include "services/local-planner/core/right_of_way/detours.hpp"

#include <algorithm>
#include <limits>

#include "services/local-planner/core/right_of_way/local_search.hpp"

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

// Margins to walls and to discs that stand: of a lane that is not obstructed, of a usual detour, of a tight one.
constexpr double kObstructedWallM = 0.0, kObstructedDiscM = 0.08;
constexpr double kUsualDiscM = 0.15;
constexpr double kTightWallM = 0.05, kTightDiscM = 0.10;

/// The vehicle that stands nearest to what obstructs the lane; empty: it is none.
std::string vehicle_at(Point2 at_in_map, const Surroundings& around) {
  double nearest_m = std::numeric_limits<double>::infinity();
  std::string id;
  for (const Standing& standing : around.standing) {
    const double d = geometry::distance(standing.disc.position, at_in_map) - standing.disc.radius_m;
    if (d < nearest_m) {
      nearest_m = d;
      id = standing.vehicle_id;
    }
  }

  return id;
}

}  // namespace

void Detours::begin() {
  blocked_.reset();
  hasten();
}

std::optional<Detour> Detours::look(const Moment& moment, const Surroundings& around, const Way& way) {
  if (time::seconds(moment.now - searched_) < kSearchPeriodS) return std::nullopt;
  searched_ = moment.now;

  const double s_m = way.s_m();
  const auto obstructed = first_obstructed(way.lane(), s_m + kLookFromM, kLookForObstaclesM,
                                           moment.room(around, kObstructedWallM, kObstructedDiscM), 0.0);

  const bool is_off_lane = geometry::distance(moment.here(), way.lane().at(s_m)) > kOffLaneM;
  if (!obstructed && !is_off_lane) {
    blocked_.reset();
    return std::nullopt;
  }

  auto detour = search(moment, around, way, obstructed);
  if (detour) blocked_.reset();
  if (!detour && obstructed) blocked_ = Blocked{*obstructed, vehicle_at(obstructed->at_in_map, around)};

  return detour;
}

std::optional<Detour> Detours::search(const Moment& moment, const Surroundings& around, const Way& way,
                                      const std::optional<Obstructed>& obstructed) const {
  const Route& lane = way.lane();

  // Where the detour ends: behind what obstructs the lane, or a metre ahead where the vehicle is off it.
  const double behind_m = obstructed ? obstructed->end_m : std::min(lane.length_m(), way.s_m() + kBackAheadM);
  if (behind_m > lane.length_m() || !moment.vehicle.turns_on_the_spot()) return std::nullopt;

  const double rejoin_m = std::min(lane.length_m(), behind_m + kRejoinM);
  const Point2 join = lane.at(rejoin_m);

  const auto accepts = [&](Point2 p) { return geometry::distance(p, join) < kJoinedM; };

  const Room usual = moment.room(around, lane_.margin_m, kUsualDiscM);
  const Room tight = moment.room(around, kTightWallM, kTightDiscM);

  auto points = search_way(usual, moment.here(), join, kReachM, accepts);
  if (points.empty()) points = search_way(tight, moment.here(), join, kReachM, accepts);
  if (points.empty()) return std::nullopt;

  return Detour{std::move(points), rejoin_m, obstructed.has_value()};
}

}  // namespace aisle::local_planner
