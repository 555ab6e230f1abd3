// aisle drive as a program: the same seed drives the same trace; what is misspelt is named.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include <unistd.h>

#include "tests/support/child_process.hpp"

namespace aisle {
namespace {

using std::chrono::seconds;
using test_support::ChildProcess;
using ::testing::HasSubstr;

nlohmann::json drive(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {AISLE_CLI, "drive", "--truth", "--json"});
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
  for (const char* key : {"local", "global", "runs", "goals_assigned", "goals_reached", "contacts", "contacts_moving_vehicle", "least_clearance_m", "distance_m",
                          "time_s", "omega_sign_changes", "jerk_rms", "realtime_factor"}) {
    EXPECT_TRUE(once.contains(key)) << key;
  }
  EXPECT_EQ(once["goals_reached"], once["goals_assigned"]);
  EXPECT_EQ(once["contacts_moving_vehicle"], 0);
  EXPECT_GT(once["least_clearance_m"], 0.0);
}

TEST(Drive, TakesPlannersByNameAndDrawsThePicture) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / ("aisle-drive-" + std::to_string(getpid()) + ".svg");
  const nlohmann::json report = drive({"--scenario", "crossing", "--local", "qu", "--global", "astar", "--svg", file.string()});
  EXPECT_EQ(report["local"], "qu");
  EXPECT_EQ(report["global"], "astar");
  std::ifstream in(file);
  const std::string svg{std::istreambuf_iterator<char>(in), {}};
  std::filesystem::remove(file);
  EXPECT_THAT(svg, HasSubstr("<svg"));
  EXPECT_THAT(svg, HasSubstr("agv-4"));
}

TEST(Drive, NamesWhatIsMisspelt) {
  const auto refusal = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {AISLE_CLI, "drive"});
    ChildProcess aisle(arguments);
    EXPECT_EQ(aisle.wait(seconds(20)), 2);
    return aisle.err();
  };
  EXPECT_THAT(refusal({"--scenario", "crosing"}), HasSubstr("did you mean 'crossing'?"));
  EXPECT_THAT(refusal({"--scenario", "crossing", "--local", "weng"}), HasSubstr("did you mean 'wang'?"));
  EXPECT_THAT(refusal({"--scenario", "none.yaml"}), HasSubstr("none.yaml"));
  EXPECT_THAT(refusal({}), HasSubstr("--scenario is missing"));
}

}  // namespace
}  // namespace aisle
