// Zones of the map in the roadmap: what changes with them, and the ways through those where nobody may stop.
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <queue>
#include <set>
#include <utility>

#include "services/global-planner/core/traffic/flood.hpp"
#include "services/global-planner/core/traffic/roadmap.hpp"

namespace aisle::global_planner::traffic {
namespace {

using fleet::Zone;
using geometry::Point2;

constexpr double kWayRound = 1.45;       // times the length through the zone: as good as a way through it
constexpr double kStraightM = 0.01;      // beside the line of the heading, and
constexpr double kStraightRad = 0.01;    // turned from it
constexpr double kLongestWayOutM = 8.0;  // straight out of a keep-out zone
constexpr std::size_t kMostWaysOut = 4;  // the nearest ones
constexpr double kNoWay = std::numeric_limits<double>::infinity();

using Entry = std::pair<double, PlaceId>;  // metres so far
using Nearest = std::priority_queue<Entry, std::vector<Entry>, std::greater<>>;

/// Does the zone change places or motions? Keep-out zones are occupied floor; parking is only looked at.
bool has_floor_rules(const Zone& zone) {
  return zone.kind != Zone::Kind::kKeepOut && zone.kind != Zone::Kind::kParking;
}

/// Those of `some` that are not among `others`.
std::vector<Zone> without(const std::vector<Zone>& some, const std::vector<Zone>& others) {
  std::vector<Zone> out;
  for (const Zone& zone : some)
    if (std::find(others.begin(), others.end(), zone) == others.end()) out.push_back(zone);
  return out;
}

bool is_straight_ahead(const geometry::Pose2& from, const geometry::Pose2& to) {
  const Point2 ahead = geometry::from_map(from, to.position());
  return ahead.x > 0.0 && std::abs(ahead.y) < kStraightM && std::abs(geometry::wrap(to.yaw - from.yaw)) < kStraightRad;
}

/// May a disc be driven straight there by the map?
///
/// How: all cells whose centres come nearer than the disc's radius and half a cell's diagonal are looked at.
bool is_swept_floor_free(const grid::OccupancyGrid& map, Point2 from, Point2 to, double radius_m) {
  const grid::Geometry& geometry = map.geometry();
  const double reach_m = radius_m + 0.7072 * geometry.resolution_m;
  const Point2 low{std::min(from.x, to.x) - reach_m, std::min(from.y, to.y) - reach_m};
  const Point2 high{std::max(from.x, to.x) + reach_m, std::max(from.y, to.y) + reach_m};

  for (int y = geometry.cell_at(low).y; y <= geometry.cell_at(high).y; ++y) {
    for (int x = geometry.cell_at(low).x; x <= geometry.cell_at(high).x; ++x) {
      const grid::Cell cell{x, y};
      const bool is_free = geometry.contains(cell) && map.is_free(cell);
      if (!is_free && geometry::distance_to_segment(geometry.center_in_map(cell), from, to) < reach_m) return false;
    }
  }

  return true;
}

}  // namespace

void Roadmap::set_zones(const std::vector<Zone>& zones) {
  const std::vector<Zone> before = zones_.zones();
  if (zones == before) return;

  zones_ = ZoneRules(zones);
  for (const std::vector<Zone>& changed : {without(before, zones), without(zones, before)})
    for (const Zone& zone : changed)
      if (has_floor_rules(zone) && clearance_ != nullptr) make_anew_in(zone);
}

/// Places and motions in the zone are taken away, as by an edit that closes its floor, and made again with the rules
/// that hold now.
void Roadmap::make_anew_in(const Zone& zone) {
  const Box box = box_around(zone);
  std::vector<PlaceId> places;
  std::vector<MotionId> motions;
  place_shapes_.visit(box, [&](PlaceId id) {
    if (meets(zone, places_[id]->standing)) places.push_back(id);
  });
  motion_shapes_.visit(box, [&](MotionId id) {
    if (meets(zone, motions_[id]->shape)) motions.push_back(id);
  });
  for (const PlaceId id : places) take_away(id);
  for (const MotionId id : motions) take_away_motion(id);

  for (KindId kind = 0; kind < nets_.size(); ++kind) make_near(kind, box);
}

/// How: from each place beside such a zone over the places inside, by the shortest way, to each place on other sides.
/// Those that lead not much farther than a way round, or than two others together, are left out.
void Roadmap::make_ways_through(KindId kind, const Box& region) {
  const Net& net = nets_[kind];
  const Box around = grown(region, net.spec.pitch_m);
  const auto is_passed_near = [&](const Zone& zone) {
    return zone.kind == Zone::Kind::kNoStopping && touch(box_around(zone), around);
  };

  const std::vector<Zone>& zones = zones_.zones();
  const bool had_some = std::any_of(motions_.begin(), motions_.end(), [&](const auto& motion) {
    return motion && motion->is_through && motion->kind == kind && !motion->is_temporary &&
           touch(motion->shape.box(), around);
  });
  if (!had_some && std::none_of(zones.begin(), zones.end(), is_passed_near)) return;

  std::set<PlaceId> entrances;
  for (MotionId id = 0; id < motions_.size(); ++id) {
    if (!motions_[id] || motions_[id]->kind != kind || motions_[id]->is_temporary) continue;

    const Motion& motion = *motions_[id];
    if (motion.is_through) retire_motion(id);
    if (!motion.is_through && places_[motion.to]->is_pass_only && !places_[motion.from]->is_pass_only)
      entrances.insert(motion.from);
  }

  std::vector<Motion> ways;
  std::vector<std::pair<double, std::size_t>> order;  // metres
  for (const PlaceId entrance : entrances)
    for (Motion& way : ways_through_from(entrance)) ways.push_back(std::move(way));
  for (std::size_t i = 0; i < ways.size(); ++i) order.emplace_back(ways[i].length_m, i);
  std::sort(order.begin(), order.end());

  for (const auto& [length_m, i] : order)
    if (!has_way_round(ways[i].from, ways[i].to, kWayRound * length_m)) add_motion(std::move(ways[i]));
}

/// One to each place beside the zone. A vehicle that does not turn on the spot passes straight.
std::vector<Motion> Roadmap::ways_through_from(PlaceId entrance) const {
  const Net& net = nets_[places_[entrance]->kind];
  const bool turns = net.kind.turns_on_the_spot();
  std::map<PlaceId, double> reached{{entrance, 0.0}};
  std::map<PlaceId, MotionId> by;
  Nearest open;
  open.push({0.0, entrance});

  while (!open.empty()) {
    const auto [so_far_m, at] = open.top();
    open.pop();
    if (so_far_m > reached[at] || (at != entrance && !places_[at]->is_pass_only)) continue;

    for (const MotionId id : places_[at]->leaving) {
      const Motion& motion = *motions_[id];
      const Place& to = *places_[motion.to];
      const bool begins = at == entrance;
      if (motion.is_temporary || motion.is_through || motion.is_reverse || (begins && !to.is_pass_only)) continue;
      if (zones_.forbid_way(motion.path_in_map)) continue;
      if (!turns && !is_straight_ahead(places_[at]->base_in_map, to.base_in_map)) continue;

      const double length_m = so_far_m + motion.length_m;
      const auto known = reached.try_emplace(motion.to, kNoWay).first;
      if (length_m >= known->second) continue;

      known->second = length_m;
      by[motion.to] = id;
      open.push({length_m, motion.to});
    }
  }

  std::vector<Motion> out;
  for (const auto& [exit, length_m] : reached) {
    if (exit == entrance || places_[exit]->is_pass_only) continue;

    std::vector<MotionId> steps;
    for (PlaceId at = exit; at != entrance; at = motions_[by[at]]->from) steps.push_back(by[at]);
    std::reverse(steps.begin(), steps.end());

    Motion way;
    way.from = entrance;
    way.to = exit;
    way.kind = places_[entrance]->kind;
    way.length_m = length_m;
    way.is_through = true;
    for (const MotionId id : steps) {
      const Motion& step = *motions_[id];
      const auto skipped = way.path_in_map.empty() ? 0 : 1;  // it begins where the last one ended
      way.path_in_map.insert(way.path_in_map.end(), step.path_in_map.begin() + skipped, step.path_in_map.end());
      if (!step.headings_rad.empty())
        way.headings_rad.insert(way.headings_rad.end(), step.headings_rad.begin() + skipped, step.headings_rad.end());
    }

    if (turns) way.path_in_map = pulled_tight(*clearance_, net.spec.need_m, way.path_in_map);
    out.push_back(std::move(way));
  }

  return out;
}

/// By motions that pass over no such zone, or lead through it as a whole.
bool Roadmap::has_way_round(PlaceId from, PlaceId to, double most_m) const {
  std::map<PlaceId, double> reached{{from, 0.0}};
  Nearest open;
  open.push({0.0, from});

  while (!open.empty()) {
    const auto [so_far_m, at] = open.top();
    open.pop();
    if (at == to) return true;
    if (so_far_m > reached[at]) continue;

    for (const MotionId id : places_[at]->leaving) {
      const Motion& motion = *motions_[id];
      if (motion.is_temporary || motion.is_closed || motion.is_reverse || places_[motion.to]->is_pass_only) continue;

      const double length_m = so_far_m + motion.length_m;
      const double least_m = distance(places_[motion.to]->base_in_map.position(), places_[to]->base_in_map.position());
      const auto known = reached.try_emplace(motion.to, kNoWay).first;
      if (length_m + least_m > most_m || length_m >= known->second) continue;

      known->second = length_m;
      open.push({length_m, motion.to});
    }
  }

  return false;
}

/// Straight, by the map itself, to the nearest places outside; no way leads in. Of kinds that turn on the spot.
bool Roadmap::join_out_of_keep_out(PlaceId id) {
  const Place& place = *places_[id];
  const Point2 at = place.base_in_map.position();
  if (bare_map_ == nullptr || place.has_heading || clearance_->clearance_m(at) > 0.0) return false;

  const Net& net = nets_[place.kind];
  std::vector<Entry> near;
  net.places.visit(grown({at, at}, kLongestWayOutM), [&](PlaceId other) {
    if (!places_[other]->is_closed) near.emplace_back(distance(at, places_[other]->base_in_map.position()), other);
  });
  std::sort(near.begin(), near.end());

  std::size_t ways = 0;
  for (const auto& [length_m, other] : near) {
    const Point2 there = places_[other]->base_in_map.position();
    if (!is_swept_floor_free(*bare_map_, at, there, geometry::reach_m(net.kind.footprint))) continue;

    Motion way;
    way.from = id;
    way.to = other;
    way.kind = place.kind;
    way.path_in_map = {at, there};
    way.is_temporary = true;
    add_motion(std::move(way));
    if (++ways == kMostWaysOut) break;
  }

  settle_temporary(id);
  return ways > 0;
}

}  // namespace aisle::global_planner::traffic
