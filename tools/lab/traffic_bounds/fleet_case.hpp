#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "common/grid/clearance.hpp"
#include "common/scenario/scenario.hpp"
#include "services/global-planner/core/traffic/roadmap.hpp"
#include "tools/lab/traffic_bounds/step_graph.hpp"

namespace aisle::lab {

/// A floor on which fleets of any size are drawn.
struct Floor {
  std::string name;  // "warehouse"
  std::filesystem::path map_file;
  grid::MapFileOptions map_options;
  double radius_m{0.35};        // of the vehicles, all discs
  geometry::Point2 low_in_map;  // starts and goals lie within
  geometry::Point2 high_in_map{1e9, 1e9};
};

/// The demo's warehouse, then the block of the Moving AI warehouse where the reference data is there.
/// @param warehouse_map deploy/maps/warehouse.yaml
std::vector<Floor> known_floors(const std::filesystem::path& warehouse_map);

/// A floor that is read, with the roadmap of its vehicles. Not to be moved: the roadmap looks at the clearance.
struct FloorModel {
  explicit FloorModel(const Floor& floor);
  FloorModel(const FloorModel&) = delete;
  FloorModel& operator=(const FloorModel&) = delete;

  Floor floor;
  grid::OccupancyGrid grid;
  grid::ClearanceField clearance;
  global_planner::traffic::Kind kind;
  global_planner::traffic::Roadmap roadmap;
  global_planner::traffic::KindId kind_id{0};
  StepGraph graph;
};

/// How fleets are drawn, in words.
extern const char* const kFleetRule;

/// A fleet with random goals, more than it can reach in `duration_s`. The same seed gives the same; a smaller fleet is
/// the beginning of a larger one.
/// @throws config::BadInput when the floor has no room for so many
scenario::Scenario draw_fleet(const FloorModel& model, std::uint64_t seed, std::size_t vehicles, double duration_s);

/// The first `vehicles` of the fleet. With `goals`: only so many goals of each.
scenario::Scenario first_of(const scenario::Scenario& fleet, std::size_t vehicles,
                            std::optional<std::size_t> goals = std::nullopt);

/// The fleet's vehicle with this index, alone.
scenario::Scenario alone(const scenario::Scenario& fleet, std::size_t vehicle);

}  // namespace aisle::lab
