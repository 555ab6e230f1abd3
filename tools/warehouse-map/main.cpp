// Draws the demo's warehouse, always the same: aisle-warehouse-map deploy/maps/warehouse.yaml

#include <CLI/CLI.hpp>
#include <array>
#include <cmath>
#include <exception>
#include <iostream>
#include <string>

#include "common/grid/formats/map_file.hpp"

namespace {

using namespace aisle;

constexpr double kResolutionM = 0.05;
constexpr double kWidthM = 44.0;
constexpr double kHeightM = 28.0;
constexpr double kWallM = 0.2;
constexpr double kRackDepthM = 1.2;
constexpr double kRackLengthM = 15.0;
constexpr std::array<double, 5> kRackBottomsM{4.5, 8.7, 12.9, 17.1, 21.3};  // aisles of 3 m between
constexpr std::array<double, 2> kRackLeftsM{5.0, 24.0};  // cross aisles of 4 m at the sides and in the middle
constexpr std::array<geometry::Point2, 3> kPillarsM{{{22.0, 2.6}, {12.0, 25.4}, {32.0, 25.4}}};
constexpr double kPillarM = 0.4;

/// Occupies the cells from one corner to the other, in metres, in map.
void fill(grid::OccupancyGrid& grid, geometry::Point2 low_in_map, geometry::Point2 high_in_map) {
  const auto cell = [](double metres) { return static_cast<int>(std::lround(metres / kResolutionM)); };
  for (int y = cell(low_in_map.y); y < cell(high_in_map.y); ++y) {
    for (int x = cell(low_in_map.x); x < cell(high_in_map.x); ++x) grid.set({x, y}, grid::Occupancy::kOccupied);
  }
}

/// Four walls, five double rows of racks in two columns, three pillars.
grid::OccupancyGrid warehouse() {
  grid::OccupancyGrid grid(grid::Geometry{static_cast<int>(std::lround(kWidthM / kResolutionM)),
                                          static_cast<int>(std::lround(kHeightM / kResolutionM)),
                                          kResolutionM,
                                          {}});
  fill(grid, {0.0, 0.0}, {kWidthM, kWallM});
  fill(grid, {0.0, kHeightM - kWallM}, {kWidthM, kHeightM});
  fill(grid, {0.0, 0.0}, {kWallM, kHeightM});
  fill(grid, {kWidthM - kWallM, 0.0}, {kWidthM, kHeightM});

  for (const double bottom : kRackBottomsM) {
    for (const double left : kRackLeftsM) fill(grid, {left, bottom}, {left + kRackLengthM, bottom + kRackDepthM});
  }

  const double half = kPillarM / 2.0;
  for (const geometry::Point2 p : kPillarsM) fill(grid, {p.x - half, p.y - half}, {p.x + half, p.y + half});

  return grid;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Draws the demo's rack warehouse (44 x 28 m at 0.05 m) as a ROS map"};
  std::string file;

  app.add_option("FILE", file, "the .yaml to write; the image is written beside it")->required();
  CLI11_PARSE(app, argc, argv);

  try {
    grid::write_ros_map(warehouse(), file);
  } catch (const std::exception& error) {
    std::cerr << "aisle-warehouse-map: " << error.what() << '\n';
    return 3;
  }

  return 0;
}
