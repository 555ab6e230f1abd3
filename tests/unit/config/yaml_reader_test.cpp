#include "common/config/yaml_reader.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "common/config/nearest_name.hpp"

namespace aisle::config {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

struct Limits {
  double max_speed_mps{1.2};
  template <class Reader>
  void describe(Reader& r) {
    r.field("max_speed_mps", max_speed_mps, 0.05, 10.0);
  }
};

struct Vehicle {
  std::string id;
  std::vector<double> start;
  template <class Reader>
  void describe(Reader& r) {
    r.field("id", id).field("start", start, -1e6, 1e6).require({"id"});
  }
};

struct Site {
  int domain{7};
  std::uint64_t seed{1};
  bool loop{false};
  std::string planner{"astar"};
  std::vector<std::string> peers;
  std::vector<std::vector<double>> waypoints;
  Limits limits;
  std::vector<Vehicle> vehicles;
  template <class Reader>
  void describe(Reader& r) {
    r.field("domain", domain, 0, 230)
        .field("seed", seed, std::uint64_t{0}, UINT64_MAX)
        .field("loop", loop)
        .field("planner", planner)
        .field("peers", peers)
        .field("waypoints", waypoints, -1e6, 1e6)
        .section("limits", limits)
        .list("vehicles", vehicles);
  }
};

Site read(const std::string& text) {
  Site site;
  read_yaml_text(text, "site.yaml", site);
  return site;
}

std::string error_of(const std::string& text) {
  try {
    read(text);
  } catch (const BadInput& error) {
    return error.what();
  }
  return "no error";
}

TEST(YamlReader, ReadsEveryKindOfField) {
  const Site site = read(
      "domain: 12\nseed: 18446744073709551615\nloop: true\nplanner: \"theta: star\"\npeers: [10.0.0.1, 10.0.0.2]\n"
      "waypoints: [[1, 2], [3.5, -4e1, 0.5]]\nlimits:\n  max_speed_mps: 0.8\nvehicles:\n- {id: agv-1, start: [1, 2, "
      "0]}\n- {id: agv-2}\n");
  EXPECT_EQ(site.domain, 12);
  EXPECT_EQ(site.seed, UINT64_MAX);
  EXPECT_TRUE(site.loop);
  EXPECT_EQ(site.planner, "theta: star");
  EXPECT_THAT(site.peers, ElementsAre("10.0.0.1", "10.0.0.2"));
  EXPECT_THAT(site.waypoints, ElementsAre(ElementsAre(1, 2), ElementsAre(3.5, -40, 0.5)));
  EXPECT_EQ(site.limits.max_speed_mps, 0.8);
  ASSERT_EQ(site.vehicles.size(), 2u);
  EXPECT_EQ(site.vehicles[1].id, "agv-2");
  EXPECT_THAT(site.vehicles[0].start, ElementsAre(1, 2, 0));
}

TEST(YamlReader, KeepsDefaultsOfMissingKeysAndOfAnEmptyFile) {
  for (const char* text : {"", "# only a comment\n", "planner: wang\n"}) {
    const Site site = read(text);
    EXPECT_EQ(site.domain, 7);
    EXPECT_EQ(site.limits.max_speed_mps, 1.2);
  }
}

TEST(YamlReader, NamesFileLinePathAndNearestNameOfAnUnknownKey) {
  EXPECT_EQ(error_of("domain: 1\nplaner: x\n"), "site.yaml:2: unknown key 'planer'; did you mean 'planner'?");
  EXPECT_EQ(error_of("limits:\n  max_sped_mps: 1\n"),
            "site.yaml:2: limits: unknown key 'max_sped_mps'; did you mean 'max_speed_mps'?");
  EXPECT_EQ(error_of("vehicles:\n- id: a\n- id: b\n  xyzzy_quux: 1\n"),
            "site.yaml:4: vehicles[1]: unknown key 'xyzzy_quux'");
}

TEST(YamlReader, RefusesAKeyGivenTwice) {
  EXPECT_EQ(error_of("domain: 1\nplanner: a\ndomain: 2\n"), "site.yaml:3: domain: given twice, first in line 1");
}

TEST(YamlReader, RefusesOutOfBounds) {
  EXPECT_EQ(error_of("limits: {max_speed_mps: 12.5}"),
            "site.yaml:1: limits.max_speed_mps: 12.5 is out of bounds; give 0.05 to 10");
  EXPECT_EQ(error_of("domain: -1"), "site.yaml:1: domain: -1 is out of bounds; give 0 to 230");
  EXPECT_EQ(error_of("domain: 99999999999"), "site.yaml:1: domain: 99999999999 is out of bounds; give 0 to 230");
  EXPECT_EQ(error_of("seed: -1"), "site.yaml:1: seed: -1 is out of bounds; give 0 to 18446744073709551615");
  EXPECT_EQ(error_of("waypoints: [[0, 0],\n [0, 1e7]]"),
            "site.yaml:2: waypoints[1][1]: 1e7 is out of bounds; give -1e+06 to 1e+06");
}

TEST(YamlReader, RefusesAnotherType) {
  EXPECT_EQ(error_of("domain: 1.5"), "site.yaml:1: domain: must be a whole number, but is '1.5'");
  EXPECT_EQ(error_of("domain: two"), "site.yaml:1: domain: must be a whole number, but is 'two'");
  EXPECT_EQ(error_of("domain: [1]"), "site.yaml:1: domain: must be a whole number, but is a list");
  EXPECT_EQ(error_of("domain: '1'"), "site.yaml:1: domain: must be a whole number, but is '1'");
  EXPECT_EQ(error_of("loop: yes"), "site.yaml:1: loop: must be true or false, but is 'yes'");
  EXPECT_EQ(error_of("planner:\n  name: x"), "site.yaml:2: planner: must be text, but is a section");
  EXPECT_EQ(error_of("planner:"), "site.yaml:1: planner: must be text, but is empty");
  EXPECT_EQ(error_of("peers: 10.0.0.1"), "site.yaml:1: peers: must be a list, but is '10.0.0.1'");
  EXPECT_EQ(error_of("limits: 3"), "site.yaml:1: limits: must be a section (key: value), but is text");
  EXPECT_EQ(error_of("- 1\n- 2\n"), "site.yaml:1: must be a section (key: value), but is a list");
}

TEST(YamlReader, RefusesNotANumberAndInfinity) {
  for (const char* value : {".nan", ".inf", "-.inf", "nan", "inf", "1e999", "0x10", "1.2.3", "1 2"}) {
    EXPECT_THAT(error_of(std::string("limits: {max_speed_mps: ") + value + "}"),
                HasSubstr("limits.max_speed_mps: must be a number"))
        << value;
  }
}

TEST(YamlReader, NamesAMissingKeyButAnUnknownOneFirst) {
  EXPECT_EQ(error_of("vehicles:\n- {start: [1, 2]}\n"), "site.yaml:2: vehicles[0]: the key 'id' is missing");
  EXPECT_EQ(error_of("vehicles:\n- {idd: x}\n"), "site.yaml:2: vehicles[0]: unknown key 'idd'; did you mean 'id'?");
}

TEST(YamlReader, NamesTheLineOfBrokenYaml) {
  EXPECT_THAT(error_of("domain: 1\nplanner: [a, b\n"), ::testing::MatchesRegex("site.yaml:[0-9]+: not valid YAML: .*"));
  EXPECT_EQ(error_of("domain: 1\n---\ndomain: 2\n"),
            "site.yaml: more than one YAML document; keep one, without a second '---'");
}

TEST(YamlReader, RefusesBombsBeforeTheyUnfold) {
  std::string laughs = "a: &a [x, x, x, x, x, x, x, x, x]\n";
  for (char c = 'b'; c < 'z'; ++c) {
    const std::string before(1, static_cast<char>(c - 1));
    laughs += std::string(1, c) + ": &" + c + " [*" + before + ", *" + before + ", *" + before + "]\n";
  }
  EXPECT_EQ(error_of(laughs), "site.yaml:1: anchors and aliases (&, *) are not accepted; write the value out");
  EXPECT_THAT(error_of(std::string(1u << 20, '[')), HasSubstr("nested deeper than 32 levels"));
  std::string steps;
  for (int i = 0; i < 400; ++i) steps += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  EXPECT_THAT(error_of(steps), HasSubstr("nested deeper than 32 levels"));
}

TEST(YamlReader, WhereAndRejectNameTheKey) {
  YamlReader reader = open_yaml_text("planner: a\ndomain: 3\n", "site.yaml");
  EXPECT_EQ(reader.where("domain"), "site.yaml:2: domain");
  EXPECT_THROW(reader.reject("domain", "is taken"), BadInput);
  EXPECT_TRUE(reader.has("planner"));
  EXPECT_FALSE(reader.has("plan"));
}

class YamlFile : public ::testing::Test {
 protected:
  void SetUp() override {
    file_ = std::filesystem::temp_directory_path() /
            ("aisle_config_" + std::string(::testing::UnitTest::GetInstance()->current_test_info()->name()) + ".yaml");
  }
  void TearDown() override { std::filesystem::remove(file_); }
  std::string error_of_file(const std::filesystem::path& file) {
    Site site;
    try {
      read_yaml_file(file, site);
    } catch (const BadInput& error) {
      return error.what();
    }
    return "no error";
  }
  std::filesystem::path file_;
};

TEST_F(YamlFile, WithByteOrderMarkAndCarriageReturnsIsRead) {
  std::ofstream(file_, std::ios::binary) << "\xEF\xBB\xBF"
                                         << "domain: 9\r\nplanner: wang\r\n";
  Site site;
  read_yaml_file(file_, site);
  EXPECT_EQ(site.domain, 9);
  EXPECT_EQ(site.planner, "wang");
}

TEST_F(YamlFile, MissingDirectoryOrTooLargeIsNamed) {
  EXPECT_EQ(error_of_file("/nonexistent/x.yaml"),
            "/nonexistent/x.yaml: cannot be read; check the path and its permissions");
  EXPECT_EQ(error_of_file("/tmp"), "/tmp: is a directory; give a YAML file");
  std::ofstream(file_) << std::string((4u << 20) + 1, '#');
  EXPECT_EQ(error_of_file(file_), file_.string() + ": larger than 4 MiB, the limit for a YAML file");
}

TEST(NearestName, FindsWhatWasMeantOrNothing) {
  EXPECT_EQ(nearest_name("plans", {"plan", "track", "scan"}), "plan");
  EXPECT_EQ(nearest_name("velocity_comand", {"velocity_command", "vehicle_state"}), "velocity_command");
  EXPECT_EQ(nearest_name("temperature", {"plan", "track", "scan"}), "");
  EXPECT_EQ(nearest_name("xy", {"ab"}), "");
}

}  // namespace
}  // namespace aisle::config
