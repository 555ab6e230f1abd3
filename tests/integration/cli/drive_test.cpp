// aisle drive as a program: the same seed drives the same trace; what is misspelt is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "tests/support/child_process.hpp"
#include "tests/support/places.hpp"

namespace aisle {
namespace {

using std::chrono::seconds;
using test_support::ChildProcess;
using ::testing::HasSubstr;

nlohmann::json drive(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {test_support::program("aisle"), "drive", "--truth", "--json"});
  ChildProcess aisle(arguments);
  EXPECT_EQ(aisle.wait(seconds(120)), 0) << aisle.err();
  return nlohmann::json::parse(aisle.out());
}

TEST(Drive, TheSameSeedDrivesTheSameTraceAndAnotherAnother) {
  const nlohmann::json once = drive({"--scenario", "crossing", "--seed", "3"});
  const nlohmann::json again = drive({"--scenario", "crossing", "--seed", "3"});
  const nlohmann::json other = drive({"--scenario", "crossing", "--seed", "4"});
  EXPECT_EQ(once["trace_hash"], again["trace_hash"]);
  EXPECT_NE(once["trace_hash"], other["trace_hash"]);
  for (const char* key :
       {"local", "global", "runs", "goals_assigned", "goals_reached", "contacts", "contacts_moving_vehicle",
        "least_clearance_m", "distance_m", "time_s", "omega_sign_changes", "jerk_rms", "realtime_factor"}) {
    EXPECT_TRUE(once.contains(key)) << key;
  }
  EXPECT_EQ(once["goals_reached"], once["goals_assigned"]);
  EXPECT_EQ(once["contacts_moving_vehicle"], 0);
  EXPECT_GT(once["least_clearance_m"], 0.0);
}

TEST(Drive, AFaultPlanIsRepeatedExactlyAndWhatWasDoneIsCounted) {
  const std::vector<std::string> arguments{"--scenario", "crossing", "--seed", "3", "--fault-seed", "2"};
  const nlohmann::json once = drive(arguments);
  const nlohmann::json again = drive(arguments);
  EXPECT_EQ(once["trace_hash"], again["trace_hash"]);
  EXPECT_EQ(once["faults"], again["faults"]);
  EXPECT_FALSE(once["faults"].empty());
  EXPECT_TRUE(once["violations"].empty());
  EXPECT_TRUE(drive({"--scenario", "crossing", "--seed", "3"})["faults"].is_object());
}

TEST(Drive, PrintsWhatCanBeSeenWhereATraceIsAskedFor) {
  ChildProcess aisle(
      {test_support::program("aisle"), "drive", "--truth", "--json", "--scenario", "crossing", "--trace", "1"});
  EXPECT_EQ(aisle.wait(seconds(120)), 0) << aisle.err();
  EXPECT_TRUE(nlohmann::json::accept(aisle.out())) << "the trace goes elsewhere";
  EXPECT_THAT(aisle.err(), HasSubstr(" agv-4 ("));
  EXPECT_THAT(aisle.err(), HasSubstr("driving/none"));
}

TEST(Suite, DrivesTheFamiliesAskedForAndPrintsOneOfEach) {
  ChildProcess aisle({test_support::program("aisle"), "experiment", "suite", "--local", "wu", "--family", "corridor",
                      "--family", "overtaking", "--runs", "1", "--json"});
  EXPECT_EQ(aisle.wait(seconds(120)), 0) << aisle.err();
  const nlohmann::json report = nlohmann::json::parse(aisle.out());
  EXPECT_EQ(report["local"], "wu");
  ASSERT_EQ(report["families"].size(), 2U);
  EXPECT_EQ(report["families"][1]["family"], "overtaking");
  EXPECT_TRUE(report["families"][0]["bad"].empty());
  EXPECT_EQ(report["all"]["goals_reached"], 2);
  EXPECT_EQ(report["all"]["contacts_moving_vehicle"], 0);
  EXPECT_GT(report["all"]["mean_time_s"], 10.0);
}

TEST(Suite, NamesTheNearestFamily) {
  ChildProcess aisle({test_support::program("aisle"), "experiment", "suite", "--family", "coridor"});
  EXPECT_EQ(aisle.wait(seconds(20)), 2);
  EXPECT_THAT(aisle.err(), HasSubstr("did you mean 'corridor'"));
}

TEST(Drive, TakesPlannersByNameAndDrawsThePicture) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("aisle-drive-" + std::to_string(getpid()) + ".svg");
  const nlohmann::json report =
      drive({"--scenario", "crossing", "--local", "qu", "--global", "astar", "--svg", file.string()});
  EXPECT_EQ(report["local"], "qu");
  EXPECT_EQ(report["global"], "astar");
  std::ifstream in(file);
  const std::string svg{std::istreambuf_iterator<char>(in), {}};
  std::filesystem::remove(file);
  EXPECT_THAT(svg, HasSubstr("<svg"));
  EXPECT_THAT(svg, HasSubstr("agv-4"));
}

struct Refusal {
  std::optional<int> code;
  std::string err;
};

Refusal refusal(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {test_support::program("aisle"), "drive"});
  ChildProcess aisle(arguments);
  const std::optional<int> code = aisle.wait(seconds(60));
  EXPECT_EQ(aisle.out(), "");
  EXPECT_EQ(std::count(aisle.err().begin(), aisle.err().end(), '\n'), 1) << aisle.err();
  return {code, aisle.err()};
}

TEST(Drive, NamesWhatIsMisspelt) {
  const auto bad_input = [](const std::vector<std::string>& arguments) {
    const Refusal refused = refusal(arguments);
    EXPECT_EQ(refused.code, 2);
    return refused.err;
  };
  EXPECT_THAT(bad_input({"--scenario", "crosing"}), HasSubstr("did you mean 'crossing'?"));
  EXPECT_THAT(bad_input({"--scenario", "crossing", "--local", "weng"}), HasSubstr("did you mean 'wang'?"));
  EXPECT_THAT(bad_input({"--scenario", "none.yaml"}), HasSubstr("none.yaml"));
  EXPECT_THAT(bad_input({}), HasSubstr("--scenario is missing"));
  EXPECT_THAT(bad_input({"--scenario", "crossing", "--seed", "-1"}), HasSubstr("--seed"));
  EXPECT_THAT(bad_input({"--scenario", "crossing", "--runs", "0"}), HasSubstr("--runs"));
  EXPECT_THAT(bad_input({"--scenario", "crossing", "--faults", "none.yaml"}), HasSubstr("none.yaml"));
  EXPECT_THAT(bad_input({"--scenario", "crossing", "--set", "wang.alhpa=1"}), HasSubstr("did you mean 'alpha'?"));
  EXPECT_THAT(bad_input({"--scenario", "crossing", "--set", "wang.max_speed_mps=1"}), HasSubstr("--paper-limits"));
  EXPECT_THAT(bad_input({"--scenario", "crossing", "--map", "hall.png"}), HasSubstr("give one of them"));
  EXPECT_THAT(bad_input({"--map", "hall.png"}), HasSubstr("hall.png"));
  EXPECT_THAT(bad_input({"--as-printed"}), HasSubstr("--as-printed needs --map FILE"));
}

TEST(Drive, RefusesFlagsThatWouldNotCount) {
  for (const char* flag : {"--start", "--goal", "--scen", "--resolution", "--limit", "--radius"}) {
    const Refusal refused = refusal({"--scenario", "crossing", flag, "1"});
    EXPECT_EQ(refused.code, 2) << flag;
    EXPECT_THAT(refused.err, HasSubstr(std::string(flag) + ": counts with --map only"));
  }

  const std::vector<std::string> as_printed{"--map", "hall.txt", "--as-printed"};
  for (const std::vector<std::string>& flag : std::vector<std::vector<std::string>>{
           {"--truth"}, {"--paper-limits"}, {"--only-scans-of", "agv-1"}, {"--radius", "1"}}) {
    std::vector<std::string> arguments = as_printed;
    arguments.insert(arguments.end(), flag.begin(), flag.end());
    const Refusal refused = refusal(arguments);
    EXPECT_EQ(refused.code, 2) << flag.front();
    EXPECT_THAT(refused.err, HasSubstr(flag.front() + ": does not count with --as-printed"));
  }
}

TEST(Drive, GoesOverAnOwnMapWithParametersByName) {
  const std::string map = "/tmp/aisle-own-map-" + std::to_string(getpid()) + ".txt";
  std::ofstream(map) << "........\n.S......\n....#...\n....#.T.\n........\n";
  const nlohmann::json plain = drive({"--map", map, "--global", "astar"});
  const nlohmann::json other = drive({"--map", map, "--global", "astar", "--set", "wang.alpha=0.5"});
  std::filesystem::remove(map);
  EXPECT_EQ(plain["goals_reached"], 1);
  EXPECT_NE(plain["trace_hash"], other["trace_hash"]) << "another weight drives otherwise";
}

TEST(Drive, APictureThatCannotBeWrittenIsRefusedBeforeTheRun) {
  for (const std::string file : {"/no-such-folder/drive.svg", "/tmp"}) {
    const Refusal refused = refusal({"--scenario", "none.yaml", "--svg", file});  // not even read
    EXPECT_EQ(refused.code, 3);
    EXPECT_THAT(refused.err, HasSubstr(file + ": cannot be written"));
  }
}

TEST(Drive, AnExperimentsPageThatCannotBeWrittenIsRefusedBeforeTheDrives) {
  ChildProcess aisle({test_support::program("aisle"), "experiment", "local", "--maps", "/no-such-folder", "--page",
                      "/dev/null/page.md"});
  EXPECT_EQ(aisle.wait(seconds(60)), 3);
  EXPECT_THAT(aisle.err(), HasSubstr("/dev/null/"));
}

TEST(Drive, AFullDiskBehindStdoutIsNoSuccess) {
  ChildProcess aisle(
      {"/bin/sh", "-c", test_support::program("aisle") + " drive --truth --scenario crossing > /dev/full"});
  EXPECT_EQ(aisle.wait(seconds(60)), 3);
  EXPECT_THAT(aisle.err(), HasSubstr("stdout cannot be written"));
}

/// A scenario of one vehicle in the room, beside the test's other files.
class OwnScenario {
 public:
  OwnScenario(const std::string& vehicle, const std::string& goal)
      : file_(std::filesystem::temp_directory_path() / ("aisle-own-" + std::to_string(getpid()) + ".yml")) {
    std::ofstream(file_) << "map: " << test_support::source_folder().string()
                         << "/deploy/maps/room.txt\nmoving_ai_cell_m: 0.5\nduration_s: 5\nvehicles: [" << vehicle
                         << "]\n"
                         << "missions: [{vehicle: agv-1, goals: [" << goal << "]}]\n";
  }
  ~OwnScenario() { std::filesystem::remove(file_); }
  std::string file() const { return file_.string(); }

 private:
  std::filesystem::path file_;
};

TEST(Drive, NobodyStartsInAWallOutsideOrInAnother) {
  const auto err_of = [](const std::string& vehicle) {
    const OwnScenario scenario(vehicle, "[8.0, 5.0]");
    const Refusal refused = refusal({"--scenario", scenario.file()});
    EXPECT_EQ(refused.code, 2);
    return refused.err;
  };
  EXPECT_THAT(err_of("{id: agv-1, start: [0.6, 5.0]}"),
              HasSubstr("agv-1 starts at (0.60, 5.00), where its outline is in a wall"));
  EXPECT_THAT(err_of("{id: agv-1, start: [4.0, 5.0], length_m: 9.0, width_m: 1.0}"),
              HasSubstr("where its outline is in a wall"));
  EXPECT_THAT(err_of("{id: agv-1, start: [99.0, 5.0]}"), HasSubstr("outside the map"));
  EXPECT_THAT(err_of("{id: agv-1, start: [4.0, 5.0]}, {id: agv-2, start: [4.5, 5.0]}"),
              HasSubstr("agv-2 starts at (4.50, 5.00), where its outline touches that of agv-1"));
}

TEST(Drive, AGoalThatCannotBeReachedIsMissedWithItsReason) {
  const OwnScenario scenario("{id: agv-1, start: [4.0, 5.0]}", "[0.1, 0.1]");
  ChildProcess aisle({test_support::program("aisle"), "drive", "--json", "--scenario", scenario.file()});
  EXPECT_EQ(aisle.wait(seconds(60)), 1);
  EXPECT_THAT(aisle.err(), HasSubstr("the goal (0.10, 0.10) has 0.00 m of clearance"));
  const nlohmann::json report = nlohmann::json::parse(aisle.out());
  EXPECT_EQ(report["goals_reached"], 0);
  ASSERT_EQ(report["goals_failed"].size(), 1u);
  EXPECT_EQ(report["goals_failed"][0]["agv"], "agv-1");
  EXPECT_TRUE(report["least_clearance_m"].is_null()) << "it never moved";
}

TEST(Drive, SaysWhatFaultsDid) {
  ChildProcess aisle(
      {test_support::program("aisle"), "drive", "--truth", "--scenario", "crossing", "--fault-seed", "3"});
  EXPECT_TRUE(aisle.wait(seconds(120))) << aisle.err();
  EXPECT_THAT(aisle.out(), HasSubstr("faults: "));
}

TEST(Drive, TellsHowFarItIsAndEndsWhenAsked) {
  ChildProcess aisle({test_support::program("aisle"), "drive", "--scenario", "warehouse", "--runs", "100000"});
  ASSERT_TRUE(aisle.wait_for_output("of 100000: ", seconds(60))) << aisle.err();
  aisle.signal(SIGINT);
  EXPECT_EQ(aisle.wait(seconds(60)), 1) << aisle.err();
  EXPECT_THAT(aisle.err(), HasSubstr("stopped after"));
}

}  // namespace
}  // namespace aisle
