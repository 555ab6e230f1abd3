// aisle plan as a program, offline: each wrong input ends with its own line on stderr and its own kind of exit code.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/child_process.hpp"
#include "tests/support/places.hpp"

namespace aisle {
namespace {

using std::chrono::seconds;
using test_support::ChildProcess;
using ::testing::HasSubstr;

constexpr int kDone = 0;
constexpr int kNegative = 1;
constexpr int kBadInput = 2;

/// Two rooms of cells of 1 m with a gap of one cell between them, and a closed chamber below.
const char* const kRooms =
    "............\n.......#....\n............\n.......#....\n.......#....\n############\n............\n";

class PlanOffline : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("aisle-plan-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    map_ = (folder_ / "rooms.txt").string();
    write("rooms.txt", kRooms);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return (folder_ / name).string();
  }

  /// What stands on stderr; a refusal is one line.
  static std::string refusal(int code, std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {test_support::program("aisle"), "plan"});
    ChildProcess aisle(arguments);
    EXPECT_EQ(aisle.wait(seconds(60)), code) << aisle.err();
    EXPECT_EQ(std::count(aisle.err().begin(), aisle.err().end(), '\n'), 1) << aisle.err();
    return aisle.err();
  }
  std::string refused(int code, const std::string& start, const std::string& goal,
                      const std::string& radius = "0") const {
    return refusal(code, {"--map", map_, "--start", start, "--goal", goal, "--radius", radius, "--planner", "direct"});
  }

  std::filesystem::path folder_;
  std::string map_;
};

TEST_F(PlanOffline, FindsAWayWithEveryPlannerAndSaysItsFigures) {
  ChildProcess aisle(
      {test_support::program("aisle"), "plan", "--map", map_, "--start", "1.5,5.5", "--goal", "10.5,3.5", "--json"});
  ASSERT_EQ(aisle.wait(seconds(60)), kDone) << aisle.err();
  const nlohmann::json report = nlohmann::json::parse(aisle.out());
  EXPECT_GE(report.size(), 14U);
  for (const nlohmann::json& row : report) {
    for (const char* key : {"planner", "asked", "solved", "checker_failures", "length_ratio_mean", "length_ratio_max",
                            "nodes_mean", "turning_points_mean", "turning_angle_mean_rad", "expanded_mean",
                            "time_us_p50", "time_us_p99", "least_clearance_m"}) {
      EXPECT_TRUE(row.contains(key)) << key;
    }
    EXPECT_EQ(row["solved"], 1) << row["planner"];
    EXPECT_EQ(row["checker_failures"], 0) << row["planner"];
  }
}

TEST_F(PlanOffline, SaysInOneLineWhatIsWrongWithTheQuestion) {
  EXPECT_THAT(refused(kNegative, "7.5,5.5", "1.5,1.5"), HasSubstr("start in obstacle: the start (7.50, 5.50)"));
  EXPECT_THAT(refused(kNegative, "1.5,5.5", "7.5,3.5"), HasSubstr("goal in obstacle: the goal (7.50, 3.50)"));
  EXPECT_THAT(refused(kNegative, "-1,5", "1.5,5.5"),
              HasSubstr("start out of map: the start (-1.00, 5.00) is outside the map, x 0.00 to 12.00"));
  EXPECT_THAT(refused(kNegative, "1.5,5.5", "1.5,900000"), HasSubstr("goal out of map"));
  EXPECT_THAT(refused(kNegative, "0.5,5.5", "10.5,3.5", "1.2"), HasSubstr("start too tight"));
  EXPECT_THAT(refused(kNegative, "3.5,4.5", "11.5,4.5", "1.2"), HasSubstr("goal too tight"));
  EXPECT_THAT(refused(kNegative, "3.5,4.5", "10.0,4.5", "0.6"),
              HasSubstr("too wide: no way from (3.50, 4.50) to (10.00, 4.50) for a radius of 0.60 m; the widest one "
                        "lets 0.50 m pass"));
  EXPECT_THAT(refused(kNegative, "3.5,4.5", "3.5,0.5"), HasSubstr("no way"));
}

TEST_F(PlanOffline, PlansForARectangle) {
  // Through the gap of one metre: a steered vehicle of 0.5 m width passes it, but is too long to turn on the spot
  // there.
  const auto report = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{test_support::program("aisle"),
                                       "plan",
                                       "--map",
                                       map_,
                                       "--start",
                                       "2,4.5,0",
                                       "--goal",
                                       "10,4.5,0",
                                       "--footprint",
                                       "1.6,0.5,0.3",
                                       "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    ChildProcess aisle(arguments);
    aisle.wait(seconds(60));
    return nlohmann::json::parse(aisle.out()).at(0);
  };
  const nlohmann::json steered = report({"--planner", "hybrid", "--turning-radius", "1"});
  EXPECT_EQ(steered["solved"], 1);
  EXPECT_EQ(steered["checker_failures"], 0);
  EXPECT_EQ(report({"--planner", "direct"})["solved"], 0);
}

TEST_F(PlanOffline, SaysInOneLineWhatIsWrongWithTheCommand) {
  EXPECT_THAT(refused(kBadInput, "nan,1", "1.5,5.5"), HasSubstr("--start: 'nan,1' is not a list of numbers"));
  EXPECT_THAT(refused(kBadInput, "1.5,5.5", "inf,2"), HasSubstr("--goal"));
  EXPECT_THAT(refused(kBadInput, "1.5,5.5", "1e7,2"), HasSubstr("farther than"));
  EXPECT_THAT(refused(kBadInput, "1.5", "1.5,5.5"), HasSubstr("--start: '1.5' has 1 numbers"));
  EXPECT_THAT(refused(kBadInput, "1.5,5.5", "1.5,4.5", "nan"), HasSubstr("--radius: nan is not a number"));
  EXPECT_THAT(refused(kBadInput, "1.5,5.5", "1.5,4.5", "1000"), HasSubstr("--radius: Value 1000 not in range"));
  EXPECT_THAT(refusal(kBadInput, {"--map", map_, "--start", "1.5,5.5", "--goal", "1.5,4.5", "--turning-radius", "nan"}),
              HasSubstr("--turning-radius: nan is not a number"));
  EXPECT_THAT(refusal(kBadInput, {"--map", map_, "--start", "1.5,5.5", "--goal", "1.5,4.5", "--planner", "xyz"}),
              HasSubstr("'xyz' is unknown. There are ant-colony, "));
  EXPECT_THAT(refusal(kBadInput, {"--map", map_, "--scen", write("rooms.scen", "version 1\n0 rooms 12 7 0 0 11 0 11\n"),
                                  "--turning-radius", "1"}),
              HasSubstr("needs headings"));
  EXPECT_THAT(refused(kBadInput, "1.5,5.5", "1.5,4.5", "-1"), HasSubstr("--radius"));
  EXPECT_THAT(refusal(kBadInput, {"--map", map_, "--start", "1.5,5.5", "--goal", "1.5,4.5", "--planner", "drect"}),
              HasSubstr("did you mean direct?"));
  EXPECT_THAT(refusal(kBadInput, {"--map", map_, "--start", "1.5,5.5", "--goal", "1.5,4.5", "--footprint", "1.6"}),
              HasSubstr("--footprint: '1.6' has 1 numbers"));
  EXPECT_THAT(refusal(kBadInput, {"--map", map_, "--start", "1.5,5.5", "--goal", "1.5,4.5", "--footprint", "1.6,1",
                                  "--radius", "1"}),
              HasSubstr("give one"));
  EXPECT_THAT(refusal(kBadInput, {"--start", "1.5,5.5", "--goal", "1.5,4.5"}), HasSubstr("--map"));
  EXPECT_THAT(refusal(kBadInput, {"--map", map_}), HasSubstr("--start"));
}

TEST_F(PlanOffline, SaysInOneLineWhatIsWrongWithTheMap) {
  const auto with_map = [&](const std::string& file) {
    return refusal(kBadInput, {"--map", file, "--start", "1.5,5.5", "--goal", "1.5,4.5"});
  };
  EXPECT_THAT(with_map((folder_ / "none.yaml").string()), HasSubstr("none.yaml"));
  EXPECT_THAT(with_map(write("huge.map", "type octile\nheight 900000\nwidth 900000\nmap\n....\n")),
              HasSubstr("huge.map"));
  const std::string huge = write("huge.pgm", "P5\n900000 900000\n255\n");
  EXPECT_THAT(with_map(write("huge.yaml",
                             "image: huge.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: "
                             "0.65\nfree_thresh: 0.196\n")),
              HasSubstr("900000 x 900000 cells; a map has at most"));
  EXPECT_THAT(with_map(write("odd.txt", "...\n..x\n")), HasSubstr("line 2, column 3"));
}

TEST_F(PlanOffline, TakesAnOwnMapParametersByNameAndWritesWhatMadeTheRows) {
  const std::string map = write("own.txt", "S....\n..#..\n....T\n");
  const std::string csv = (folder_ / "own.csv").string(), jsonl = (folder_ / "own.jsonl").string();
  const std::string file = write("own.yaml", "global:\n  wang: {log_base: 2}\nlocal:\n  wang: {alpha: 0.1}\n");
  ChildProcess aisle({test_support::program("aisle"), "plan", "--map", map, "--planner", "wang", "--set",
                      "wang.passes=none", "--parameters", file, "--csv", csv, "--jsonl", jsonl, "--json"});
  ASSERT_EQ(aisle.wait(seconds(60)), kDone) << aisle.err();
  EXPECT_EQ(nlohmann::json::parse(aisle.out())[0]["nodes_mean"], 6.0) << "from cell to cell";

  std::ifstream in(jsonl);
  std::string head;
  std::getline(in, head);
  const nlohmann::json made_by = nlohmann::json::parse(head)["head"];
  EXPECT_EQ(made_by["parameters"], "global.wang.log_base=2, global.wang.passes=none");
  for (const char* key : {"commit", "compiler", "flags", "vectors", "seed"}) EXPECT_TRUE(made_by.contains(key)) << key;
  EXPECT_TRUE(std::filesystem::exists(csv));
}

TEST_F(PlanOffline, NamesAParameterOrAMapThatDoesNotFit) {
  const std::string map = write("own.txt", "S....\n..#..\n....T\n");
  EXPECT_THAT(refusal(kBadInput, {"--map", map, "--planner", "wang", "--set", "wang.pases=none"}),
              HasSubstr("did you mean 'passes'?"));
  EXPECT_THAT(refusal(kBadInput, {"--map", map, "--planner", "wang", "--set", "yu.beta=0.2"}),
              HasSubstr("another global planner than is used here: wang"));
  EXPECT_THAT(refusal(kBadInput, {"--map", write("hall.png", "x"), "--start", "1,1", "--goal", "2,2"}),
              HasSubstr("give --resolution"));
}

}  // namespace
}  // namespace aisle
