#pragma once

#include <string>
#include <vector>

#include "common/fleet/zone.hpp"
#include "common/geometry/footprint.hpp"
#include "common/geometry/pose.hpp"
#include "common/grid/occupancy_grid.hpp"

namespace aisle::cli {

/// A vehicle in the picture of the traffic.
struct DrawnVehicle {
  std::string agv_id;
  geometry::Pose2 base_in_map;
  geometry::Footprint footprint{geometry::disc(0.35)};
  std::vector<geometry::Point2> way_in_map;  // of its plan; empty: it has none
  double driven_m{0.0};                      // along the way
  double granted_m{0.0};                     // it may drive so far along the way
  std::string waits_for;                     // empty: no vehicle
};

/// The part of a polyline between two lengths along it, both ends included; empty where `to_m` is not beyond `from_m`.
std::vector<geometry::Point2> part_of(const std::vector<geometry::Point2>& way, double from_m, double to_m);

/// An SVG file's text: the map, its zones, each vehicle's way (thin), what is granted of it (thick), and an arrow from
/// each waiting vehicle to the one that it waits for.
std::string traffic_svg(const grid::OccupancyGrid& grid, const std::vector<DrawnVehicle>& vehicles,
                        const std::vector<fleet::Zone>& zones = {});

}  // namespace aisle::cli
