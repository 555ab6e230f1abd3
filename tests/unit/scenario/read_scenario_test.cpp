#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "common/config/reader.hpp"
#include "common/scenario/scenario.hpp"

namespace aisle::scenario {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

/// A tree `top/deploy/scenarios/x.yaml` with `top/../shared/data`, in a folder of its own.
class ReadScenario : public ::testing::Test {
 protected:
  ReadScenario() {
    root_ = fs::temp_directory_path() / ("aisle-scenario-" + std::to_string(getpid()) +
                                         ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(root_ / "top/deploy/scenarios");
    fs::create_directories(root_ / "shared/data/ros");
    touch("top/deploy/scenarios/room.txt");
    unsetenv("AISLE_DATA");
  }
  ~ReadScenario() override {
    unsetenv("AISLE_DATA");
    fs::remove_all(root_);
  }

  void touch(const std::string& name) { std::ofstream(root_ / name) << "#"; }
  Scenario read(const std::string& text) {
    const fs::path file = root_ / "top/deploy/scenarios/x.yaml";
    std::ofstream(file) << text;
    return read_scenario(file);
  }
  std::string refusal(const std::string& text) {
    try {
      read(text);
    } catch (const config::BadInput& error) {
      return error.what();
    }
    return "nothing was refused";
  }

  fs::path root_;
};

const std::string kOneVehicle = "map: room.txt\nvehicles: [{id: agv-1, start: [1, 2, 0.5]}]\n";

TEST_F(ReadScenario, FillsEveryPart) {
  const Scenario s = read(R"(name: yard
map: room.txt
subdivide: 4
moving_ai_cell_m: 2.0
seed: 7
duration_s: 90
start_jitter_m: 0.1
vehicles:
  - {id: agv-1, start: [1, 2, 1.5], radius_m: 0.3, max_speed_mps: 1.0}
  - {id: agv-2, start: [3, 4]}
missions:
  - {vehicle: agv-2, goals: [[5, 6], [7, 8, -1.5]], loops: 3, heading_matters: true}
movers:
  - {id: walker, radius_m: 0.2, speed_mps: 1.1, start_s: 2, loop: false, courteous: false, waypoints: [[0, 0], [1, 1]]}
blocks:
  - {id: box, center: [9, 9, 0.1], length_m: 1.0, width_m: 0.5, appear_s: 4}
map_edits:
  - {at_s: 20, action: unblock, low: [1, 1], high: [2, 3]}
)");
  EXPECT_EQ(s.name, "yard");
  EXPECT_EQ(s.map_file, root_ / "top/deploy/scenarios/room.txt");
  EXPECT_EQ(s.map_options.subdivide, 4);
  EXPECT_EQ(s.seed, 7u);
  ASSERT_EQ(s.vehicles.size(), 2u);
  EXPECT_DOUBLE_EQ(s.vehicles[0].start_in_map.yaw, 1.5);
  EXPECT_DOUBLE_EQ(s.vehicles[0].radius_m, 0.3);
  EXPECT_DOUBLE_EQ(s.vehicles[1].radius_m, 0.35);
  ASSERT_EQ(s.missions.size(), 1u);
  ASSERT_EQ(s.missions[0].goals_in_map.size(), 2u);
  EXPECT_DOUBLE_EQ(s.missions[0].goals_in_map[1].yaw, -1.5);
  EXPECT_EQ(s.missions[0].loops, 3);
  EXPECT_TRUE(s.missions[0].heading_matters);
  ASSERT_EQ(s.movers.size(), 1u);
  EXPECT_FALSE(s.movers[0].courteous);
  EXPECT_EQ(s.movers[0].waypoints_in_map.size(), 2u);
  ASSERT_EQ(s.blocks.size(), 1u);
  EXPECT_DOUBLE_EQ(s.blocks[0].appear_s, 4.0);
  ASSERT_EQ(s.map_edits.size(), 1u);
  EXPECT_FALSE(s.map_edits[0].block);
  EXPECT_DOUBLE_EQ(s.map_edits[0].high_in_map.y, 3.0);
}

TEST_F(ReadScenario, ReadsWorkForAnyVehicle) {
  const Scenario s = read(kOneVehicle + R"(
missions:
  - {vehicle: any, goals: [[1, 1], [2, 2]], loops: 2, heading_matters: true}
tasks:
  - {pick: [3, 3], drop: [4, 4, 1.5]}
places:
  - {name: dock, at: [5, 6, 0.5]}
)");
  EXPECT_TRUE(s.missions.empty());
  ASSERT_EQ(s.tasks.size(), 5u);
  EXPECT_EQ(s.tasks[3].stops_in_map.size(), 1u);
  EXPECT_TRUE(s.tasks[3].heading_matters);
  EXPECT_DOUBLE_EQ(s.tasks[3].stops_in_map[0].x, 2.0);
  ASSERT_EQ(s.tasks[4].stops_in_map.size(), 2u);
  EXPECT_DOUBLE_EQ(s.tasks[4].stops_in_map[1].yaw, 1.5);
  EXPECT_EQ(s.goal_count(), 6);
  ASSERT_EQ(s.places.size(), 1u);
  EXPECT_EQ(s.places[0].name, "dock");
  EXPECT_TRUE(s.places[0].has_yaw);
}

TEST_F(ReadScenario, RefusesTasksThatAreNone) {
  EXPECT_THAT(refusal(kOneVehicle + "tasks: [{pick: [1, 1]}]\n"), HasSubstr("drop"));
  EXPECT_THAT(refusal(kOneVehicle + "places: [{name: p, at: [1, 1]}, {name: p, at: [2, 2]}]\n"),
              HasSubstr("'p' names two things"));
  EXPECT_THAT(refusal("map: room.txt\nvehicles: [{id: any, start: [1, 2]}]\n"), HasSubstr("'any' is every vehicle"));
}

TEST_F(ReadScenario, NamesItselfAfterTheFile) { EXPECT_EQ(read(kOneVehicle).name, "x"); }

TEST_F(ReadScenario, FindsDataBesideTheTree) {
  touch("shared/data/ros/depot.yaml");
  const Scenario s = read("map: data:ros/depot.yaml\nvehicles: [{id: a, start: [1, 2]}]\n");
  EXPECT_EQ(s.map_file, root_ / "shared/data/ros/depot.yaml");
}

TEST_F(ReadScenario, PrefersTheDataFolderThatIsSet) {
  touch("shared/data/ros/depot.yaml");
  fs::create_directories(root_ / "mine/ros");
  touch("mine/ros/depot.yaml");
  setenv("AISLE_DATA", (root_ / "mine").c_str(), 1);
  EXPECT_EQ(read("map: data:ros/depot.yaml\nvehicles: [{id: a, start: [1, 2]}]\n").map_file,
            root_ / "mine/ros/depot.yaml");
}

TEST_F(ReadScenario, SaysWhatToSetWhenDataIsMissing) {
  const std::string text = refusal("map: data:ros/nowhere.yaml\nvehicles: [{id: a, start: [1, 2]}]\n");
  EXPECT_THAT(text, HasSubstr("ros/nowhere.yaml"));
  EXPECT_THAT(text, HasSubstr("set AISLE_DATA"));
}

TEST_F(ReadScenario, DataPathsDoNotLeaveTheirFolder) {
  EXPECT_THAT(refusal("map: data:../../etc/passwd\nvehicles: [{id: a, start: [1, 2]}]\n"),
              HasSubstr("leaves the data folder"));
}

TEST_F(ReadScenario, RefusesAMissingMap) {
  EXPECT_THAT(refusal("map: nowhere.yaml\nvehicles: [{id: a, start: [1, 2]}]\n"), HasSubstr("nowhere.yaml"));
}

TEST_F(ReadScenario, RefusesMissionsOfStrangers) {
  EXPECT_THAT(refusal(kOneVehicle + "missions: [{vehicle: agv-9, goals: [[1, 1]]}]\n"),
              HasSubstr("no vehicle 'agv-9'"));
}

TEST_F(ReadScenario, ReadsAForklift) {
  const Scenario s = read(
      "map: room.txt\nvehicles: [{id: f, model: tricycle, start: [1, 2], length_m: 2.4, width_m: 1.1, ahead_m: 0.4, "
      "axle: {wheelbase_m: 1.4, is_rear: true}}]\n");
  const Vehicle& f = s.vehicles.at(0);
  EXPECT_EQ(f.kinematic_model(), kinematics::Model::kTricycle);
  EXPECT_FALSE(f.footprint().is_disc());
  EXPECT_DOUBLE_EQ(f.footprint().ahead_m, 0.4);
  EXPECT_DOUBLE_EQ(f.axle.wheelbase_m, 1.4);
  EXPECT_TRUE(f.axle.is_rear);
}

TEST_F(ReadScenario, RefusesVehiclesThatCannotBe) {
  const auto of = [&](const std::string& rest) {
    return refusal("map: room.txt\nvehicles: [{id: a, start: [1, 2], " + rest + "}]\n");
  };
  EXPECT_THAT(of("model: hovercraft"), HasSubstr("differential, omnidirectional or tricycle"));
  EXPECT_THAT(of("length_m: 2.0"), HasSubstr("both, length_m and width_m"));
  EXPECT_THAT(of("length_m: 2.0, width_m: 1.0, radius_m: 0.4"), HasSubstr("a rectangle has none"));
  EXPECT_THAT(of("axle: {wheelbase_m: 1.4}"), HasSubstr("only a tricycle"));
}

TEST_F(ReadScenario, RefusesTwoThingsOfOneName) {
  EXPECT_THAT(refusal("map: room.txt\nvehicles: [{id: a, start: [1, 2]}, {id: a, start: [3, 2]}]\n"),
              HasSubstr("'a' names two things"));
  EXPECT_THAT(refusal(kOneVehicle + "blocks: [{id: agv-1, center: [1, 1]}]\n"), HasSubstr("'agv-1' names two things"));
}

TEST_F(ReadScenario, RefusesTwoMissionsForOneVehicle) {
  EXPECT_THAT(
      refusal(kOneVehicle + "missions: [{vehicle: agv-1, goals: [[1, 1]]}, {vehicle: agv-1, goals: [[1, 1]]}]\n"),
      HasSubstr("has a mission already"));
}

TEST_F(ReadScenario, RefusesPosesOfTheWrongLength) {
  EXPECT_THAT(refusal("map: room.txt\nvehicles: [{id: a, start: [1]}]\n"), HasSubstr("[x, y, yaw]"));
  EXPECT_THAT(refusal("map: room.txt\nvehicles: [{id: a, start: [1, 2, 90]}]\n"), HasSubstr("radians"));
  EXPECT_THAT(refusal(kOneVehicle + "movers: [{id: m, waypoints: [[1, 1]]}]\n"), HasSubstr("two or more"));
}

TEST_F(ReadScenario, RefusesNumbersOutOfBounds) {
  EXPECT_THAT(refusal("map: room.txt\nvehicles: [{id: a, start: [1, 2], radius_m: -1}]\n"), HasSubstr("radius_m"));
  EXPECT_THAT(refusal(kOneVehicle + "map_edits: [{at_s: 1, low: [2, 2], high: [1, 3]}]\n"),
              HasSubstr("above and to the right"));
}

TEST_F(ReadScenario, NamesTheNearestKey) {
  EXPECT_THAT(refusal(kOneVehicle + "durations_s: 3\n"), HasSubstr("duration_s"));
}

}  // namespace
}  // namespace aisle::scenario
