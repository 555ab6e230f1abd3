#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::fleet {

/// A change of the site's map: cells blocked, or freed again.
struct MapEdit {
  enum class Action : std::uint8_t { kBlock = 0, kUnblock = 1 };
  enum class Shape : std::uint8_t { kRectangle = 0, kPolygon = 1, kDisc = 2 };

  std::string edit_id;  // an edit is applied once by this name
  std::string map_id;
  Action action{Action::kBlock};
  Shape shape{Shape::kRectangle};
  std::vector<geometry::Point2>
      points_in_map;     // rectangle: two opposite corners; polygon: three or more corners; disc: its centre
  double radius_m{0.0};  // of a disc
};

inline bool operator==(const MapEdit& a, const MapEdit& b) {
  return a.edit_id == b.edit_id && a.map_id == b.map_id && a.action == b.action && a.shape == b.shape &&
         a.points_in_map == b.points_in_map && a.radius_m == b.radius_m;
}

/// The answer to an edit.
struct MapEditResult {
  enum class Outcome : std::uint8_t { kApplied = 0, kAlreadyApplied = 1, kRefused = 2 };

  std::string edit_id;
  std::string map_id;
  Outcome outcome{Outcome::kRefused};
  std::string detail;         // why it was refused, one line
  std::uint64_t revision{0};  // of the map that holds the edit; of the newest map when refused
  std::uint32_t changed_cells{0};
};

}  // namespace aisle::fleet
