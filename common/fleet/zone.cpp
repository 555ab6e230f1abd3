#include "common/fleet/zone.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <tuple>
#include <utility>

#include "common/geometry/polygon.hpp"

namespace aisle::fleet {
namespace {

using geometry::Point2;

constexpr std::size_t kMostCorners = 64;
constexpr std::size_t kLongestId = 60;
constexpr double kFarthestM = 1.0e5;
constexpr double kSlowestMps = 0.05;
constexpr double kFastestMps = 10.0;
constexpr double kWidestTurnRad = 6.3;
constexpr int kDiscCorners = 32;

constexpr std::array<Zone::Kind, 6> kKinds{Zone::Kind::kKeepOut,    Zone::Kind::kSpeed,      Zone::Kind::kOneWay,
                                           Zone::Kind::kNoStopping, Zone::Kind::kOneVehicle, Zone::Kind::kParking};

std::string text(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof(buffer), "%.6g", value);
  return buffer;
}

std::string out_of_range(const char* field, double value, double low, double high) {
  return std::string(field) + " = " + text(value) + " is not within " + text(low) + " and " + text(high);
}

/// False for NaN.
bool is_within(double value, double low, double high) { return value >= low && value <= high; }

bool is_id(const std::string& id) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
           c == '.';
  };

  return !id.empty() && id.size() <= kLongestId && std::all_of(id.begin(), id.end(), fits);
}

/// Twice the area of a polygon, positive when its corners run counter-clockwise (shoelace formula).
double twice_area_m2(const std::vector<Point2>& corners) {
  double sum = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i)
    sum += geometry::cross(corners[i], corners[(i + 1) % corners.size()]);

  return sum;
}

/// Of the points and the radius.
std::string refusal_of_shape(const Zone& zone) {
  const std::vector<Point2>& points = zone.points_in_map;
  const std::string count = std::to_string(points.size());

  for (const Point2 point : points) {
    if (!is_within(point.x, -kFarthestM, kFarthestM))
      return out_of_range("points: x", point.x, -kFarthestM, kFarthestM);
    if (!is_within(point.y, -kFarthestM, kFarthestM))
      return out_of_range("points: y", point.y, -kFarthestM, kFarthestM);
  }

  switch (zone.shape) {
    case Zone::Shape::kRectangle:
      if (points.size() != 2) return "points: a rectangle has 2 opposite corners, this has " + count;
      return points[0].x != points[1].x && points[0].y != points[1].y ? "" : "points: the rectangle has no area";
    case Zone::Shape::kPolygon:
      if (points.size() < 3 || points.size() > kMostCorners)
        return "points: a polygon has 3 to 64 corners, this has " + count;
      return std::abs(twice_area_m2(points)) > 1e-9 ? "" : "points: the polygon has no area";
    case Zone::Shape::kDisc:
      if (points.size() != 1) return "points: a disc has 1 centre, this has " + count;
      return zone.radius_m > 0.0 && zone.radius_m <= kFarthestM
                 ? ""
                 : "radius_m = " + text(zone.radius_m) + " is not above 0 and at most " + text(kFarthestM);
  }

  return "shape: is unknown";
}

/// Do they cross, each with its ends on different sides of the other? Touching ends are found by their distance, 0.
bool cross_each_other(Point2 a, Point2 b, Point2 c, Point2 d) {
  const auto side = [](Point2 from, Point2 to, Point2 point) { return geometry::cross(to - from, point - from); };

  return side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0;
}

/// Metres between two segments; apart, an end of one of them is nearest to the other.
double between_segments_m(Point2 a, Point2 b, Point2 c, Point2 d) {
  if (cross_each_other(a, b, c, d)) return 0.0;

  return std::min({geometry::distance_to_segment(a, c, d), geometry::distance_to_segment(b, c, d),
                   geometry::distance_to_segment(c, a, b), geometry::distance_to_segment(d, a, b)});
}

}  // namespace

bool operator==(const Zone& a, const Zone& b) {
  const auto tied = [](const Zone& zone) {
    return std::tie(zone.id, zone.kind, zone.shape, zone.points_in_map, zone.radius_m, zone.max_speed_mps,
                    zone.direction_rad);
  };

  return tied(a) == tied(b);
}

const char* name(Zone::Kind kind) {
  switch (kind) {
    case Zone::Kind::kKeepOut:
      return "keep-out";
    case Zone::Kind::kSpeed:
      return "speed";
    case Zone::Kind::kOneWay:
      return "one-way";
    case Zone::Kind::kNoStopping:
      return "no-stopping";
    case Zone::Kind::kOneVehicle:
      return "one-vehicle";
    case Zone::Kind::kParking:
      return "parking";
  }

  return "unknown";
}

std::optional<Zone::Kind> find_zone_kind(const std::string& word) {
  const auto* const at =
      std::find_if(kKinds.begin(), kKinds.end(), [&](Zone::Kind kind) { return name(kind) == word; });
  return at == kKinds.end() ? std::nullopt : std::optional<Zone::Kind>(*at);
}

std::string refusal_of(const Zone& zone) {
  if (!is_id(zone.id)) return "zone_id: use 1 to 60 letters, digits, '-', '_' and '.'";

  std::string reason = refusal_of_shape(zone);
  if (!reason.empty()) return reason;

  // What only one kind has is 0 in the others, so that a zone is written in one way only.
  const bool is_speed = zone.kind == Zone::Kind::kSpeed;
  const bool is_one_way = zone.kind == Zone::Kind::kOneWay;
  const bool is_disc = zone.shape == Zone::Shape::kDisc;

  if (is_speed && !is_within(zone.max_speed_mps, kSlowestMps, kFastestMps))
    return out_of_range("max_speed_mps", zone.max_speed_mps, kSlowestMps, kFastestMps);
  if (is_one_way && !is_within(zone.direction_rad, -kWidestTurnRad, kWidestTurnRad))
    return out_of_range("direction_rad", zone.direction_rad, -kWidestTurnRad, kWidestTurnRad);

  if (!is_disc && zone.radius_m != 0.0) return "radius_m: only a disc has one";
  if (!is_speed && zone.max_speed_mps != 0.0) return "max_speed_mps: only a speed zone has one";
  if (!is_one_way && zone.direction_rad != 0.0) return "direction_rad: only a one-way zone has one";

  return {};
}

std::vector<Point2> corners_of(const Zone& zone) {
  const std::vector<Point2>& points = zone.points_in_map;

  switch (zone.shape) {
    case Zone::Shape::kRectangle:
      return {points[0], {points[1].x, points[0].y}, points[1], {points[0].x, points[1].y}};
    case Zone::Shape::kPolygon:
      return points;
    case Zone::Shape::kDisc:
      break;
  }

  // The edges touch the circle in their middles.
  std::vector<Point2> corners;
  const double reach_m = zone.radius_m / std::cos(geometry::kPi / kDiscCorners);
  for (int i = 0; i < kDiscCorners; ++i) {
    const double angle_rad = 2.0 * geometry::kPi * i / kDiscCorners;
    corners.push_back(points[0] + reach_m * Point2{std::cos(angle_rad), std::sin(angle_rad)});
  }

  return corners;
}

bool contains(const Zone& zone, Point2 point_in_map) { return distance_m(zone, point_in_map, point_in_map) <= 0.0; }

double distance_m(const Zone& zone, Point2 from_in_map, Point2 to_in_map) {
  if (zone.shape == Zone::Shape::kDisc)
    return std::max(0.0, geometry::distance_to_segment(zone.points_in_map[0], from_in_map, to_in_map) - zone.radius_m);

  // Within, or at the nearest edge.
  const std::vector<Point2> corners = corners_of(zone);
  if (geometry::is_in_polygon(corners, from_in_map)) return 0.0;

  double least_m = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Point2 next = corners[(i + 1) % corners.size()];
    least_m = std::min(least_m, between_segments_m(corners[i], next, from_in_map, to_in_map));
  }

  return least_m;
}

}  // namespace aisle::fleet
