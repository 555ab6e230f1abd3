#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/config/yaml_reader.hpp"
#include "common/fleet/any_vehicle.hpp"
#include "common/scenario/data_path.hpp"
#include "common/scenario/scenario.hpp"
#include "common/scenario/zone_file.hpp"

namespace aisle::scenario {
namespace {

using config::YamlReader;

constexpr double kFarthestM = 1.0e5;
constexpr double kLongestS = 86400.0;
constexpr std::size_t kMostVehicles = 100;
constexpr std::size_t kMostGoals = 1000;
constexpr std::size_t kMostTasks = 1000;

/// 1 to 60 letters, digits, '-', '_' and '.'.
bool is_id(const std::string& id) {
  const auto fits = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
           c == '.';
  };

  return !id.empty() && id.size() <= 60 && std::all_of(id.begin(), id.end(), fits);
}

/// Reads a required id.
void read_id(YamlReader& r, const char* key, std::string& id) {
  r.field(key, id).require({key});
  if (r.has(key) && !is_id(id))
    r.reject(key, "'" + id + "' is not an id; use 1 to 60 letters, digits, '-', '_' and '.'");
}

/// [x, y] or [x, y, yaw].
geometry::Pose2 pose_of(YamlReader& r, const char* key, const std::vector<double>& numbers) {
  if (numbers.size() < 2 || numbers.size() > 3)
    r.reject(key, "takes [x, y] or [x, y, yaw]: metres and radians, in map");

  const double yaw = numbers.size() == 3 ? numbers[2] : 0.0;
  if (std::abs(yaw) > 6.3) r.reject(key, "the yaw is in radians, at most a turn (6.28)");

  return {numbers[0], numbers[1], geometry::wrap(yaw)};
}

/// Leaves `pose` as it is when the key is missing.
void read_pose(YamlReader& r, const char* key, geometry::Pose2& pose) {
  std::vector<double> numbers;
  r.field(key, numbers, -kFarthestM, kFarthestM);
  if (r.has(key)) pose = pose_of(r, key, numbers);
}

/// Leaves `point` as it is when the key is missing.
void read_point(YamlReader& r, const char* key, geometry::Point2& point) {
  std::vector<double> numbers;
  r.field(key, numbers, -kFarthestM, kFarthestM);

  if (!r.has(key)) return;

  if (numbers.size() != 2) r.reject(key, "takes [x, y]: metres in map");
  point = {numbers[0], numbers[1]};
}

/// By its word in the file.
std::optional<kinematics::Model> find_model(const std::string& name) {
  if (name == "differential") return kinematics::Model::kDifferential;
  if (name == "omnidirectional") return kinematics::Model::kOmnidirectional;
  if (name == "tricycle") return kinematics::Model::kTricycle;
  return std::nullopt;
}

// What the file says of each thing; the names of the keys stand here and nowhere else.

/// A disc has radius_m, a rectangle length_m and width_m; only a tricycle has an axle.
struct VehicleEntry {
  VehicleSetup value;

  void describe(YamlReader& r) {
    read_id(r, "id", value.id);

    r.field("model", value.model)
        .field("radius_m", value.radius_m, 0.05, 5.0)
        .field("length_m", value.length_m, 0.1, 10.0)
        .field("width_m", value.width_m, 0.1, 10.0)
        .field("ahead_m", value.ahead_m, -5.0, 5.0)
        .field("max_speed_mps", value.max_speed_mps, 0.05, 10.0)
        .section("axle", value.axle);

    r.require({"start"});
    read_pose(r, "start", value.start_in_map);

    if (!find_model(value.model))
      r.reject("model", "'" + value.model + "' is not simulated; use differential, omnidirectional or tricycle");

    if (r.has("length_m") != r.has("width_m"))
      r.reject(r.has("length_m") ? "length_m" : "width_m", "a rectangle has both, length_m and width_m");

    if (r.has("length_m") && r.has("radius_m")) r.reject("radius_m", "a rectangle has none; give length_m and width_m");
    if (r.has("ahead_m") && !r.has("length_m")) r.reject("ahead_m", "is a rectangle's; give length_m and width_m");
    if (r.has("axle") && value.model != "tricycle") r.reject("axle", "only a tricycle has a steered axle");
  }
};

/// `where`: file and line of the vehicle's name, for checks of the whole file.
struct MissionEntry {
  Mission value;
  std::string where;

  void describe(YamlReader& r) {
    std::vector<std::vector<double>> rows;
    r.field("vehicle", value.vehicle)
        .field("goals", rows, -kFarthestM, kFarthestM)
        .field("heading_matters", value.heading_matters)
        .field("loops", value.loops, 1, 100000)
        .require({"vehicle", "goals"});

    if (r.has("goals") && (rows.empty() || rows.size() > kMostGoals)) r.reject("goals", "takes 1 to 1000 goals");
    for (const std::vector<double>& row : rows) value.goals_in_map.push_back(pose_of(r, "goals", row));
    where = r.where("vehicle");
  }
};

/// From "pick" to "drop", each [x, y] or [x, y, yaw].
struct TaskEntry {
  Task value;

  void describe(YamlReader& r) {
    geometry::Pose2 pick;
    geometry::Pose2 drop;
    r.require({"pick", "drop"}).field("heading_matters", value.heading_matters);
    read_pose(r, "pick", pick);
    read_pose(r, "drop", drop);
    value.stops_in_map = {pick, drop};
  }
};

/// "name" and "at", [x, y] or [x, y, yaw].
struct PlaceEntry {
  NamedPlace value;

  void describe(YamlReader& r) {
    std::vector<double> numbers;
    read_id(r, "name", value.name);
    r.field("at", numbers, -kFarthestM, kFarthestM).require({"at"});
    if (!r.has("at")) return;

    value.pose_in_map = pose_of(r, "at", numbers);
    value.has_yaw = numbers.size() == 3;
  }
};

/// A person with two or more waypoints.
struct MoverEntry {
  Mover value;

  void describe(YamlReader& r) {
    std::vector<std::vector<double>> rows;
    read_id(r, "id", value.id);

    r.field("radius_m", value.radius_m, 0.05, 5.0)
        .field("speed_mps", value.speed_mps, 0.01, 5.0)
        .field("start_s", value.start_s, 0.0, kLongestS)
        .field("loop", value.loop)
        .field("courteous", value.courteous)
        .field("waypoints", rows, -kFarthestM, kFarthestM)
        .require({"waypoints"});

    if (r.has("waypoints") && rows.size() < 2) r.reject("waypoints", "takes two or more points [x, y]");

    for (const std::vector<double>& row : rows) {
      if (row.size() != 2) r.reject("waypoints", "takes points [x, y]: metres in map");
      value.waypoints_in_map.push_back({row[0], row[1]});
    }
  }
};

/// `file`: as it stands in the scenario; it is looked for later.
struct RecordingEntry {
  Recording value;
  std::string file;

  void describe(YamlReader& r) {
    r.field("file", file)
        .field("frames_per_s", value.frames_per_s, 1.0, 1000.0)
        .field("radius_m", value.radius_m, 0.05, 5.0)
        .field("begin_s", value.begin_s, 0.0, 1e9)
        .field("end_s", value.end_s, 0.0, 1e9)
        .require({"file"});

    read_pose(r, "frame", value.frame_in_map);
    if (value.end_s <= value.begin_s) r.reject("end_s", "must be later than begin_s");
  }
};

/// A rectangle at "center", [x, y] or [x, y, yaw].
struct BlockEntry {
  Block value;

  void describe(YamlReader& r) {
    read_id(r, "id", value.id);
    r.field("length_m", value.length_m, 0.05, 50.0)
        .field("width_m", value.width_m, 0.05, 50.0)
        .field("appear_s", value.appear_s, 0.0, kLongestS)
        .require({"center"});
    read_pose(r, "center", value.center_in_map);
  }
};

/// "action" is block or unblock; from "low" to "high".
struct MapEditEntry {
  MapEdit value;

  void describe(YamlReader& r) {
    std::string action = "block";
    r.field("at_s", value.at_s, 0.0, kLongestS).field("action", action).require({"at_s", "low", "high"});
    read_point(r, "low", value.low_in_map);
    read_point(r, "high", value.high_in_map);
    if (action != "block" && action != "unblock") r.reject("action", "'" + action + "' is neither block nor unblock");
    value.block = action == "block";

    if (value.high_in_map.x <= value.low_in_map.x || value.high_in_map.y <= value.low_in_map.y) {
      r.reject("high", "must lie above and to the right of low");
    }
  }
};

/// Reads a list of entries and appends their values. @returns the entries, for what only they know
template <class Entry, class Value>
std::vector<Entry> read_list(YamlReader& r, const char* key, std::vector<Value>& values) {
  std::vector<Entry> entries;
  r.list(key, entries);
  for (Entry& entry : entries) values.push_back(entry.value);
  return entries;
}

/// The whole file; checks that need more than one entry are made at the end.
struct ScenarioFile {
  Scenario value;
  std::string map;
  std::vector<MissionEntry> missions;
  std::vector<RecordingEntry> recordings;

  void describe(YamlReader& r) {
    r.field("name", value.name)
        .field("map", map)
        .field("moving_ai_cell_m", value.map_options.moving_ai_cell_m, 0.01, 100.0)
        .field("subdivide", value.map_options.subdivide, 1, 64)
        .field("seed", value.seed, 0, ~std::uint64_t{0} >> 1)
        .field("duration_s", value.duration_s, 1.0, kLongestS)
        .field("start_jitter_m", value.start_jitter_m, 0.0, 1.0)
        .field("person_clearance_m", value.person_clearance_m, 0.0, 10.0)
        .require({"map", "vehicles"});

    read_list<VehicleEntry>(r, "vehicles", value.vehicles);
    missions = read_list<MissionEntry>(r, "missions", value.missions);
    tell_tasks(r);
    read_list<PlaceEntry>(r, "places", value.places);
    read_list<MoverEntry>(r, "movers", value.movers);
    recordings = read_list<RecordingEntry>(r, "recordings", value.recordings);
    read_list<BlockEntry>(r, "blocks", value.blocks);
    read_list<MapEditEntry>(r, "map_edits", value.map_edits);
    read_zones(r, "zones", value.zones);
    check(r);
  }

  /// Each goal of a mission for any vehicle is a task.
  void tell_tasks(YamlReader& r) {
    std::vector<Mission> missions_of_one;
    for (const Mission& mission : value.missions) {
      if (mission.vehicle != fleet::kAnyVehicle) {
        missions_of_one.push_back(mission);
        continue;
      }

      for (int loop = 0; loop < mission.loops; ++loop) {
        for (const geometry::Pose2& goal : mission.goals_in_map)
          value.tasks.push_back({{goal}, mission.heading_matters});
        if (value.tasks.size() > kMostTasks) r.reject("missions", "for any vehicle have more than 1000 goals in all");
      }
    }

    value.missions = std::move(missions_of_one);

    std::vector<Task> tasks;
    read_list<TaskEntry>(r, "tasks", tasks);
    value.tasks.insert(value.tasks.end(), tasks.begin(), tasks.end());
    if (value.tasks.size() > kMostTasks) r.reject("tasks", "takes at most 1000 tasks");
  }

  /// Numbers of things, and ids that are unique among all of them.
  void check(YamlReader& r) const {
    if (r.has("vehicles") && value.vehicles.empty()) r.reject("vehicles", "names no vehicle");
    if (value.vehicles.size() > kMostVehicles) r.reject("vehicles", "names more than 100 vehicles");

    std::set<std::string> ids;
    const auto take = [&](const char* key, const std::string& id) {
      if (!ids.insert(id).second) r.reject(key, "'" + id + "' names two things; ids are unique in a scenario");
    };

    for (const VehicleSetup& vehicle : value.vehicles) take("vehicles", vehicle.id);
    if (ids.count(fleet::kAnyVehicle) > 0) r.reject("vehicles", "'any' is every vehicle; give this one another id");
    for (const NamedPlace& place : value.places) take("places", place.name);
    check_missions();
    for (const Mover& mover : value.movers) take("movers", mover.id);
    for (const Block& block : value.blocks) take("blocks", block.id);
  }

  /// Each names a vehicle of the file, at most one for each vehicle.
  void check_missions() const {
    std::set<std::string> known;
    for (const VehicleSetup& vehicle : value.vehicles) known.insert(vehicle.id);

    std::set<std::string> with_mission;
    for (const MissionEntry& mission : missions) {
      const std::string& id = mission.value.vehicle;
      if (id == fleet::kAnyVehicle) continue;
      if (known.count(id) == 0) throw config::BadInput(mission.where + ": no vehicle '" + id + "' in vehicles");
      if (!with_mission.insert(id).second)
        throw config::BadInput(mission.where + ": '" + id + "' has a mission already; list its goals in one");
    }
  }
};

/// The zones beside the map, and those of the scenario. @throws config::BadInput when an id is in both, or they are
/// more than a map may have
std::vector<fleet::Zone> joined(std::vector<fleet::Zone> of_map, std::vector<fleet::Zone> of_scenario,
                                const std::filesystem::path& file) {
  for (fleet::Zone& zone : of_scenario) {
    const auto has_its_id = [&zone](const fleet::Zone& other) { return other.id == zone.id; };
    if (std::any_of(of_map.begin(), of_map.end(), has_its_id)) {
      throw config::BadInput(file.string() + ": zones: '" + zone.id +
                             "' is also in the file of zones beside the map; give each its own id");
    }

    of_map.push_back(std::move(zone));
  }

  if (of_map.size() > fleet::kMostZones) {
    throw config::BadInput(file.string() + ": zones: with those beside the map they are " +
                           std::to_string(of_map.size()) + "; a map may have " + std::to_string(fleet::kMostZones));
  }

  return of_map;
}

}  // namespace

kinematics::Model VehicleSetup::kinematic_model() const {
  return find_model(model).value_or(kinematics::Model::kDifferential);
}

int Scenario::goal_count() const {
  std::size_t sum = 0;
  for (const Mission& mission : missions) sum += mission.goals_in_map.size() * static_cast<std::size_t>(mission.loops);
  for (const Task& task : tasks) sum += task.stops_in_map.size();
  return static_cast<int>(sum);
}

/// Paths are resolved when everything else is known to be right.
Scenario read_scenario(const std::filesystem::path& file) {
  ScenarioFile read;
  config::read_yaml_file(file, read);

  Scenario scenario = std::move(read.value);
  if (scenario.name.empty()) scenario.name = file.stem().string();
  scenario.map_file = find_named_file(read.map, file);
  scenario.zones = joined(read_zones_beside(scenario.map_file), std::move(scenario.zones), file);

  for (std::size_t i = 0; i < scenario.recordings.size(); ++i) {
    scenario.recordings[i].file = find_named_file(read.recordings[i].file, file);
  }

  return scenario;
}

}  // namespace aisle::scenario
