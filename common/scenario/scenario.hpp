#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "common/fleet/zone.hpp"
#include "common/geometry/footprint.hpp"
#include "common/geometry/pose.hpp"
#include "common/grid/formats/map_file.hpp"
#include "common/kinematics/limits.hpp"

namespace aisle::scenario {

/// A vehicle as the scenario's file describes it.
struct VehicleSetup {
  std::string id;                     // "agv-1"
  std::string model{"differential"};  // or "omnidirectional" or "tricycle"
  geometry::Pose2 start_in_map;
  double radius_m{0.35};  // of a disc
  double length_m{0.0};   // of a rectangle; 0: a disc
  double width_m{0.0};
  double ahead_m{0.0};  // of its middle before the vehicle's frame
  double max_speed_mps{1.2};
  kinematics::SteeredAxle axle{};  // of a tricycle

  /// The outline around the vehicle's frame.
  geometry::Footprint footprint() const { return geometry::footprint_of(radius_m, length_m, width_m, ahead_m); }

  /// Of `model`; an unknown word is a differential drive (read_scenario refuses it).
  kinematics::Model kinematic_model() const;
};

using Vehicle = VehicleSetup;

/// The goals of one vehicle in order, repeated `loops` times (1: once).
struct Mission {
  std::string vehicle;
  std::vector<geometry::Pose2> goals_in_map;
  bool heading_matters{false};
  int loops{1};
};

/// Work for whichever vehicle serves it soonest: one goal, or a pick and a drop by the same vehicle.
struct Task {
  std::vector<geometry::Pose2> stops_in_map;  // one or two, in their order
  bool heading_matters{false};
};

/// A pose with a name, for people: "@dock".
struct NamedPlace {
  std::string name;
  geometry::Pose2 pose_in_map;
  bool has_yaw{false};
};

/// A person that walks along waypoints at a constant speed, to and fro or once.
struct Mover {
  std::string id;
  double radius_m{0.25};
  double speed_mps{1.2};
  double start_s{0.0};
  bool loop{true};
  bool courteous{true};  // stops short of a vehicle in its way, as people do
  std::vector<geometry::Point2> waypoints_in_map;
};

/// Recorded people (rows of frame, id, x, y), shifted and turned into the map.
struct Recording {
  std::filesystem::path file;
  geometry::Pose2 frame_in_map;
  double frames_per_s{25.0};  // of the film; 15 for biwi_eth, whose rows are ten frames apart like the others'
  double radius_m{0.25};
  double begin_s{0.0};
  double end_s{1e9};
};

/// A static rectangle that the map does not show.
struct Block {
  std::string id;
  geometry::Pose2 center_in_map;
  double length_m{0.8};
  double width_m{0.8};
  double appear_s{0.0};
};

/// A rectangle blocked or freed in the map at a given time.
struct MapEdit {
  double at_s{0.0};
  bool block{true};
  geometry::Point2 low_in_map;
  geometry::Point2 high_in_map;
};

/// A run as its YAML file describes it: map, vehicles with their goals, people and things.
struct Scenario {
  std::string name;
  std::filesystem::path
      map_file;  // relative to the scenario file, or $AISLE_DATA / ../shared/data when it begins with "data:"
  grid::MapFileOptions map_options;
  std::vector<Vehicle> vehicles;
  std::vector<Mission> missions;
  std::vector<Mover> movers;
  std::vector<Recording> recordings;
  std::vector<Block> blocks;
  std::vector<MapEdit> map_edits;
  std::uint64_t seed{1};
  double duration_s{300.0};        // the referee gives up then
  double start_jitter_m{0.0};      // starts, movers' speeds and phases vary by seed
  double person_clearance_m{0.0};  // the referee fails a run in which a vehicle and a person come nearer
  std::vector<Task> tasks;         // first the goals of missions for "any" vehicle, then the file's tasks
  std::vector<NamedPlace> places;
  std::vector<fleet::Zone> zones;  // of the file beside the map (zone_file.hpp), then the scenario's

  /// Goals of missions (loops counted) and stops of tasks.
  int goal_count() const;
};

/// Reads the file strictly and checks it as a whole: ids are unique, missions name vehicles. @throws
/// config::BadInput with file:line, key, value and limit. That a start lies inside a wall is found when
/// the map is loaded.
Scenario read_scenario(const std::filesystem::path& file);

}  // namespace aisle::scenario
