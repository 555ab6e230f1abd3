// Makes the roadmap's places and motions from the map, and again near an edit.
#include <algorithm>
#include <utility>

#include "services/global-planner/core/traffic/corridors.hpp"
#include "services/global-planner/core/traffic/joins.hpp"
#include "services/global-planner/core/traffic/pose_lattice.hpp"
#include "services/global-planner/core/traffic/roadmap.hpp"
#include "services/global-planner/core/traffic/straight_way.hpp"

namespace aisle::global_planner::traffic {
namespace {

using geometry::Point2;

constexpr double kWindow = 4.0;  // pitches around an edit within which the floor is flooded

bool is_path_free(const grid::ClearanceField& clearance, const std::vector<Point2>& path, double need_m) {
  for (std::size_t i = 1; i < path.size(); ++i)
    if (!is_straight_way_free(clearance, path[i - 1], path[i], need_m)) return false;
  return true;
}

}  // namespace

void Roadmap::set_map(const grid::ClearanceField& clearance, grid::Cell low, grid::Cell high) {
  const bool is_new = clearance_ == nullptr || geometry_ != clearance.geometry();
  clearance_ = &clearance;
  geometry_ = clearance.geometry();
  if (!is_new && (high.x < low.x || high.y < low.y)) return;

  Box changed{geometry_.center_in_map(low), geometry_.center_in_map(high)};
  changed = grown(changed, 0.5 * geometry_.resolution_m);
  if (is_new) {
    changed = floor_box(clearance);
    for (Net& net : nets_) net.spec.origin_in_map = geometry_.origin_in_map;
    for (PlaceId id = 0; id < places_.size(); ++id)
      if (places_[id]) take_away(id);
  }

  for (KindId kind = 0; kind < nets_.size(); ++kind) make_near(kind, changed);
}

void Roadmap::make_near(KindId kind, const Box& changed) {
  const LatticeSpec& spec = nets_[kind].spec;
  const Box region = grown(changed, spec.need_m + spec.pitch_m);
  const Box window = grown(region, kWindow * spec.pitch_m);

  if (!nets_[kind].kind.turns_on_the_spot()) {
    take_away_blocked(kind, region);
    make_steered_places(kind, region);
    make_ways_through(kind, region);
    ++revision_;
    seconds_to_.clear();
    return;
  }

  take_away_blocked(kind, region);
  make_turning_places(kind, {*clearance_, region, window, true});
  for (auto& closure : closures_)
    if (touch(closure.second.shape.box(), region)) make_room(closure.second);
  make_ways_through(kind, region);
  find_corridors(kind);

  ++revision_;
  seconds_to_.clear();
}

/// The place ends when it is left.
void Roadmap::retire(PlaceId id) {
  Place& place = *places_[id];
  if (place.is_temporary) return;

  const Point2 at = place.base_in_map.position();
  nets_[place.kind].places.remove({at, at}, id);
  if (place.has_heading) forget_pose(id);
  place.is_temporary = true;
  temporary_places_.push_back(id);
  for (const MotionId motion : place.entering) retire_motion(motion);
  for (const MotionId motion : place.leaving) retire_motion(motion);
}

void Roadmap::retire_motion(MotionId id) {
  if (motions_[id]->is_temporary) return;

  motions_[id]->is_temporary = true;
  temporary_motions_.push_back(id);
}

/// Besides, nobody may enter it any more, for good.
void Roadmap::take_away(PlaceId id) {
  retire(id);
  place_closed_by_[id] = std::max(place_closed_by_[id], kForGood);
  places_[id]->is_closed = true;
  for (const MotionId motion : places_[id]->entering) take_away_motion(motion);
  for (const MotionId motion : places_[id]->leaving) take_away_motion(motion);
}

void Roadmap::take_away_motion(MotionId id) {
  retire_motion(id);
  motion_closed_by_[id] = std::max(motion_closed_by_[id], kForGood);
  motions_[id]->is_closed = true;
}

void Roadmap::take_away_blocked(KindId kind, const Box& region) {
  const Net& net = nets_[kind];
  const double bare_m = net.spec.need_m - 0.5 * net.kind.wall_margin_m;  // own ways are not held to the whole margin

  std::vector<PlaceId> places;
  net.places.visit(region, [&](PlaceId id) {
    const Place& place = *places_[id];
    const bool is_free = place.has_heading ? is_floor_free(*clearance_, net.kind, place.standing)
                                           : clearance_->clearance_m(place.base_in_map.position()) >= net.spec.need_m;
    if (!is_free) places.push_back(id);
  });
  for (const PlaceId id : places) take_away(id);

  std::vector<MotionId> motions;
  motion_shapes_.visit(region, [&](MotionId id) {
    const Motion& motion = *motions_[id];
    if (motion.kind != kind) return;

    const bool is_free = net.kind.turns_on_the_spot() ? is_path_free(*clearance_, motion.path_in_map,
                                                                     motion.is_temporary ? bare_m : net.spec.need_m)
                                                      : is_floor_free(*clearance_, net.kind, motion.shape);
    if (!is_free) motions.push_back(id);
  });
  for (const MotionId id : motions) take_away_motion(id);
}

Roadmap::Ids Roadmap::make_turning_places(KindId kind, const Work& work) {
  const LatticeSpec spec = nets_[kind].spec;
  const auto counts = [&](bool is_closed) { return work.with_closed || !is_closed; };
  Ids made;

  std::vector<PlaceId> ids;
  std::vector<Point2> points;
  nets_[kind].places.visit(work.window, [&](PlaceId id) {
    if (counts(places_[id]->is_closed)) ids.push_back(id);
  });
  std::sort(ids.begin(), ids.end());
  for (const PlaceId id : ids) points.push_back(places_[id]->base_in_map.position());

  const auto add_place_at = [&](Point2 at) {
    ids.push_back(add_place(kind, {at.x, at.y, 0.0}, false, false));
    points.push_back(at);
    made.places.push_back(ids.back());
  };
  const auto add_join = [&](const Join& join, const std::vector<Point2>& path) {
    const auto both = add_both_ways(kind, ids[join.first], ids[join.second], path, false);
    made.motions.insert(made.motions.end(), {both.first, both.second});
  };
  for (const Point2 at : lattice_points(work.clearance, spec, work.region, points)) add_place_at(at);

  std::vector<std::size_t> index_of(places_.size(), ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) index_of[ids[i]] = i;
  std::vector<Join> joins;
  for (std::size_t i = 0; i < ids.size(); ++i) {
    for (const MotionId id : places_[ids[i]]->leaving) {
      const Motion& motion = *motions_[id];
      const std::size_t next = index_of[motion.to];
      if (!motion.is_temporary && counts(motion.is_closed) && next < ids.size() && next > i)
        joins.emplace_back(i, next);
    }
  }

  for (const Join& join : join_neighbours(work.clearance, spec, points, joins, work.region)) {
    add_join(join, {points[join.first], points[join.second]});
    joins.push_back(join);
  }

  // Parts of the whole net: two places may hang together by ways outside the window.
  JoinedSets sets(places_.size());
  for (const auto& motion : motions_)
    if (motion && motion->kind == kind && !motion->is_temporary && counts(motion->is_closed))
      sets.join(motion->from, motion->to);
  std::vector<std::size_t> part;
  for (const PlaceId id : ids) part.push_back(sets.of(id));

  const Bridging bridging = bridge_parts(work.clearance, spec.need_m, points, part, joins, work.window, work.region);
  for (const Bridge& bridge : bridging.bridges) add_join(bridge.join, bridge.way_in_map);
  for (const Point2 at : bridging.islands) add_place_at(at);

  return made;
}

/// Is it a dead end of one place beside a way that goes on? A vehicle that stands in it is in no other's way.
bool Roadmap::is_spur(PlaceId id) const {
  PlaceId only = kNoId;
  for (const MotionId m : places_[id]->leaving) {
    if (motions_[m]->is_temporary || motions_[m]->is_closed || places_[motions_[m]->to]->is_pass_only) continue;
    if (only != kNoId) return false;
    only = motions_[m]->to;
  }
  if (only == kNoId) return false;

  int others = 0;
  for (const MotionId m : places_[only]->leaving) {
    const Motion& motion = *motions_[m];
    if (motion.is_temporary || motion.is_closed || motion.to == id || places_[motion.to]->is_pass_only) continue;
    if (meet(motion.shape, places_[id]->standing, gap_m_)) return false;
    ++others;
  }
  return others >= 2;
}

void Roadmap::find_corridors(KindId kind) {
  if (!nets_[kind].kind.turns_on_the_spot()) return;  // poses at 0.5 m have ways round everywhere

  std::vector<PlaceId> ids;
  std::vector<std::uint32_t> index_of(places_.size(), kNoId);
  for (PlaceId id = 0; id < places_.size(); ++id) {
    if (!places_[id] || places_[id]->kind != kind || places_[id]->is_temporary) continue;
    if (places_[id]->is_pass_only) continue;  // the motions through its zone count
    index_of[id] = static_cast<std::uint32_t>(ids.size());
    ids.push_back(id);
  }

  std::vector<std::vector<std::uint32_t>> neighbours(ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const auto add = [&](const Motion& motion, PlaceId other) {
      const bool is_open = !motion.is_temporary && !motion.is_closed && index_of[other] != kNoId;
      if (is_open) neighbours[i].push_back(index_of[other]);
    };
    for (const MotionId motion : places_[ids[i]]->leaving) add(*motions_[motion], motions_[motion]->to);
    for (const MotionId motion : places_[ids[i]]->entering) add(*motions_[motion], motions_[motion]->from);
    std::sort(neighbours[i].begin(), neighbours[i].end());
    neighbours[i].erase(std::unique(neighbours[i].begin(), neighbours[i].end()), neighbours[i].end());
  }

  const Cuts cuts = find_cuts(neighbours);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    places_[ids[i]]->corridor = is_spur(ids[i]) ? kNoId : cuts.corridor[i];
    places_[ids[i]]->may_rest = !cuts.is_cut[i] && !places_[ids[i]]->is_closed && !places_[ids[i]]->is_kept_clear;
  }
  for (const PlaceId id : temporary_places_)
    if (places_[id] && places_[id]->kind == kind) settle_temporary(id);
}

}  // namespace aisle::global_planner::traffic
