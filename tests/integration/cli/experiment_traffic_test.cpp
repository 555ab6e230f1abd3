// aisle experiment traffic as a program: what it prints, and what it refuses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/child_process.hpp"
#include "tests/support/places.hpp"

namespace aisle {
namespace {

using std::chrono::seconds;
using test_support::ChildProcess;
using ::testing::HasSubstr;

std::vector<std::string> command(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {test_support::program("aisle"), "experiment", "traffic"});
  return arguments;
}

TEST(TrafficExperiment, PrintsRatesBesideTheirBoundsAndDrawsThem) {
  const std::string map = (test_support::source_folder() / "deploy/maps/warehouse.yaml").string();
  const std::filesystem::path picture =
      std::filesystem::temp_directory_path() / ("aisle-traffic-" + std::to_string(getpid()) + ".svg");
  ChildProcess aisle(command({"--vehicles", "2", "120", "--seconds", "60", "--floor", "warehouse", "--map", map,
                              "--svg", picture.string(), "--json"}));
  EXPECT_EQ(aisle.wait(seconds(120)), 0) << aisle.err();
  EXPECT_TRUE(std::filesystem::remove(picture));

  const nlohmann::json rows = nlohmann::json::parse(aisle.out()).at("floors").at(0).at("rows");
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_GT(rows[0].at("bound").get<double>(), 0.0);
  EXPECT_GT(rows[0].at("reached").at("goals").get<int>(), 0);
  EXPECT_EQ(rows[0].at("reached").at("findings"), 0);
  EXPECT_EQ(rows[0].at("one_shot").at("goals"), 2);
  EXPECT_TRUE(rows[0].at("site").is_null()) << "only with --site";
  EXPECT_TRUE(rows[1].at("reached").is_null()) << "fleets of more than 100 are planned only";
  EXPECT_GT(rows[1].at("plans").at("planned").get<int>(), 100);
}

TEST(TrafficExperiment, RefusesInOneLine) {
  for (const std::vector<std::string>& arguments :
       {std::vector<std::string>{"--vehicles", "301"}, {"--vehicles", "five"}, {"--floor", "warehous"}}) {
    ChildProcess aisle(command(arguments));
    EXPECT_EQ(aisle.wait(seconds(20)), 2);
    EXPECT_EQ(std::count(aisle.err().begin(), aisle.err().end(), '\n'), 1) << aisle.err();
  }
}

}  // namespace
}  // namespace aisle
