#include "services/global-planner/core/traffic/shape.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace aisle::global_planner::traffic {
namespace {

using geometry::Point2;
using geometry::Pose2;

// Two gaps that differ by less than this are equal: rounding must not decide.
constexpr double kRoundingM = 1e-9;

// Below this turn the arc runs at most 2.5 mm beside the corner: the way counts as straight.
constexpr double kStraightRad = 0.02;

// An arc runs at most so far beside its chord, and so far from all sides of the triangle of the corner and its ends:
// discs that are smaller would leave a hole between them.
constexpr double kArcToChordM = 0.151;

// Turning poses are swept in pieces of at most this.
constexpr double kPieceRad = 0.2;

Box box_of(const Capsule& c) {
  const Box spine{{std::min(c.from_in_map.x, c.to_in_map.x), std::min(c.from_in_map.y, c.to_in_map.y)},
                  {std::max(c.from_in_map.x, c.to_in_map.x), std::max(c.from_in_map.y, c.to_in_map.y)}};
  return grown(spine, c.radius_m);
}

Box box_of_both(const Box& a, const Box& b) {
  return {{std::min(a.low_in_map.x, b.low_in_map.x), std::min(a.low_in_map.y, b.low_in_map.y)},
          {std::max(a.high_in_map.x, b.high_in_map.x), std::max(a.high_in_map.y, b.high_in_map.y)}};
}

double squared_to_segment(Point2 p, Point2 a, Point2 b) {
  const Point2 ab = b - a;
  const double length2 = dot(ab, ab);
  const double t = length2 > 0.0 ? std::min(1.0, std::max(0.0, dot(p - a, ab) / length2)) : 0.0;
  const Point2 off = p - a - t * ab;
  return dot(off, off);
}

/// Do the two segments cross each other within both? Parallel ones do not: then an end is nearest.
bool cross_each_other(const Capsule& a, const Capsule& b) {
  const Point2 along_a = a.to_in_map - a.from_in_map;
  const Point2 along_b = b.to_in_map - b.from_in_map;
  const double from_a = cross(along_b, a.from_in_map - b.from_in_map);
  const double to_a = cross(along_b, a.to_in_map - b.from_in_map);
  const double from_b = cross(along_a, b.from_in_map - a.from_in_map);
  const double to_b = cross(along_a, b.to_in_map - a.from_in_map);
  return ((from_a < 0.0) != (to_a < 0.0)) && ((from_b < 0.0) != (to_b < 0.0));
}

/// Square of the distance between the spines of two capsules.
///
/// How: where they do not cross, an end of one of them is nearest.
double squared_between_spines(const Capsule& a, const Capsule& b) {
  if (cross_each_other(a, b)) return 0.0;

  return std::min({squared_to_segment(a.from_in_map, b.from_in_map, b.to_in_map),
                   squared_to_segment(a.to_in_map, b.from_in_map, b.to_in_map),
                   squared_to_segment(b.from_in_map, a.from_in_map, a.to_in_map),
                   squared_to_segment(b.to_in_map, a.from_in_map, a.to_in_map)});
}

/// The chord of the arc that cuts a corner of a polyline, and whether there is one.
///
/// The arc begins `kCornerM` before the corner, or half the shorter leg, and ends so far behind it; it touches both
/// legs. So it lies in the triangle of the corner and its two ends, and the sweep of this triangle's sides holds the
/// sweep of the arc, as no point of the triangle is farther from its sides than a usual vehicle's radius; for smaller
/// ones the chord is widened.
bool corner_chord(Point2 before, Point2 corner, Point2 after, double radius_m, Capsule& out) {
  const double in_m = distance(before, corner);
  const double out_m = distance(corner, after);
  if (in_m < kRoundingM || out_m < kRoundingM) return false;

  const double turn_rad = std::atan2(cross(corner - before, after - corner), dot(corner - before, after - corner));
  if (std::abs(turn_rad) < kStraightRad) return false;

  const double reach_m = std::min({kCornerM, 0.5 * in_m, 0.5 * out_m});
  out = {corner - (reach_m / in_m) * (corner - before), corner + (reach_m / out_m) * (after - corner),
         radius_m < kArcToChordM ? radius_m + kArcToChordM : radius_m};
  return true;
}

/// Radius of the disc that a vehicle that turns on the spot may touch, tube included.
double turning_disc_m(const Kind& kind) { return geometry::reach_m(kind.footprint) + kind.tube_m; }

std::vector<Capsule> swept_by_disc(const std::vector<Point2>& path, double radius_m) {
  std::vector<Capsule> out;
  if (path.size() == 1) out.push_back({path[0], path[0], radius_m});

  for (std::size_t i = 1; i < path.size(); ++i) {
    out.push_back({path[i - 1], path[i], radius_m});

    Capsule chord;
    if (i + 1 < path.size() && corner_chord(path[i - 1], path[i], path[i + 1], radius_m, chord)) out.push_back(chord);
  }

  return out;
}

/// Appends what the covering discs sweep while the frame moves evenly from one pose to the other: straight where the
/// heading stays, else around one centre.
///
/// How: the whole turn is cut into pieces; in each the path of a disc's centre is an arc, which stays within its
/// sagitta of its chord. Where the heading stays, all discs along the axis move on parallel lines: on one line when the
/// vehicle drives along its axis, then one capsule holds them.
void sweep_covering_discs(const geometry::CoveringDiscs& discs, double tube_m, const Pose2& from, const Pose2& to,
                          std::vector<Capsule>& out) {
  const double turn_rad = geometry::wrap(to.yaw - from.yaw);
  const Point2 way = to.position() - from.position();

  if (std::abs(turn_rad) < 1e-6) {
    const Point2 ahead{std::cos(from.yaw), std::sin(from.yaw)};
    const bool is_along_axis = std::abs(cross(ahead, way)) < 1e-6;
    const double radius_m = discs.radius_m + tube_m;

    if (is_along_axis) {
      const double along_m = dot(ahead, way);
      const double low_m = discs.ahead_m.front() + std::min(0.0, along_m);
      const double high_m = discs.ahead_m.back() + std::max(0.0, along_m);
      out.push_back({to_map(from, {low_m, 0.0}), to_map(from, {high_m, 0.0}), radius_m});
    } else {
      for (const double ahead_m : discs.ahead_m)
        out.push_back({to_map(from, {ahead_m, 0.0}), to_map(to, {ahead_m, 0.0}), radius_m});
    }
    return;
  }

  // The centre lies beside the middle of the way, at |way| / (2 tan(turn / 2)) to its left.
  const double beside = 0.5 / std::tan(0.5 * turn_rad);
  const Point2 centre = from.position() + 0.5 * way + beside * Point2{-way.y, way.x};
  const int pieces = static_cast<int>(std::ceil(std::abs(turn_rad) / kPieceRad));
  const double piece_rad = turn_rad / pieces;

  for (const double ahead_m : discs.ahead_m) {
    const Point2 arm = to_map(from, {ahead_m, 0.0}) - centre;
    const double sagitta_m = norm(arm) * (1.0 - std::cos(0.5 * piece_rad));

    for (int i = 0; i < pieces; ++i)
      out.push_back({to_map({centre.x, centre.y, i * piece_rad}, arm),
                     to_map({centre.x, centre.y, (i + 1) * piece_rad}, arm), discs.radius_m + tube_m + sagitta_m});
  }
}

/// Headings of a path that is driven ahead, where none are given: each point's along the leg that begins there.
std::vector<double> headings_along(const std::vector<Point2>& path) {
  std::vector<double> out;
  for (std::size_t i = 0; i + 1 < path.size(); ++i) out.push_back(geometry::bearing(path[i], path[i + 1]));
  out.push_back(out.empty() ? 0.0 : out.back());
  return out;
}

}  // namespace

Shape::Shape(std::vector<Capsule> capsules) : capsules_(std::move(capsules)) {
  if (capsules_.empty()) return;

  box_ = box_of(capsules_.front());
  for (const Capsule& capsule : capsules_) box_ = box_of_both(box_, box_of(capsule));
}

void Shape::add(const Shape& other) {
  if (other.empty()) return;

  box_ = empty() ? other.box_ : box_of_both(box_, other.box_);
  capsules_.insert(capsules_.end(), other.capsules_.begin(), other.capsules_.end());
}

Shape Shape::moved(geometry::Point2 by) const {
  Shape out = *this;
  for (Capsule& capsule : out.capsules_) {
    capsule.from_in_map = capsule.from_in_map + by;
    capsule.to_in_map = capsule.to_in_map + by;
  }
  out.box_ = {box_.low_in_map + by, box_.high_in_map + by};
  return out;
}

double separation_m(const Shape& a, const Shape& b) {
  double least_m = std::numeric_limits<double>::infinity();
  for (const Capsule& of_a : a.capsules())
    for (const Capsule& of_b : b.capsules())
      least_m = std::min(least_m, std::sqrt(squared_between_spines(of_a, of_b)) - of_a.radius_m - of_b.radius_m);

  return least_m;
}

double gap_between_m(const Shape& a, const Shape& b) { return std::max(0.0, separation_m(a, b)); }

bool meet(const Shape& a, const Shape& b, double gap_m) {
  if (a.empty() || b.empty()) return false;

  const Box around_b = grown(b.box(), gap_m);
  if (!touch(a.box(), around_b)) return false;

  for (const Capsule& of_a : a.capsules()) {
    if (!touch(box_of(of_a), around_b)) continue;

    for (const Capsule& of_b : b.capsules()) {
      const double least_m = of_a.radius_m + of_b.radius_m + gap_m - kRoundingM;
      if (squared_between_spines(of_a, of_b) < least_m * least_m) return true;
    }
  }

  return false;
}

/// A capsule is the hull of the discs at its ends, and `outer` is convex: it holds all when it holds both discs.
bool is_inside(const Capsule& inner, const Capsule& outer) {
  const double room_m = outer.radius_m - inner.radius_m + kRoundingM;
  if (room_m < 0.0) return false;

  return squared_to_segment(inner.from_in_map, outer.from_in_map, outer.to_in_map) <= room_m * room_m &&
         squared_to_segment(inner.to_in_map, outer.from_in_map, outer.to_in_map) <= room_m * room_m;
}

bool operator==(const Kind& a, const Kind& b) {
  const auto all = [](const Kind& k) {
    return std::make_tuple(k.footprint.shape, k.footprint.radius_m, k.footprint.length_m, k.footprint.width_m,
                           k.footprint.ahead_m, k.tube_m, k.wall_margin_m, k.turning_radius_m, k.limits.max_speed_mps,
                           k.limits.max_reverse_mps, k.limits.max_turn_radps, k.limits.max_acceleration_mps2,
                           k.limits.max_deceleration_mps2, k.limits.max_turn_acceleration_radps2, k.limits.model,
                           k.limits.axle.wheelbase_m, k.limits.axle.max_steering_rad,
                           k.limits.axle.max_steering_rate_radps, k.limits.axle.is_rear);
  };
  return all(a) == all(b);
}

Shape standing_shape(const Kind& kind, const geometry::Pose2& base_in_map) {
  return swept_shape(kind, {base_in_map.position()}, {base_in_map.yaw});
}

Shape swept_shape(const Kind& kind, const std::vector<geometry::Point2>& path_in_map,
                  const std::vector<double>& headings_rad) {
  if (path_in_map.empty()) return {};
  if (kind.turns_on_the_spot()) return Shape(swept_by_disc(path_in_map, turning_disc_m(kind)));

  const auto headings = headings_rad.size() == path_in_map.size() ? headings_rad : headings_along(path_in_map);
  const auto pose = [&](std::size_t i) { return Pose2{path_in_map[i].x, path_in_map[i].y, headings[i]}; };
  const auto discs = geometry::covering_discs(kind.footprint);

  std::vector<Capsule> out;
  if (path_in_map.size() == 1) sweep_covering_discs(discs, kind.tube_m, pose(0), pose(0), out);
  for (std::size_t i = 1; i < path_in_map.size(); ++i)
    sweep_covering_discs(discs, kind.tube_m, pose(i - 1), pose(i), out);

  // Between the discs of an arc's end lies floor that is swept by none of them.
  const std::size_t last = path_in_map.size() - 1;
  const bool ends_in_an_arc = last > 0 && std::abs(geometry::wrap(headings[last] - headings[last - 1])) >= 1e-6;
  if (ends_in_an_arc) sweep_covering_discs(discs, kind.tube_m, pose(last), pose(last), out);

  return Shape(std::move(out));
}

Shape corner_shape(const Kind& kind, geometry::Point2 before_in_map, geometry::Point2 corner_in_map,
                   geometry::Point2 after_in_map) {
  Capsule chord;
  const bool has_arc =
      kind.turns_on_the_spot() && corner_chord(before_in_map, corner_in_map, after_in_map, turning_disc_m(kind), chord);
  return has_arc ? Shape({chord}) : Shape();
}

Shape all_corners_shape(const Kind& kind, geometry::Point2 corner_in_map) {
  if (!kind.turns_on_the_spot()) return Shape();
  return Shape({{corner_in_map, corner_in_map, kCornerM + turning_disc_m(kind) + kArcToChordM}});
}

}  // namespace aisle::global_planner::traffic
