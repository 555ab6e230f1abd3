// Places and motions of kinds that do not turn on the spot: poses of a lattice, and ways by Dubins to and from others.
#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>

#include "services/global-planner/core/dubins.hpp"
#include "services/global-planner/core/traffic/pose_lattice.hpp"
#include "services/global-planner/core/traffic/roadmap.hpp"

namespace aisle::global_planner::traffic {
namespace {

using geometry::Point2;
using geometry::Pose2;

constexpr std::size_t kLeastPart = 20;  // poses; smaller parts are of no use
constexpr double kJoinReachM = 4.0;     // from a temporary place to poses of the lattice
constexpr double kJoinDetour = 1.5;     // times the distance, and kJoinMoreM: longer ways are none
constexpr double kJoinMoreM = 0.5;
constexpr std::size_t kMostJoins = 8;  // each way

/// A number for each pose.
std::int64_t number_of(const PoseKey& key) {
  const auto bits = [](int i) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(i)); };
  return static_cast<std::int64_t>((bits(key.x) << 34U) | ((bits(key.y) & 0xffffffffU) << 2U) | bits(key.quarter));
}

PoseKey moved(const PoseKey& from, const PoseMove& move) {
  return {from.x + move.to.x, from.y + move.to.y, move.to.quarter};
}

Pose2 pose_of(const PoseKey& key, Point2 origin_in_map) {
  return {origin_in_map.x + key.x * kPosePitchM, origin_in_map.y + key.y * kPosePitchM, heading_of(key.quarter)};
}

/// All poses whose places lie in the box.
std::vector<PoseKey> poses_in(const Box& box, Point2 origin_in_map) {
  const auto first = [](double m) { return static_cast<int>(std::ceil(m / kPosePitchM)); };
  const auto last = [](double m) { return static_cast<int>(std::floor(m / kPosePitchM)); };
  std::vector<PoseKey> out;
  for (int y = first(box.low_in_map.y - origin_in_map.y); y <= last(box.high_in_map.y - origin_in_map.y); ++y)
    for (int x = first(box.low_in_map.x - origin_in_map.x); x <= last(box.high_in_map.x - origin_in_map.x); ++x)
      for (int quarter = 0; quarter < 4; ++quarter) out.push_back({x, y, quarter});
  return out;
}

/// Points and headings along a Dubins path, dense enough on arcs for their sweep.
void sample(const DubinsPath& path, std::vector<Point2>& points, std::vector<double>& headings_rad) {
  constexpr double kPieceRad = 0.2;
  const auto add = [&](double along_m) {
    const Pose2 pose = path.pose_at(along_m);
    points.push_back(pose.position());
    headings_rad.push_back(pose.yaw);
  };

  add(0.0);
  double along_m = 0.0;
  for (const DubinsPath::Piece& piece : path.pieces) {
    if (piece.length_m < 1e-6) continue;
    const int pieces = std::max(1, static_cast<int>(std::ceil(std::abs(piece.turn) * piece.length_m / kPieceRad)));
    for (int i = 1; i <= pieces; ++i) add(along_m + piece.length_m * i / pieces);
    along_m += piece.length_m;
  }
}

using Graph = std::vector<std::vector<std::uint32_t>>;

/// The nodes that can be reached from those that are marked, themselves included.
std::vector<bool> reached(const Graph& next, std::vector<bool> marked) {
  std::vector<std::uint32_t> open;
  for (std::uint32_t i = 0; i < marked.size(); ++i)
    if (marked[i]) open.push_back(i);

  while (!open.empty()) {
    const std::uint32_t at = open.back();
    open.pop_back();
    for (const std::uint32_t to : next[at]) {
      if (marked[to]) continue;
      marked[to] = true;
      open.push_back(to);
    }
  }

  return marked;
}

/// Which poses are of use: those that stand already, those on ways from them to them, and those in a part of at least
/// kLeastPart that reach each other and in which a vehicle can turn. (A row of poses along a wall, too near to it to
/// turn, is of no use.)
std::vector<bool> useful_poses(const std::vector<PoseKey>& keys, const Graph& next, const std::vector<bool>& is_known) {
  Graph before(next.size());
  for (std::uint32_t i = 0; i < next.size(); ++i)
    for (const std::uint32_t to : next[i]) before[to].push_back(i);
  const std::vector<bool> is_after_known = reached(next, is_known);
  const std::vector<bool> is_before_known = reached(before, is_known);

  const std::vector<std::uint32_t> part = strongly_connected_parts(next);
  std::vector<std::size_t> size(keys.size() + 1, 0);
  std::vector<unsigned> quarters(keys.size() + 1, 0);
  for (std::size_t i = 0; i < keys.size(); ++i) {
    ++size[part[i]];
    quarters[part[i]] |= 1U << static_cast<unsigned>(keys[i].quarter);
  }

  std::vector<bool> out(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const unsigned headings = quarters[part[i]];
    const bool can_turn = (headings & (headings - 1U)) != 0;
    out[i] = (is_after_known[i] && is_before_known[i]) || (size[part[i]] >= kLeastPart && can_turn);
  }
  return out;
}

/// A move between two poses of the lattice, by their numbers in the list of poses.
struct Found {
  std::uint32_t from;
  std::uint32_t to;
  const PoseMove* move;
};

/// The move as a motion between two places, whose ids are the caller's to add.
Motion motion_of(const PoseMove& move, const Place& from, const Place& to) {
  const Point2 from_in_map = from.base_in_map.position();
  Motion motion;
  motion.kind = from.kind;
  for (const Point2 p : move.path) motion.path_in_map.push_back(from_in_map + p);
  motion.path_in_map.back() = to.base_in_map.position();
  motion.headings_rad = move.headings_rad;
  motion.shape = move.shape.moved(from_in_map);
  motion.is_reverse = move.is_reverse;
  return motion;
}

}  // namespace

PlaceId Roadmap::pose_id(KindId kind, std::int64_t number) const {
  const auto found = nets_[kind].poses.find(number);
  return found == nets_[kind].poses.end() ? kNoId : found->second;
}

void Roadmap::forget_pose(PlaceId id) {
  Net& net = nets_[places_[id]->kind];
  const Pose2& pose = places_[id]->base_in_map;
  const auto steps = [](double m) { return static_cast<int>(std::lround(m / kPosePitchM)); };
  const Point2 off = pose.position() - net.spec.origin_in_map;
  const int quarter = static_cast<int>(std::lround(pose.yaw / (0.5 * geometry::kPi)));
  net.poses.erase(number_of({steps(off.x), steps(off.y), (quarter + 4) % 4}));
}

/// How: of the free poses of the region, and all motions that touch it and are free, those are kept that are of use.
void Roadmap::make_steered_places(KindId kind, const Box& region) {
  Net& net = nets_[kind];
  const PoseLattice lattice(net.kind);
  const Point2 origin = net.spec.origin_in_map;

  // Poses: new ones in the region, and those that stand already in reach of it.
  std::vector<PoseKey> keys;
  std::vector<bool> is_known;  // a place already
  std::unordered_map<std::int64_t, std::uint32_t> index_of;
  for (const PoseKey& key : poses_in(grown(region, lattice.reach_m()), origin)) {
    const Pose2 pose = pose_of(key, origin);
    const bool stands = pose_id(kind, number_of(key)) != kNoId;
    const bool is_inside = touch(Box{pose.position(), pose.position()}, region);
    if (!stands && !(is_inside && is_floor_free(*clearance_, net.kind, standing_shape(net.kind, pose)))) continue;

    index_of[number_of(key)] = static_cast<std::uint32_t>(keys.size());
    keys.push_back(key);
    is_known.push_back(stands);
  }

  std::vector<Found> found;
  std::vector<std::vector<std::uint32_t>> next(keys.size());
  for (std::uint32_t i = 0; i < keys.size(); ++i) {
    const Point2 at = pose_of(keys[i], origin).position();
    for (const PoseMove& move : lattice.moves(keys[i].quarter)) {
      const auto to = index_of.find(number_of(moved(keys[i], move)));
      if (to == index_of.end()) continue;

      const Shape shape = move.shape.moved(at);
      if (!touch(shape.box(), region) || !is_floor_free(*clearance_, net.kind, shape)) continue;
      found.push_back({i, to->second, &move});
      next[i].push_back(to->second);
    }
  }

  const std::vector<bool> is_kept = useful_poses(keys, next, is_known);

  std::vector<PlaceId> ids(keys.size(), kNoId);
  for (std::uint32_t i = 0; i < keys.size(); ++i) {
    ids[i] = pose_id(kind, number_of(keys[i]));
    if (ids[i] != kNoId || !is_kept[i]) continue;
    ids[i] = add_place(kind, pose_of(keys[i], origin), true, false);
    net.poses[number_of(keys[i])] = ids[i];
  }

  for (const Found& one : found) {
    if (!is_kept[one.from] || !is_kept[one.to]) continue;
    const auto& leaving = places_[ids[one.from]]->leaving;
    const auto leads_there = [&](MotionId id) {
      return motions_[id]->to == ids[one.to] && !motions_[id]->is_temporary;
    };
    if (std::any_of(leaving.begin(), leaving.end(), leads_there)) continue;

    Motion motion = motion_of(*one.move, *places_[ids[one.from]], *places_[ids[one.to]]);
    motion.from = ids[one.from];
    motion.to = ids[one.to];
    add_motion(std::move(motion));
  }
}

/// How: the shortest ways by arcs and straights to and from the poses around, as far as they are free; where the
/// vehicle may, it also leaves backwards the way that it could have come, straight or in arcs, and slowly.
void Roadmap::join_steered(PlaceId id) {
  const KindId kind = places_[id]->kind;
  const Net& net = nets_[kind];
  const Pose2 here = places_[id]->base_in_map;

  std::vector<PlaceId> near;
  net.places.visit(grown({here.position(), here.position()}, kJoinReachM),
                   [&](PlaceId other) { near.push_back(other); });
  std::sort(near.begin(), near.end());

  for (const bool leaves : {true, false}) {
    std::vector<std::pair<double, PlaceId>> ways;
    for (const PlaceId other : near) {
      const Pose2 there = places_[other]->base_in_map;
      const DubinsPath path = leaves ? shortest_dubins(here, there, net.kind.turning_radius_m)
                                     : shortest_dubins(there, here, net.kind.turning_radius_m);
      const double straight_m = distance(here.position(), there.position());
      if (path.length_m <= kJoinDetour * straight_m + kJoinMoreM) ways.emplace_back(path.length_m, other);
    }
    std::sort(ways.begin(), ways.end());

    std::size_t joined = 0;
    for (std::size_t i = 0; i < ways.size() && joined < kMostJoins; ++i)
      joined += join_by_arcs(id, ways[i].second, leaves) ? 1 : 0;
  }
}

bool Roadmap::join_by_arcs(PlaceId id, PlaceId other, bool leaves) {
  const KindId kind = places_[id]->kind;
  const Kind& build = nets_[kind].kind;
  Motion motion;
  motion.from = leaves ? id : other;
  motion.to = leaves ? other : id;
  motion.kind = kind;
  motion.is_temporary = true;
  sample(shortest_dubins(places_[motion.from]->base_in_map, places_[motion.to]->base_in_map, build.turning_radius_m),
         motion.path_in_map, motion.headings_rad);
  if (motion.path_in_map.size() < 2) return false;

  motion.path_in_map.back() = places_[motion.to]->base_in_map.position();
  motion.shape = swept_shape(build, motion.path_in_map, motion.headings_rad);
  if (!is_floor_free(*clearance_, build, motion.shape)) return false;

  if (!leaves && build.limits.max_reverse_mps > 0.0) {
    Motion back = motion;
    std::swap(back.from, back.to);
    std::reverse(back.path_in_map.begin(), back.path_in_map.end());
    std::reverse(back.headings_rad.begin(), back.headings_rad.end());
    back.is_reverse = true;
    add_motion(std::move(back));
  }

  add_motion(std::move(motion));
  return true;
}

PlaceId Roadmap::nearest_pose(KindId kind, const geometry::Pose2& base_in_map) const {
  const Net& net = nets_[kind];
  const Point2 at = base_in_map.position();
  std::vector<std::pair<double, PlaceId>> ways;
  net.places.visit(grown({at, at}, kJoinReachM), [&](PlaceId id) {
    if (places_[id]->is_closed) return;
    ways.emplace_back(shortest_dubins(base_in_map, places_[id]->base_in_map, net.kind.turning_radius_m).length_m, id);
  });
  std::sort(ways.begin(), ways.end());

  for (const auto& way : ways) {
    std::vector<Point2> points;
    std::vector<double> headings_rad;
    sample(shortest_dubins(base_in_map, places_[way.second]->base_in_map, net.kind.turning_radius_m), points,
           headings_rad);
    if (is_floor_free(*clearance_, net.kind, swept_shape(net.kind, points, headings_rad))) return way.second;
  }
  return kNoId;
}

}  // namespace aisle::global_planner::traffic
