// Temporary places and motions of the roadmap: starts, goals, cuts of own ways.
#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

#include "services/global-planner/core/traffic/flood.hpp"
#include "services/global-planner/core/traffic/roadmap.hpp"
#include "services/global-planner/core/traffic/straight_way.hpp"

namespace aisle::global_planner::traffic {
namespace {

using geometry::Point2;

constexpr std::array<double, 3> kStraightReachM{1.6, 2.5, 4.0};
constexpr double kNearestReachM = 8.0;
constexpr double kSearchM = 8.0;
constexpr double kSamePlaceM = 0.01;
constexpr std::size_t kSweepsKept = 10;  // until ids are used again

}  // namespace

PlaceId Roadmap::nearest(KindId kind, const geometry::Pose2& base_in_map) const {
  if (clearance_ == nullptr) return kNoId;

  const Net& net = nets_[kind];
  if (!net.kind.turns_on_the_spot()) return nearest_pose(kind, base_in_map);

  const Point2 at = base_in_map.position();
  std::vector<std::pair<double, PlaceId>> near;
  net.places.visit(grown({at, at}, kNearestReachM), [&](PlaceId id) {
    if (!places_[id]->is_closed) near.emplace_back(distance(at, places_[id]->base_in_map.position()), id);
  });
  std::sort(near.begin(), near.end());

  for (const auto& [distance_m, id] : near)
    if (is_straight_way_free(*clearance_, at, places_[id]->base_in_map.position(), net.spec.need_m)) return id;
  return kNoId;
}

PlaceId Roadmap::place_at(KindId kind, const geometry::Pose2& base_in_map) const {
  const Point2 at = base_in_map.position();
  PlaceId found = kNoId;
  place_shapes_.visit({at, at}, [&](PlaceId id) {
    const Place& place = *places_[id];
    if (place.kind != kind || distance(at, place.base_in_map.position()) > kSamePlaceM) return;
    if (place.has_heading && std::abs(geometry::wrap(place.base_in_map.yaw - base_in_map.yaw)) > kSamePlaceM) return;

    // An edit took it away, and another brought the floor back: then it is a new one.
    const bool is_obsolete = place_closed_by_[id] >= kForGood && clearance_->clearance_m(at) >= nets_[kind].spec.need_m;
    if (!is_obsolete) found = std::min(found, id);
  });
  return found;
}

PlaceId Roadmap::temporary_place(KindId kind, const geometry::Pose2& base_in_map, bool is_joined) {
  if (clearance_ == nullptr) return kNoId;

  PlaceId id = place_at(kind, base_in_map);
  const bool is_new = id == kNoId;
  if (is_new) id = add_place(kind, base_in_map, !nets_[kind].kind.turns_on_the_spot(), true);
  if (!is_joined) return id;

  if (places_[id]->is_temporary) join_temporary(id);
  if (is_new && places_[id]->leaving.empty() && places_[id]->entering.empty()) {
    end_place(id);
    return kNoId;
  }

  return id;
}

void Roadmap::join_temporary(PlaceId id) {
  const Place& place = *places_[id];
  const auto leads_to = [&](MotionId m) { return !places_[motions_[m]->to]->is_temporary; };
  const auto comes_from = [&](MotionId m) { return !places_[motions_[m]->from]->is_temporary; };
  if (std::any_of(place.leaving.begin(), place.leaving.end(), leads_to)) return;
  if (place.has_heading && std::any_of(place.entering.begin(), place.entering.end(), comes_from)) return;

  if (place.has_heading) {
    join_steered(id);
    return;
  }
  for (const double reach_m : kStraightReachM)
    if (join_straight(id, reach_m)) return;
  if (!join_by_search(id)) join_out_of_keep_out(id);
}

bool Roadmap::join_straight(PlaceId id, double reach_m) {
  const KindId kind = places_[id]->kind;
  const Net& net = nets_[kind];
  const Point2 at = places_[id]->base_in_map.position();
  std::vector<PlaceId> near;

  net.places.visit(grown({at, at}, reach_m), [&](PlaceId other) {
    const Point2 there = places_[other]->base_in_map.position();
    if (distance(at, there) <= reach_m && is_straight_way_free(*clearance_, at, there, net.spec.need_m))
      near.push_back(other);
  });
  std::sort(near.begin(), near.end());
  for (const PlaceId other : near) add_both_ways(kind, id, other, {at, places_[other]->base_in_map.position()}, true);

  settle_temporary(id);
  return !near.empty();
}

/// How: the floor around is flooded from all places near; the way back from the nearest cell in straight reach leads to
/// the place that flooded it.
bool Roadmap::join_by_search(PlaceId id) {
  const KindId kind = places_[id]->kind;
  const Net& net = nets_[kind];
  const Point2 at = places_[id]->base_in_map.position();
  const Box window = grown({at, at}, kSearchM);

  std::vector<PlaceId> near;
  net.places.visit(window, [&](PlaceId other) { near.push_back(other); });
  std::sort(near.begin(), near.end());

  Flood flood(*clearance_, net.spec.need_m, window);
  for (std::size_t i = 0; i < near.size(); ++i)
    flood.seed(places_[near[i]]->base_in_map.position(), static_cast<std::uint32_t>(i));
  flood.run();

  const grid::Geometry& geometry = clearance_->geometry();
  const grid::Cell middle = geometry.cell_at(at);
  const int range = static_cast<int>(std::ceil(1.5 / geometry.resolution_m));
  std::pair<double, grid::Cell> best{2.0 * kSearchM, middle};
  for (int dy = -range; dy <= range; ++dy) {
    for (int dx = -range; dx <= range; ++dx) {
      const grid::Cell cell{middle.x + dx, middle.y + dy};
      if (flood.label(cell) == Flood::kDry) continue;

      const Point2 centre = geometry.center_in_map(cell);
      const double length_m = distance(at, centre) + flood.length_m(cell);
      if (length_m < best.first && is_straight_way_free(*clearance_, at, centre, net.spec.need_m))
        best = {length_m, cell};
    }
  }
  if (flood.label(best.second) == Flood::kDry || best.first >= 2.0 * kSearchM) return false;

  std::vector<Point2> path{at};
  const auto way = pulled_tight(*clearance_, net.spec.need_m, flood.way_from(best.second));
  path.insert(path.end(), way.begin(), way.end());
  add_both_ways(kind, id, near[flood.label(best.second)], path, true);
  settle_temporary(id);
  return true;
}

/// A temporary place lies in the corridor in which all its neighbours lie; one may rest there when one may at the
/// nearest of them.
void Roadmap::settle_temporary(PlaceId id) {
  Place& place = *places_[id];
  double nearest_m = 2.0 * kSearchM;
  bool is_first = true;

  for (const MotionId motion : place.leaving) {
    const Place& next = *places_[motions_[motion]->to];
    if (next.is_temporary) continue;

    place.corridor = is_first || place.corridor == next.corridor ? next.corridor : kNoId;
    is_first = false;
    if (motions_[motion]->length_m >= nearest_m) continue;
    nearest_m = motions_[motion]->length_m;
    place.may_rest = next.may_rest;
  }
}

MotionId Roadmap::motion_along(const Motion& wanted) const {
  const auto same_point = [](Point2 a, Point2 b) { return distance(a, b) <= kSamePlaceM; };
  const auto same_heading = [](double a, double b) { return std::abs(geometry::wrap(a - b)) <= kSamePlaceM; };

  for (const MotionId id : places_[wanted.from]->leaving) {
    const Motion& known = *motions_[id];
    if (known.to == wanted.to && motion_closed_by_[id] < kForGood &&
        std::equal(known.path_in_map.begin(), known.path_in_map.end(), wanted.path_in_map.begin(),
                   wanted.path_in_map.end(), same_point) &&
        std::equal(known.headings_rad.begin(), known.headings_rad.end(), wanted.headings_rad.begin(),
                   wanted.headings_rad.end(), same_heading))
      return id;
  }

  return kNoId;
}

MotionId Roadmap::temporary_motion(PlaceId from, PlaceId to, std::vector<geometry::Point2> path_in_map,
                                   std::vector<double> headings_rad) {
  if (from >= places_.size() || to >= places_.size() || !places_[from] || !places_[to]) return kNoId;

  // A place that stood within 1 cm already may be an end: the motion's floor must hold that of its places.
  if (path_in_map.size() > 1) {
    path_in_map.front() = places_[from]->base_in_map.position();
    path_in_map.back() = places_[to]->base_in_map.position();
  }

  Motion there;
  there.from = from;
  there.to = to;
  there.kind = places_[from]->kind;
  there.path_in_map = std::move(path_in_map);
  there.headings_rad = std::move(headings_rad);
  there.is_temporary = true;
  const MotionId known = motion_along(there);
  if (known != kNoId) return known;

  const MotionId id = add_motion(std::move(there));
  if (!nets_[motions_[id]->kind].kind.turns_on_the_spot()) return id;

  Motion back;
  back.from = to;
  back.to = from;
  back.kind = motions_[id]->kind;
  back.path_in_map.assign(motions_[id]->path_in_map.rbegin(), motions_[id]->path_in_map.rend());
  back.is_temporary = true;
  back.shape = motions_[id]->shape;
  add_motion(std::move(back));

  return id;
}

Roadmap::Ended Roadmap::sweep(const std::vector<PlaceId>& places_in_use, const std::vector<MotionId>& motions_in_use) {
  std::set<PlaceId> kept(places_in_use.begin(), places_in_use.end());
  std::set<MotionId> kept_motions(motions_in_use.begin(), motions_in_use.end());
  for (const MotionId id : motions_in_use) {
    kept.insert(motion(id).from);
    kept.insert(motion(id).to);
    for (const MotionId back : place(motion(id).to).leaving)
      if (motions_[back]->to == motion(id).from) kept_motions.insert(back);
  }

  // A way between a temporary place in use and one of the others, and what is in use itself, stays.
  const auto is_kept = [&](PlaceId id) { return !places_[id]->is_temporary || kept.count(id) > 0; };
  const auto motion_ends = [&](MotionId id) {
    if (!motions_[id]) return true;

    const Place& from = *places_[motions_[id]->from];
    const Place& to = *places_[motions_[id]->to];
    const bool is_join =
        from.is_temporary != to.is_temporary && is_kept(motions_[id]->from) && is_kept(motions_[id]->to);
    if (is_join || kept_motions.count(id) > 0) return false;

    end_motion(id);
    return true;
  };
  const auto place_ends = [&](PlaceId id) {
    if (places_[id] && kept.count(id) > 0) return false;
    end_place(id);
    return true;
  };

  temporary_motions_.erase(std::remove_if(temporary_motions_.begin(), temporary_motions_.end(), motion_ends),
                           temporary_motions_.end());
  temporary_places_.erase(std::remove_if(temporary_places_.begin(), temporary_places_.end(), place_ends),
                          temporary_places_.end());
  for (const PlaceId id : temporary_places_) join_temporary(id);

  for (auto table = seconds_to_.begin(); table != seconds_to_.end();)
    table = kept.count(table->first) > 0 ? std::next(table) : seconds_to_.erase(table);

  free_ended();
  return told_.back();
}

/// What ended is named by no closure any more. What an old sweep told of is free from now on: nobody
/// names it any more, whatever was late.
void Roadmap::free_ended() {
  const auto place_ended = [&](PlaceId id) { return !places_[id]; };
  const auto motion_ended = [&](MotionId id) { return !motions_[id]; };
  const auto drop = [](auto& ids, const auto& ended) {
    ids.erase(std::remove_if(ids.begin(), ids.end(), ended), ids.end());
  };
  for (auto& closure : closures_) {
    for (Ids* ids : {&closure.second.closed, &closure.second.made}) {
      drop(ids->places, place_ended);
      drop(ids->motions, motion_ended);
    }
  }

  told_.push_back(std::exchange(ended_, {}));
  if (told_.size() <= kSweepsKept) return;

  const Ended& oldest = told_.front();
  free_.places.insert(free_.places.end(), oldest.places.begin(), oldest.places.end());
  free_.motions.insert(free_.motions.end(), oldest.motions.begin(), oldest.motions.end());
  told_.pop_front();
}

}  // namespace aisle::global_planner::traffic
