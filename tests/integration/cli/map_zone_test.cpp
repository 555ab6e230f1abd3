// aisle map zone, and aisle map save, beside a map service that runs.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/child_process.hpp"
#include "tests/support/places.hpp"

namespace {

using aisle::test_support::ChildProcess;
using nlohmann::json;
using std::chrono::seconds;
using ::testing::AllOf;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr const char* kDomain = "183";

struct Outcome {
  int code;
  std::string out;
  std::string err;
};

/// A folder with a map and its zones, served.
class MapZone : public ::testing::Test {
 protected:
  MapZone() {
    fs::create_directories(folder_);
    std::ofstream map(folder_ / "hall.txt");
    for (int row = 0; row < 20; ++row) map << std::string(30, row % 7 == 3 ? '#' : '.') << '\n';
    std::ofstream(folder_ / "hall.zones.yaml") << "zones:\n  - {id: office, kind: keep-out, rectangle: [1, 2, 4, 5]}\n";
  }
  ~MapZone() override { fs::remove_all(folder_); }

  ChildProcess serve() const {
    return ChildProcess({aisle::test_support::program("aisle-map"), "--map", (folder_ / "hall.txt").string(),
                         "--domain", kDomain, "--interface", "127.0.0.1"});
  }

  static Outcome run(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), aisle::test_support::program("aisle"));
    arguments.insert(arguments.end(), {"--domain", kDomain, "--interface", "127.0.0.1"});
    ChildProcess aisle(arguments);
    const int code = aisle.wait(seconds(60)).value_or(-1);
    return {code, aisle.out(), aisle.err()};
  }

  std::string text_of(const std::string& name) const {
    std::ifstream in(folder_ / name);
    return {std::istreambuf_iterator<char>(in), {}};
  }

  fs::path folder_{fs::temp_directory_path() / ("aisle-cli-zones-" + std::to_string(getpid()))};
};

TEST_F(MapZone, IsListedAddedRemovedDrawnAndSaved) {
  ChildProcess map = serve();
  const Outcome listed = run({"map", "zone", "list", "--timeout", "20"});
  EXPECT_EQ(listed.code, 0) << listed.err << map.err();
  EXPECT_EQ(listed.out, "ZONE    KIND      RULE  WHERE_M\noffice  keep-out  -     1,2 to 4,5\n");

  const Outcome added = run({"map", "zone", "add", "bend", "speed", "--disc", "8,6,2.5", "--speed", "0.4"});
  EXPECT_EQ(added.code, 0) << added.err;
  EXPECT_THAT(added.out, AllOf(HasSubstr("applied: zone bend is added"), HasSubstr("the map is at revision")));

  const Outcome again = run({"map", "zone", "add", "bend", "parking", "--rect", "0,0,1,1", "--json"});
  EXPECT_EQ(again.code, 1);
  EXPECT_EQ(json::parse(again.out)["outcome"], "refused");

  EXPECT_EQ(run({"map", "zone", "add", "lane", "one-way", "--rect", "-1,0,2,9", "--direction", "-1.5"}).code, 0);
  EXPECT_EQ(run({"map", "zone", "remove", "office"}).code, 0);
  const Outcome gone = run({"map", "zone", "remove", "office"});
  EXPECT_EQ(gone.code, 1);
  EXPECT_THAT(gone.err, HasSubstr("refused: no zone 'office' on this map"));

  const std::string svg = (folder_ / "zones.svg").string();
  const json zones = json::parse(run({"map", "zone", "list", "--json", "--svg", svg}).out)["zones"];
  ASSERT_EQ(zones.size(), 2U);
  EXPECT_EQ(zones[0]["zone_id"], "bend");
  EXPECT_EQ(zones[0]["kind"], "speed");
  EXPECT_EQ(zones[0]["max_speed_mps"], 0.4);
  EXPECT_EQ(zones[1]["direction_rad"], -1.5);
  EXPECT_THAT(text_of("zones.svg"), HasSubstr("bend, 0.4 m/s"));

  // What is saved can be served again.
  ASSERT_EQ(run({"map", "save", (folder_ / "saved.yaml").string()}).code, 0);
  EXPECT_THAT(text_of("saved.zones.yaml"),
              AllOf(HasSubstr("{id: \"bend\", kind: speed, max_speed_mps: 0.4, disc: [8, 6, 2.5]}"),
                    HasSubstr("{id: \"lane\", kind: one-way, direction_rad: -1.5, rectangle: [-1, 0, 2, 9]}")));
}

TEST_F(MapZone, OfAScenarioNeedsNoSite) {
  const fs::path scenario = folder_ / "s.yaml";
  std::ofstream(scenario) << "map: hall.txt\nvehicles: [{id: agv-1, start: [1, 1]}]\n"
                             "zones: [{id: rest, kind: parking, disc: [9, 9, 1]}]\n";

  const Outcome listed = run({"map", "zone", "list", "--scenario", scenario.string()});
  EXPECT_EQ(listed.code, 0) << listed.err;
  EXPECT_THAT(listed.out, AllOf(HasSubstr("office  keep-out"), HasSubstr("rest    parking   -     1 m around 9,9")));
}

TEST_F(MapZone, BadInputIsNamedWithExitCode2AndNoMapWith3) {
  const auto refusal = [](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"map", "zone", "add"});
    const Outcome outcome = run(arguments);
    EXPECT_EQ(outcome.code, 2);
    return outcome.err;
  };

  EXPECT_THAT(refusal({"a", "fast", "--disc", "1,1,1"}), HasSubstr("'fast' is no kind of zone; use keep-out"));
  EXPECT_THAT(refusal({"a", "parking"}), HasSubstr("give one shape"));
  EXPECT_THAT(refusal({"a", "speed", "--disc", "1,1,1"}), HasSubstr("a speed zone needs --speed"));
  EXPECT_THAT(refusal({"a", "one-way", "--disc", "1,1,1"}), HasSubstr("a one-way zone needs --direction"));
  EXPECT_THAT(refusal({"a", "speed", "--disc", "1,1,1", "--speed", "11"}), HasSubstr("max_speed_mps = 11 is not"));
  EXPECT_THAT(refusal({"a b", "parking", "--disc", "1,1,1"}), HasSubstr("zone_id: use 1 to 60"));
  EXPECT_THAT(refusal({"a", "parking", "--disc", "1,1,1", "--speed", "1"}), HasSubstr("only a speed zone has one"));

  EXPECT_EQ(run({"map", "zone", "list", "--timeout", "0.5"}).code, 3);
  EXPECT_EQ(run({"map", "zone", "remove", "a", "--timeout", "0.5"}).code, 3);
}

}  // namespace
