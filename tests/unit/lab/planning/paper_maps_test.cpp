#include "tools/lab/planning/paper_maps.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numeric>

#include "tools/lab/planning/random_maps.hpp"

namespace aisle::lab {
namespace {

using testing::HasSubstr;

// What the generator draws may never change: figures of a seed are quoted.
const char* const kFirstOfLiSimple =
    ".....##..T\n"
    ".....##...\n"
    ".....##...\n"
    "......#..#\n"
    "....#....#\n"
    "....###..#\n"
    "###.###...\n"
    "..........\n"
    "..........\n"
    "S.........\n";

TEST(PaperMaps, AreTheSameOnEveryMachine) {
  const std::string text = text_of(paper_map(*find_paper_map_kind("li-simple"), 1));
  EXPECT_EQ(text, kFirstOfLiSimple);
}

TEST(PaperMaps, DifferBySeedAndOnlyBySeed) {
  for (const PaperMapKind& kind : paper_map_kinds()) {
    EXPECT_EQ(text_of(paper_map(kind, 7)), text_of(paper_map(kind, 7))) << kind.name;
    EXPECT_NE(text_of(paper_map(kind, 7)), text_of(paper_map(kind, 8))) << kind.name;
  }
}

TEST(PaperMaps, HaveStartGoalAndSizeOfTheirPaper) {
  for (const PaperMapKind& kind : paper_map_kinds()) {
    const DrawnMap map = paper_map(kind, 1);
    EXPECT_EQ(map.grid.geometry().width, kind.edge) << kind.name;
    EXPECT_EQ(map.grid.geometry().cell_at(map.start_in_map), kind.start) << kind.name;
    EXPECT_EQ(map.grid.geometry().cell_at(map.goal_in_map), kind.goal) << kind.name;
    EXPECT_TRUE(map.grid.is_free(kind.start) && map.grid.is_free(kind.goal)) << kind.name;
  }
  const PaperMapKind* wang = find_paper_map_kind("wang-map-3");
  ASSERT_NE(wang, nullptr);
  EXPECT_EQ(wang->most_blocks, 74) << "WANG table 3";
  EXPECT_EQ(find_paper_map_kind("wang-4"), nullptr);
}

// WU prints neither size nor ends of its map, YU no ends.
TEST(PaperMaps, AreAsLargeAsThePapersSayAndLeadWhereTheyLead) {
  struct Printed {
    const char* name;
    int edge;
    grid::Cell start, goal;
  };
  for (const Printed& printed : {Printed{"li-simple", 10, {0, 0}, {9, 9}},
                                 {"li-complex", 20, {0, 0}, {19, 19}},
                                 {"qu-simple", 21, {5, 16}, {19, 3}},
                                 {"qu-maze", 21, {2, 20}, {19, 3}},
                                 {"wang-1", 20, {1, 1}, {19, 19}},
                                 {"wang-map-1", 20, {1, 1}, {19, 19}},
                                 {"wang-map-2", 20, {1, 1}, {19, 19}},
                                 {"wang-map-3", 40, {1, 1}, {39, 39}}}) {
    const PaperMapKind& kind = *find_paper_map_kind(printed.name);
    EXPECT_EQ(kind.edge, printed.edge) << kind.name;
    EXPECT_EQ(kind.start, printed.start) << kind.name;
    EXPECT_EQ(kind.goal, printed.goal) << kind.name;
  }
  EXPECT_EQ(find_paper_map_kind("yu-1")->edge, 20);
  EXPECT_EQ(find_paper_map_kind("yu-2")->edge, 20);
  EXPECT_EQ(find_paper_map_kind("yu-3")->edge, 50);
  EXPECT_EQ(find_paper_map_kind("wang-map-1")->most_blocks, 5);
  EXPECT_EQ(find_paper_map_kind("wang-map-2")->most_blocks, 19);
}

TEST(PaperMaps, AsTextAreReadBack) {
  const DrawnMap map = paper_map(*find_paper_map_kind("qu-maze"), 3);
  const auto file = std::filesystem::path(testing::TempDir()) / "aisle-paper-map.txt";
  std::ofstream(file) << text_of(map);
  EXPECT_EQ(text_of(read_drawn_map(file, 1.0)), text_of(map));
}

TEST(PaperMaps, SayTheirRule) {
  EXPECT_THAT(rule_of(*find_paper_map_kind("wang-map-1")), HasSubstr("from cell (1, 1) to (19, 19); 5 blocks"));
  EXPECT_THAT(rule_of(*find_paper_map_kind("qu-maze")), HasSubstr("every fifth column"));
}

}  // namespace
}  // namespace aisle::lab
