#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "common/config/reader.hpp"
#include "tests/support/places.hpp"
#include "tools/lab/page/markdown.hpp"
#include "tools/lab/planning/drawn_map.hpp"
#include "tools/lab/planning/paper_tables.hpp"
#include "tools/lab/planning/random_tables.hpp"

namespace aisle::lab {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

const fs::path kMaps = test_support::source_folder() / "deploy/experiments";
void silent(const std::string&) {}

fs::path folder(const std::string& name) {
  const fs::path path = fs::path(testing::TempDir()) / ("aisle-experiment-" + name);
  fs::create_directories(path);
  return path;
}

TEST(DrawnMap, HasStartAndGoalWhereTheyAreDrawn) {
  const fs::path file = folder("maps") / "a.txt";
  std::ofstream(file) << "..T\n#..\nS..\n";
  const DrawnMap map = read_drawn_map(file, 0.5);
  EXPECT_EQ(map.start_in_map, (geometry::Point2{0.25, 0.25}));
  EXPECT_EQ(map.goal_in_map, (geometry::Point2{1.25, 1.25}));
  EXPECT_FALSE(map.grid.is_free({0, 1}));
  EXPECT_TRUE(map.grid.is_free({0, 0}));
}

TEST(DrawnMap, IsRefusedWithItsLine) {
  const fs::path file = folder("maps") / "bad.txt";
  const auto complaint = [&](const std::string& text) -> std::string {
    std::ofstream(file) << text;
    try {
      read_drawn_map(file, 1.0);
    } catch (const config::BadInput& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_THAT(complaint("S.\n.T.\n"), HasSubstr(":2: is not as long"));
  EXPECT_THAT(complaint("S?T\n"), HasSubstr("'?'"));
  EXPECT_THAT(complaint("S..\n"), HasSubstr("no goal T"));
  EXPECT_THAT(complaint(""), HasSubstr("empty"));
}

TEST(Section, IsReplacedAndLeavesTheOthersAlone) {
  const std::string page = with_section(with_section("", "a", "one\n"), "b", "two\n");
  EXPECT_EQ(with_section(page, "a", "three\n"), with_section(with_section("", "a", "three\n"), "b", "two\n"));
  EXPECT_THAT(with_section(page, "b", "four\n"), HasSubstr("one\n"));
  EXPECT_EQ(with_section(page, "a", "one\n"), page);
}

TEST(PaperTables, SayOfEveryClaimedGainWhichWayItGoes) {
  const fs::path pictures = folder("pictures");
  const std::string text = paper_tables(kMaps, pictures, "pictures", silent);
  const std::string compared = text.substr(0, text.find("####"));
  EXPECT_THAT(compared, HasSubstr("| LI table II, 10x10 simple | length m | 18.00 -> 14.83 | 18.00 -> "));
  EXPECT_THAT(compared, HasSubstr("| LI table II, 20x20 complex | turning points | 16 -> 10 | "));
  EXPECT_THAT(compared, Not(HasSubstr("| nodes | 10 -> 5"))) << "LI's vertices are turns";
  for (const char* distance : {"0.0", "0.3", "0.5"})
    EXPECT_THAT(compared, HasSubstr(std::string("QU table 2, 21x21 maze, safe distance ") + distance + " m | length"));
  EXPECT_TRUE(fs::exists(pictures / "wang-1.svg"));
  EXPECT_EQ(text, paper_tables(kMaps, pictures, "pictures", silent)) << "the same text from the same maps";
}

TEST(RandomTables, HaveARowForEachPlannerAndNoFaults) {
  const std::string text = random_map_table(20, 6, silent);
  EXPECT_THAT(text, HasSubstr("seeds 2000000 to 2000005"));
  EXPECT_THAT(text, HasSubstr("| wang | "));
}

}  // namespace
}  // namespace aisle::lab
