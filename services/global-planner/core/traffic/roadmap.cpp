#include "services/global-planner/core/traffic/roadmap.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace aisle::global_planner::traffic {
namespace {

using geometry::Point2;

double length_of_m(const std::vector<Point2>& path) {
  double sum_m = 0.0;
  for (std::size_t i = 1; i < path.size(); ++i) sum_m += distance(path[i - 1], path[i]);
  return sum_m;
}

/// The heading between two points of a path, the first or last that differ.
double heading_of_leg(const std::vector<Point2>& path, bool is_first) {
  const std::size_t last = path.size() - 1;
  for (std::size_t i = 0; i < last; ++i) {
    const std::size_t leg = is_first ? i : last - 1 - i;
    if (path[leg] != path[leg + 1]) return geometry::bearing(path[leg], path[leg + 1]);
  }
  return 0.0;
}

/// A free id, else a new one. @param free ids that may be used again
template <class Thing>
std::uint32_t new_id(std::vector<std::unique_ptr<Thing>>& all, std::vector<std::uint16_t>& closed_by,
                     std::vector<std::uint32_t>& free) {
  if (!free.empty()) {
    const std::uint32_t id = free.back();
    free.pop_back();
    closed_by[id] = 0;
    return id;
  }

  all.emplace_back();
  closed_by.push_back(0);
  return static_cast<std::uint32_t>(all.size() - 1);
}

void erase_id(std::vector<MotionId>& ids, MotionId id) {
  ids.erase(std::remove(ids.begin(), ids.end(), id), ids.end());
}

constexpr double kBackMps = 0.3;  // at most, backwards

/// Edge of a lattice square: two vehicles may stand in neighbouring ones.
LatticeSpec spec_for(const Kind& kind, double gap_m) {
  constexpr double kLeastPitchM = 1.0;
  const double reach_m = geometry::reach_m(kind.footprint);
  return {reach_m + kind.wall_margin_m, std::max(kLeastPitchM, 2.0 * (reach_m + kind.tube_m) + gap_m), {}};
}

}  // namespace

Roadmap::Roadmap(double gap_m) : gap_m_(gap_m) {}

KindId Roadmap::kind(const Kind& kind) {
  for (KindId id = 0; id < nets_.size(); ++id)
    if (nets_[id].kind == kind) return id;

  const auto id = static_cast<KindId>(nets_.size());
  nets_.push_back({kind, spec_for(kind, gap_m_), {}, {}});
  if (clearance_ != nullptr) {
    nets_[id].spec.origin_in_map = geometry_.origin_in_map;
    make_near(id, floor_box(*clearance_));
  }

  return id;
}

const Kind& Roadmap::kind(KindId id) const { return nets_.at(id).kind; }

const Place& Roadmap::place(PlaceId id) const {
  static const Place ended = [] {
    Place place;
    place.may_rest = false;
    place.is_closed = true;
    return place;
  }();
  return id < places_.size() && places_[id] ? *places_[id] : ended;
}

const Motion& Roadmap::motion(MotionId id) const {
  static const Motion ended = [] {
    Motion motion;
    motion.is_closed = true;
    return motion;
  }();
  return id < motions_.size() && motions_[id] ? *motions_[id] : ended;
}

PlaceId Roadmap::add_place(KindId kind, const geometry::Pose2& base_in_map, bool has_heading, bool is_temporary) {
  const PlaceId id = new_id(places_, place_closed_by_, free_.places);
  auto place = std::make_unique<Place>();
  place->base_in_map = base_in_map;
  place->kind = kind;
  place->has_heading = has_heading;
  place->is_temporary = is_temporary;
  place->standing = zones_.held(standing_shape(nets_[kind].kind, base_in_map));
  place->is_pass_only = place->is_closed = zones_.forbid_stopping(place->standing);
  place->is_kept_clear = zones_.forbid_resting(place->standing);
  place->may_rest = !place->is_kept_clear;
  place_closed_by_[id] = place->is_closed ? 1 : 0;

  const Point2 at = base_in_map.position();
  if (!is_temporary) nets_[kind].places.add({at, at}, id);
  if (is_temporary) temporary_places_.push_back(id);
  place_shapes_.add(place->standing.box(), id);
  places_[id] = std::move(place);

  for (auto& closure : closures_) close_place(id, closure.second);
  return id;
}

MotionId Roadmap::add_motion(Motion motion) {
  const MotionId id = new_id(motions_, motion_closed_by_, free_.motions);
  const Kind& kind = nets_[motion.kind].kind;

  motion.length_m = length_of_m(motion.path_in_map);
  motion.speed_mps = motion.is_reverse ? std::min(kBackMps, kind.limits.max_reverse_mps) : kind.limits.max_speed_mps;
  if (motion.headings_rad.empty()) {
    motion.entry_rad = heading_of_leg(motion.path_in_map, true);
    motion.exit_rad = heading_of_leg(motion.path_in_map, false);
  } else {
    motion.entry_rad = motion.headings_rad.front();
    motion.exit_rad = motion.headings_rad.back();
  }
  if (motion.shape.empty()) motion.shape = swept_shape(kind, motion.path_in_map, motion.headings_rad);
  motion.speed_mps = zones_.speed_mps(motion.shape, motion.speed_mps);
  motion.shape = zones_.held(std::move(motion.shape));
  motion.is_closed = motion.is_blocked = zones_.forbid_way(motion.path_in_map);
  motion_closed_by_[id] = motion.is_closed ? 1 : 0;

  places_[motion.from]->leaving.push_back(id);
  places_[motion.to]->entering.push_back(id);
  if (motion.is_temporary) temporary_motions_.push_back(id);
  motion_shapes_.add(motion.shape.box(), id);
  motions_[id] = std::make_unique<Motion>(std::move(motion));

  for (auto& closure : closures_) close_motion(id, closure.second);
  return id;
}

std::pair<MotionId, MotionId> Roadmap::add_both_ways(KindId kind, PlaceId a, PlaceId b,
                                                     const std::vector<geometry::Point2>& path_in_map,
                                                     bool is_temporary) {
  Motion there;
  there.from = a;
  there.to = b;
  there.kind = kind;
  there.path_in_map = path_in_map;
  there.is_temporary = is_temporary;
  there.shape = swept_shape(nets_[kind].kind, path_in_map);

  Motion back = there;
  std::swap(back.from, back.to);
  std::reverse(back.path_in_map.begin(), back.path_in_map.end());

  const MotionId first = add_motion(std::move(there));
  const MotionId second = add_motion(std::move(back));
  return {first, second};
}

void Roadmap::end_motion(MotionId id) {
  if (!motions_[id]) return;

  const Motion& motion = *motions_[id];
  if (places_[motion.from]) erase_id(places_[motion.from]->leaving, id);
  if (places_[motion.to]) erase_id(places_[motion.to]->entering, id);
  motion_shapes_.remove(motion.shape.box(), id);
  motions_[id].reset();
  ended_.motions.push_back(id);
}

void Roadmap::end_place(PlaceId id) {
  if (!places_[id]) return;

  const auto leaving = places_[id]->leaving;
  const auto entering = places_[id]->entering;
  for (const MotionId motion : leaving) end_motion(motion);
  for (const MotionId motion : entering) end_motion(motion);
  place_shapes_.remove(places_[id]->standing.box(), id);
  places_[id].reset();
  ended_.places.push_back(id);
}

bool Roadmap::is_joined(PlaceId a, PlaceId b) const {
  const auto& leaving = places_[a]->leaving;
  return std::any_of(leaving.begin(), leaving.end(), [&](MotionId m) { return motions_[m]->to == b; });
}

double run_s(const Kind&, const Motion& motion, double heading_before_rad, bool from_standing) {
  constexpr double kShareOfTopSpeed = 0.9;
  constexpr double kStartS = 0.5;
  constexpr double kRightAngleS = 1.0;
  const auto turn_s = [](double turn_rad) {
    return kRightAngleS * std::abs(geometry::wrap(turn_rad)) / (0.5 * geometry::kPi);
  };

  double sum_s = motion.length_m / (kShareOfTopSpeed * std::max(0.01, motion.speed_mps));
  if (from_standing) sum_s += kStartS;
  if (!motion.headings_rad.empty()) return sum_s;

  sum_s += turn_s(motion.entry_rad - heading_before_rad);
  for (std::size_t i = 2; i < motion.path_in_map.size(); ++i) {
    const double before_rad = geometry::bearing(motion.path_in_map[i - 2], motion.path_in_map[i - 1]);
    sum_s += turn_s(geometry::bearing(motion.path_in_map[i - 1], motion.path_in_map[i]) - before_rad);
  }

  return sum_s;
}

}  // namespace aisle::global_planner::traffic
