#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "common/fleet/map_edit.hpp"
#include "common/geometry/pose.hpp"

namespace aisle::fleet {

/// A part of the floor with a rule for vehicles. Zones belong to the site's map and change with its revision.
struct Zone {
  enum class Kind : std::uint8_t {
    kKeepOut = 0,     // no vehicle's outline enters it
    kSpeed = 1,       // a vehicle whose outline meets it drives at most `max_speed_mps`
    kOneWay = 2,      // inside, vehicles drive along `direction_rad` only, never against it
    kNoStopping = 3,  // no vehicle rests here and no goal lies here; vehicles pass without waiting inside
    kOneVehicle = 4,  // at most one vehicle's outline meets it at a time
    kParking = 5,     // vehicles without a goal rest here first
  };
  using Shape = MapEdit::Shape;

  std::string id;  // unique on its map: 1 to 60 letters, digits, '-', '_' and '.'
  Kind kind{Kind::kKeepOut};
  Shape shape{Shape::kRectangle};
  std::vector<geometry::Point2>
      points_in_map;          // rectangle: two opposite corners; polygon: 3 to 64 corners, in order; disc: its centre
  double radius_m{0.0};       // of a disc
  double max_speed_mps{0.0};  // of a speed zone, 0.05 to 10; else 0
  double direction_rad{0.0};  // of a one-way zone, from map's x axis, -6.3 to 6.3; else 0
};

bool operator==(const Zone& a, const Zone& b);
inline bool operator!=(const Zone& a, const Zone& b) { return !(a == b); }

/// As many zones as one map may have.
inline constexpr std::size_t kMostZones = 256;

/// "keep-out", "speed", "one-way", "no-stopping", "one-vehicle" or "parking": as files and commands write it.
const char* name(Zone::Kind kind);

/// None for any other word.
std::optional<Zone::Kind> find_zone_kind(const std::string& word);

/// Why this is no zone, in one line that names value and limit; empty when it is one.
std::string refusal_of(const Zone& zone);

// Geometry. @pre refusal_of(zone) is empty. The zone's edge belongs to it; where a polygon crosses itself the even-odd
// rule holds.

/// Its corners in map, in order. A disc is a polygon of 32 corners around it, at most 0.5 % of its radius outside.
std::vector<geometry::Point2> corners_of(const Zone& zone);

/// Does the point lie in the zone?
bool contains(const Zone& zone, geometry::Point2 point_in_map);

/// Metres from the zone to the segment; 0 where they meet. A capsule with a radius of r metres meets the zone when this
/// is less than r. Pass the same point twice for the distance of a point.
double distance_m(const Zone& zone, geometry::Point2 from_in_map, geometry::Point2 to_in_map);

/// A change of the map's zones.
struct ZoneEdit {
  enum class Action : std::uint8_t { kAdd = 0, kRemove = 1 };

  std::string edit_id;  // applied once by this name; shares its names with the map's other edits
  std::string map_id;
  Action action{Action::kAdd};
  Zone zone;  // kRemove: only its id counts
};

/// All zones of a map.
struct MapZones {
  std::string map_id;
  std::uint64_t revision{0};  // of the map, when its zones changed last
  std::vector<Zone> zones;    // by id, ascending
};

}  // namespace aisle::fleet
