#include "common/scenario/zone_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "common/scenario/scenario.hpp"

namespace aisle::scenario {
namespace {

namespace fs = std::filesystem;
using fleet::Zone;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// A folder with a map of one cell, room.txt.
class ZoneFile : public ::testing::Test {
 protected:
  ZoneFile() {
    folder_ = fs::temp_directory_path() / ("aisle-zones-" + std::to_string(getpid()) +
                                           ::testing::UnitTest::GetInstance()->current_test_info()->name());
    fs::create_directories(folder_);
    write("room.txt", "#");
  }
  ~ZoneFile() override { fs::remove_all(folder_); }

  fs::path write(const std::string& name, const std::string& text) {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  std::vector<Zone> read(const std::string& text) { return read_zone_file(write("z.yaml", text)); }

  /// What is said of a file with this one zone.
  std::string refusal(const std::string& zone) { return refusal_of_file("zones:\n  - {" + zone + "}\n"); }

  std::string refusal_of_file(const std::string& text) {
    try {
      read(text);
    } catch (const config::BadInput& error) {
      return error.what();
    }

    return "nothing was refused";
  }

  Scenario read_scenario_with(const std::string& zones) {
    return read_scenario(write("s.yaml", "map: room.txt\nvehicles: [{id: agv-1, start: [1, 2]}]\n" + zones));
  }

  fs::path folder_;
};

const char* const kEveryKind = R"(zones:
  - {id: office, kind: keep-out, rectangle: [1, 2, 4, 5.5]}
  - {id: bend, kind: speed, max_speed_mps: 0.4, polygon: [[0, 0], [4, 0], [2, 3]]}
  - {id: lane, kind: one-way, direction_rad: 1.57, rectangle: [0.1, 0, 2, 9]}
  - {id: crossing, kind: no-stopping, disc: [4, 2.5, 0.6]}
  - {id: dock, kind: one-vehicle, rectangle: [7, 7, 9, 9]}
  - {id: "7", kind: parking, rectangle: [-3, -3, -1, -1]}
)";

TEST_F(ZoneFile, ReadsEachKindAndShape) {
  const std::vector<Zone> zones = read(kEveryKind);
  ASSERT_EQ(zones.size(), 6U);

  EXPECT_EQ(zones[0], (Zone{"office", Zone::Kind::kKeepOut, Zone::Shape::kRectangle, {{1.0, 2.0}, {4.0, 5.5}}}));
  EXPECT_EQ(zones[1],
            (Zone{"bend", Zone::Kind::kSpeed, Zone::Shape::kPolygon, {{0.0, 0.0}, {4.0, 0.0}, {2.0, 3.0}}, 0.0, 0.4}));
  EXPECT_EQ(zones[2],
            (Zone{"lane", Zone::Kind::kOneWay, Zone::Shape::kRectangle, {{0.1, 0.0}, {2.0, 9.0}}, 0.0, 0.0, 1.57}));
  EXPECT_EQ(zones[3], (Zone{"crossing", Zone::Kind::kNoStopping, Zone::Shape::kDisc, {{4.0, 2.5}}, 0.6}));
  EXPECT_EQ(zones[4].kind, Zone::Kind::kOneVehicle);
  EXPECT_EQ(zones[5].kind, Zone::Kind::kParking);
  EXPECT_EQ(zones[5].id, "7");
}

TEST_F(ZoneFile, WhatIsWrittenIsReadAgain) {
  const std::vector<Zone> zones = read(kEveryKind);

  EXPECT_EQ(read(text_of_zones(zones)), zones);
  EXPECT_THAT(read(text_of_zones({})), IsEmpty());
}

TEST_F(ZoneFile, RefusalsNameLineKeyAndLimit) {
  EXPECT_THAT(refusal("id: a, kind: fast, disc: [1, 1, 1]"), HasSubstr("z.yaml:2: zones[0].kind: 'fast' is no kind"));
  EXPECT_THAT(refusal("id: a, kind: parking"), HasSubstr("takes one shape"));
  EXPECT_THAT(refusal("id: a, kind: parking, disc: [1, 1, 1], rectangle: [0, 0, 1, 1]"), HasSubstr("takes one shape"));
  EXPECT_THAT(refusal("id: a, kind: parking, disc: [1, 1]"), HasSubstr("disc: takes [x, y, radius]"));
  EXPECT_THAT(refusal("id: a, kind: parking, disc: [1, 1, 0]"), HasSubstr("disc: radius_m = 0 is not above 0"));
  EXPECT_THAT(refusal("id: a, kind: parking, rectangle: [1, 1, 1, 2]"), HasSubstr("rectangle: points: the rectangle"));
  EXPECT_THAT(refusal("id: a, kind: parking, polygon: [[0, 0], [1, 1]]"), HasSubstr("a polygon has 3 to 64 corners"));
  EXPECT_THAT(refusal("id: a b, kind: parking, disc: [1, 1, 1]"), HasSubstr("id: zone_id: use 1 to 60"));
  EXPECT_THAT(refusal("id: a, kind: speed, disc: [1, 1, 1]"), HasSubstr("max_speed_mps"));
  EXPECT_THAT(refusal("id: a, kind: speed, max_speed_mps: 11, disc: [1, 1, 1]"), HasSubstr("within 0.05 and 10"));
  EXPECT_THAT(refusal("id: a, kind: one-way, disc: [1, 1, 1]"), HasSubstr("direction_rad"));
  EXPECT_THAT(refusal("id: a, kind: parking, max_speed_mps: 1, disc: [1, 1, 1]"), HasSubstr("only a speed zone"));
  EXPECT_THAT(refusal("id: a, kind: parking, radius: 1, disc: [1, 1, 1]"), HasSubstr("radius"));
  EXPECT_THAT(refusal_of_file("zone: []\n"), HasSubstr("zone"));
}

TEST_F(ZoneFile, IdsAreUniqueAndZonesAreLimited) {
  const std::string twice = "  - {id: a, kind: parking, disc: [1, 1, 1]}\n";
  EXPECT_THAT(refusal_of_file("zones:\n" + twice + twice), HasSubstr("z.yaml:3: zones[1].id: 'a' names two zones"));

  std::string many = "zones:\n";
  for (int i = 0; i < 257; ++i) many += "  - {id: z" + std::to_string(i) + ", kind: parking, disc: [1, 1, 1]}\n";
  EXPECT_THAT(refusal_of_file(many), HasSubstr("make 257 zones; a map may have 256"));
}

TEST_F(ZoneFile, AScenarioHasThoseBesideItsMapAndItsOwn) {
  EXPECT_THAT(read_scenario_with("").zones, IsEmpty());

  write("room.zones.yaml", "zones:\n  - {id: a, kind: parking, disc: [1, 1, 1]}\n");
  const Scenario scenario = read_scenario_with("zones:\n  - {id: b, kind: keep-out, disc: [2, 2, 1]}\n");

  ASSERT_EQ(scenario.zones.size(), 2U);
  EXPECT_EQ(scenario.zones[0].id, "a");
  EXPECT_EQ(scenario.zones[1].id, "b");
}

TEST_F(ZoneFile, AnIdBesideTheMapIsNotUsedAgainByItsScenario) {
  write("room.zones.yaml", "zones:\n  - {id: a, kind: parking, disc: [1, 1, 1]}\n");

  EXPECT_THROW(read_scenario_with("zones:\n  - {id: a, kind: keep-out, disc: [2, 2, 1]}\n"), config::BadInput);
}

}  // namespace
}  // namespace aisle::scenario
