#include "services/local-planner/core/right_of_way/traffic.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

namespace aisle::local_planner {
namespace {

using geometry::Point2;

constexpr double kInfinity = std::numeric_limits<double>::infinity();

constexpr double kStepM = 0.2;        // between the points of the own way that are looked at
constexpr double kSlowestMps = 0.25;  // for times: it will not stand there for long
constexpr double kRoundingM = 1e-9;
constexpr double kHeadingAheadM = 0.1;  // the way's direction is looked at so far ahead
constexpr double kArrivesS = 1.5;       // a peer that comes later can still brake
constexpr double kFollowStepM = 0.1;
constexpr double kInsideM = 0.05;          // so little before a conflict, besides braking, is inside it
constexpr double kSameWayCosine = 0.5;     // of the angle between two ways that lead the same way
constexpr double kBeforeConflictM = 0.25;  // a vehicle that waits stops so far before the conflict

/// Where a claim passes a point: how near, when, and in which direction.
struct Pass {
  double distance_m{kInfinity};
  double time_s{0.0};
  Point2 direction;
};

/// A rectangle along the axes of map, grown point by point.
struct Box {
  Point2 low{kInfinity, kInfinity};
  Point2 high{-kInfinity, -kInfinity};

  /// Grows so that the point lies within.
  void hold(Point2 p) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }

  /// Is the point, or any point of another box, nearer than this? True also for one that is farther by a rounding.
  bool is_within(double distance_m, Point2 p) const { return is_within(distance_m, Box{p, p}); }

  bool is_within(double distance_m, const Box& other) const {
    const Point2 apart{std::max({0.0, low.x - other.high.x, other.low.x - high.x}),
                       std::max({0.0, low.y - other.high.y, other.low.y - high.y})};
    const double reach_m = distance_m + kBoxRoundingM;
    return geometry::dot(apart, apart) < reach_m * reach_m;
  }

 private:
  static constexpr double kBoxRoundingM = 1e-6;
};

/// A claim, looked at from many points: groups of its segments with a box around each, so that what lies far off is
/// passed over.
class ClaimedWay {
 public:
  /// @param claim not empty; must outlive this object
  explicit ClaimedWay(const std::vector<IntentPoint>& claim) : claim_(claim) {
    for (std::size_t first = 0; first < claim.size(); first += kGroup) {
      Group group{first, {}};
      for (std::size_t j = first; j <= std::min(first + kGroup, claim.size() - 1); ++j)
        group.box.hold(claim[j].base_in_map.position());

      groups_.push_back(group);
    }
  }

  /// The nearest point of the claim; where it is `within_m` or farther, that is all that the distance says.
  Pass pass_of(Point2 p, double within_m) const {
    Pass pass;
    for (const Group& group : groups_)
      if (group.box.is_within(std::min(within_m, pass.distance_m), p)) look(group.first, p, pass);

    return pass;
  }

  /// May a point of the box be as near as `within_m` to the claim? False is sure.
  bool may_come_near(const Box& box, double within_m) const {
    return std::any_of(groups_.begin(), groups_.end(),
                       [&](const Group& group) { return group.box.is_within(within_m, box); });
  }

 private:
  static constexpr std::size_t kGroup = 8;  // segments

  struct Group {
    std::size_t first;
    Box box;
  };

  /// Takes the nearest point of the group's segments if it is nearer than what was found so far; its time is
  /// interpolated between the segment's ends.
  void look(std::size_t first, Point2 p, Pass& pass) const {
    for (std::size_t j = first; j < std::min(first + kGroup, claim_.size()); ++j) {
      const Point2 a = claim_[j].base_in_map.position();
      const Point2 b = claim_[std::min(j + 1, claim_.size() - 1)].base_in_map.position();

      const Point2 ab = b - a;
      const double length2 = geometry::dot(ab, ab);
      const double t = length2 > 0.0 ? std::clamp(geometry::dot(p - a, ab) / length2, 0.0, 1.0) : 0.0;
      const double d = geometry::distance(p, a + t * ab);
      if (d >= pass.distance_m) continue;

      const double begin = claim_[j].offset_s;
      const double end = claim_[std::min(j + 1, claim_.size() - 1)].offset_s;
      pass = {d, begin + t * (end - begin), length2 > 0.0 ? (1.0 / std::sqrt(length2)) * ab : Point2{}};
    }
  }

  const std::vector<IntentPoint>& claim_;
  std::vector<Group> groups_;
};

/// A stretch of the own way that a peer's claim comes near to; times are from now.
struct Conflict {
  double begin_m{0.0};  // s
  double end_m{0.0};
  double my_in_s{0.0};
  double my_out_s{0.0};
  double its_in_s{kInfinity};
  double its_out_s{0.0};
  double alignment{0.0};  // mean cosine between the two directions
  int points{0};
  bool it_is_inside{false};  // it stands on this stretch or cannot stop before it
  bool reaches_me{false};    // the claim runs through where I am
};

/// The own way as far as it is looked at, a point every kStepM: the same for every peer.
struct OwnStretch {
  struct Point {
    double s_m;
    Point2 in_map;
    double time_s;  // from now
  };

  std::vector<Point> points;
  Box box;

  OwnStretch(const OwnWay& own, double look_ahead_m) {
    const double end = std::min(own.route.length_m(), own.s_m + look_ahead_m);
    double time = 0.0;

    std::size_t profile_index = 0;
    for (double s = own.s_m; s <= end + kRoundingM; s += kStepM) {
      while (profile_index + 1 < own.profile_mps.size() && own.route.along_m(profile_index) < s) ++profile_index;
      if (!points.empty()) time += kStepM / std::max(kSlowestMps, own.profile_mps[profile_index]);
      points.push_back({s, points.empty() ? own.position_in_map : own.route.at(s), time});
      box.hold(points.back().in_map);
    }
  }
};

/// Stretches of the own way whose points have a point of the peer's claim within both radii and the margin, in the
/// order of the way; with the times at which either vehicle is there, by its speeds.
std::vector<Conflict> conflicts_with(const OwnWay& own, const OwnStretch& stretch, const PeerView& peer,
                                     const TrafficSettings& settings) {
  std::vector<Conflict> found;
  const double near = own.radius_m + peer.radius_m + settings.margin_m;

  const ClaimedWay claim(peer.claim);
  if (!claim.may_come_near(stretch.box, near)) return found;

  bool open = false;
  for (const auto& [s, p, time] : stretch.points) {
    const Pass pass = claim.pass_of(p, near);
    if (pass.distance_m >= near) {
      open = false;
      continue;
    }

    // A new stretch, or the same one further on.
    if (!open) found.push_back({s, s, time, time, kInfinity, 0.0, 0.0, 0, false, false});
    open = true;

    Conflict& c = found.back();
    c.end_m = s;
    c.my_out_s = time;

    c.its_in_s = std::min(c.its_in_s, pass.time_s);
    c.its_out_s = std::max(c.its_out_s, pass.time_s);

    const double yaw = own.route.heading_at(s + kHeadingAheadM);
    c.alignment += geometry::dot(pass.direction, {std::cos(yaw), std::sin(yaw)});
    ++c.points;

    c.reaches_me = c.reaches_me || s == own.s_m;
    c.it_is_inside = c.it_is_inside || geometry::distance(p, peer.base_in_map.position()) <
                                           near + peer.stopping_m * (pass.time_s < kArrivesS ? 1.0 : 0.0);
  }

  for (Conflict& c : found) c.alignment /= c.points;
  return found;
}

/// The first s at which the own disc would be nearer to the peer's than the following gap, plus what the peer needs to
/// stop.
double behind_m(const OwnWay& own, const PeerView& peer, const TrafficSettings& settings) {
  const double gap = own.radius_m + peer.radius_m + settings.following_gap_m;

  for (double s = own.s_m; s <= own.route.length_m() && s < own.s_m + settings.look_ahead_m; s += kFollowStepM)
    if (geometry::distance(own.route.at(s), peer.base_in_map.position()) < gap) return s + peer.stopping_m;

  return std::numeric_limits<double>::infinity();
}

/// Is the peer behind the own vehicle, by the direction of the way here?
bool is_behind_me(const OwnWay& own, const PeerView& peer) {
  const double yaw = own.route.heading_at(own.s_m + kHeadingAheadM);
  const Point2 d = peer.base_in_map.position() - own.position_in_map;

  return geometry::dot(d, {std::cos(yaw), std::sin(yaw)}) < 0.0;
}

/// What a conflict means for the own vehicle.
enum class Right { kMine, kFollow, kWait, kGiveWay };

/// The first line that fits:
///
///   the same way, the peer on it and ahead                  follow
///   the same way, this vehicle on it                        mine
///   only this vehicle inside                                mine; but give way where the peer goes first and claims
///                                                           the place where this vehicle stands
///   only the peer inside                                    wait
///   this vehicle goes first                                 mine
///   both inside                                             give way where the claim runs through here, else wait
///   through well before the peer comes                      mine
///   the peer has stood for long                             mine
///   otherwise                                               wait
Right right_of_way(const OwnWay& own, const PeerView& peer, const Conflict& c, const TrafficSettings& settings) {
  const bool i_am_inside = c.reaches_me || c.begin_m - own.s_m < own.stopping_m + kInsideM;
  const bool same_way = c.alignment > kSameWayCosine;
  const bool i_go_first = outranks(own.id, peer.id);

  if (same_way && c.it_is_inside && !is_behind_me(own, peer)) return Right::kFollow;
  if (same_way && i_am_inside) return Right::kMine;
  if (i_am_inside && !c.it_is_inside) return i_go_first || !c.reaches_me ? Right::kMine : Right::kGiveWay;
  if (c.it_is_inside && !i_am_inside) return Right::kWait;
  if (i_go_first) return Right::kMine;
  if (i_am_inside) return c.reaches_me ? Right::kGiveWay : Right::kWait;
  if (c.my_out_s + settings.time_gap_s < c.its_in_s) return Right::kMine;
  if (peer.standing_s > settings.patience_s) return Right::kMine;

  return Right::kWait;
}

}  // namespace

bool is_claimed(const std::vector<IntentPoint>& claim, Point2 p, double distance_m) {
  return ClaimedWay(claim).pass_of(p, distance_m).distance_m < distance_m;
}

Advice advise(const OwnWay& own, const std::vector<PeerView>& peers, const TrafficSettings& settings) {
  Advice advice;
  if (own.route.points().size() < 2) return advice;

  const OwnStretch stretch(own, settings.look_ahead_m);
  for (const PeerView& peer : peers) {
    if (!peer.has_goal || peer.claim.size() < 2) continue;

    for (const Conflict& c : conflicts_with(own, stretch, peer, settings)) {
      const Right right = right_of_way(own, peer, c, settings);
      if (right == Right::kMine) continue;

      if (right == Right::kGiveWay) {
        advice.gives_way_to.push_back(peer.id);
        continue;
      }

      // The nearest stop counts; what lies beyond it of this peer can wait.
      const double stop =
          right == Right::kFollow ? behind_m(own, peer, settings) : std::max(own.s_m, c.begin_m - kBeforeConflictM);

      if (stop < advice.stop_at_m) {
        advice.stop_at_m = stop;
        advice.yields_to = peer.id;
        advice.follows = right == Right::kFollow;
        advice.conflict_in_map = own.route.at(c.begin_m);
      }

      break;
    }
  }

  return advice;
}

}  // namespace aisle::local_planner
