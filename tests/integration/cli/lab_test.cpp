// aisle lab as a program: names the papers' tables and makes them again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "tests/support/child_process.hpp"
#include "tests/support/places.hpp"

namespace aisle {
namespace {

using std::chrono::seconds;
using test_support::ChildProcess;
using ::testing::HasSubstr;

ChildProcess lab(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {test_support::program("aisle"), "lab"});
  return ChildProcess(arguments);
}

TEST(Lab, NamesTablesOfEachPaper) {
  ChildProcess aisle = lab({"list", "--json"});
  ASSERT_EQ(aisle.wait(seconds(60)), 0) << aisle.err();
  std::set<std::string> papers;
  for (const auto& table : nlohmann::json::parse(aisle.out())) {
    const auto name = table["table"].get<std::string>();
    papers.insert(name.substr(0, name.find(' ')));
    EXPECT_GT(table["rows"].get<int>(), 0) << name;
  }
  EXPECT_EQ(papers, (std::set<std::string>{"LI", "QU", "WANG", "WU", "YU"}));
}

TEST(Lab, MakesATableAgainWithAVerdictARow) {
  ChildProcess aisle = lab({"reproduce", "wang-1", "--maps", "5", "--seed", "2", "--json"});
  ASSERT_EQ(aisle.wait(seconds(120)), 0) << aisle.err();
  const nlohmann::json rows = nlohmann::json::parse(aisle.out());
  ASSERT_EQ(rows.size(), 9U);
  for (const auto& row : rows) {
    EXPECT_EQ(row["table"], "WANG 1");
    EXPECT_EQ(row["seed"], 2);
    EXPECT_EQ(row["n"], 5);
    EXPECT_EQ(row["interval95"].size(), 2U);
    EXPECT_FALSE(row["commit"].get<std::string>().empty());
    EXPECT_THAT(row["verdict"].get<std::string>(), HasSubstr(" direction"));
  }
}

TEST(Lab, SaysWhichTableMayBeMeant) {
  ChildProcess aisle = lab({"reproduce", "wnag-1"});
  EXPECT_EQ(aisle.wait(seconds(60)), 2);
  EXPECT_THAT(aisle.err(), HasSubstr("did you mean wang-1?"));
  EXPECT_EQ(std::count(aisle.err().begin(), aisle.err().end(), '\n'), 1) << aisle.err();
}

TEST(Lab, ListsTheParametersOfAPlanner) {
  ChildProcess aisle = lab({"parameters", "wang", "--json"});
  ASSERT_EQ(aisle.wait(seconds(60)), 0) << aisle.err();
  std::set<std::string> names;
  for (const auto& it : nlohmann::json::parse(aisle.out())) {
    names.insert(it["parameter"].get<std::string>());
    EXPECT_FALSE(it["range"].get<std::string>().empty());
  }
  EXPECT_EQ(names.count("local.wang.alpha"), 1U);
  EXPECT_EQ(names.count("global.wang.passes"), 1U);
}

TEST(Lab, ASweepRefusesFlagsThatWouldNotCount) {
  for (const std::vector<std::string>& flag : std::vector<std::vector<std::string>>{
           {"--start", "1,1"}, {"--resolution", "0.1"}, {"--local", "wu"}, {"--vehicle-radius", "1"}}) {
    std::vector<std::string> arguments{"sweep", "--kind", "wang-1", "--planner", "wang"};
    arguments.insert(arguments.end(), flag.begin(), flag.end());
    ChildProcess aisle = lab(arguments);
    EXPECT_EQ(aisle.wait(seconds(60)), 2) << flag.front();
    EXPECT_THAT(aisle.err(), HasSubstr(flag.front() + ": counts with --"));
  }
}

TEST(Lab, ASweepIsNotMadeTwice) {
  const std::string folder = "/tmp/aisle-sweep-test-" + std::to_string(getpid());
  const std::vector<std::string> arguments{
      "sweep",   "--kind", "wang-1", "--planner", "wang",  "astar", "--vary", "wang.passes=none/collinear",
      "--seeds", "1-3",    "--out",  folder,      "--json"};
  ChildProcess first = lab(arguments);
  ASSERT_EQ(first.wait(seconds(60)), 0) << first.err();
  ChildProcess second = lab(arguments);
  ASSERT_EQ(second.wait(seconds(60)), 0) << second.err();
  EXPECT_EQ(nlohmann::json::parse(first.out()).size(), 9U);
  EXPECT_EQ(first.out(), second.out()) << "with the times of the first";
  std::filesystem::remove_all(folder);
}

/// Does the first signal end the program while it works? It has begun once it tells what it does.
void expect_ended_by(int signal, const std::vector<std::string>& arguments) {
  std::vector<std::string> command{test_support::program("aisle")};
  command.insert(command.end(), arguments.begin(), arguments.end());
  ChildProcess aisle(command);
  ASSERT_TRUE(aisle.wait_for_output("\n", seconds(60))) << aisle.err();
  aisle.signal(signal);
  EXPECT_EQ(aisle.wait(seconds(5)), 128 + signal) << arguments[0] << ' ' << arguments[1] << ": " << aisle.err();
}

TEST(Lab, IsEndedByTheFirstSignalWhileItMeasures) {
  const std::filesystem::path page = "/tmp/aisle-page-test-" + std::to_string(getpid()) + ".md";
  const std::string maps = (test_support::source_folder() / "deploy/experiments").string();
  expect_ended_by(SIGTERM, {"experiment", "all", "--maps", maps, "--page", page.string()});
  expect_ended_by(SIGINT, {"experiment", "papers", "--maps", maps, "--page", page.string()});
  EXPECT_FALSE(std::filesystem::exists(page)) << "not finished";

  expect_ended_by(SIGTERM, {"lab", "reproduce", "all"});
  expect_ended_by(SIGINT, {"lab", "compare", "all", "--planners", "astar theta"});
}

}  // namespace
}  // namespace aisle
