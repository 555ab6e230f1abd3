#include "tools/lab/papers/comparison.hpp"

#include <gmock/gmock.h>

#include <cmath>

#include "common/config/reader.hpp"
#include "tools/lab/planning/ompl_planners.hpp"

namespace aisle::lab {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

void silent(const std::string&) {}

std::vector<ComparedPlanner> few(const std::vector<std::string>& planners, int maps = 6) {
  return compare({{"wang-1"}, planners, {maps, 1}}, silent);
}

TEST(Compare, MeasuresEachPlannerOnTheSameMapsAgainstTheFirst) {
  const std::vector<ComparedPlanner> rows = few({"astar", "wang", "theta"});
  ASSERT_EQ(rows.size(), 3U);
  for (const ComparedPlanner& row : rows) {
    EXPECT_EQ(row.maps, 6U);
    EXPECT_EQ(row.found, 6U);
    EXPECT_EQ(row.lengths.n, 6U);
    EXPECT_DOUBLE_EQ(row.lengths.mean_a, rows[0].length_m) << row.planner;
  }
  EXPECT_LT(rows[2].lengths.mean_difference, 0.0) << "any angle is shorter than the grid's optimum";

  const auto json = json_of(rows, 1);
  EXPECT_TRUE(json[0]["interval95"].is_null()) << "the first is compared with nothing";
  EXPECT_EQ(json[2]["interval95"].size(), 2U);
  for (const char* key : {"map", "planner", "n", "found", "length_m", "time_us", "commit", "seed", "library"})
    EXPECT_TRUE(json[1].contains(key)) << key;
}

TEST(Compare, HasOmplBesideOursWhereItIsBuiltIn) {
  if (ompl_version().empty()) {
    EXPECT_THROW(few({"wang", "rrtstar"}), config::BadEnvironment);
    EXPECT_THAT(comparators_table({2, 1}, silent), HasSubstr("Not built in"));
    return;
  }
  const std::vector<ComparedPlanner> rows = few({"astar", "rrtstar"}, 2), again = few({"astar", "rrtstar"}, 2);
  EXPECT_EQ(rows[1].found, 2U);
  EXPECT_EQ(rows[1].length_m, again[1].length_m);
  EXPECT_LT(rows[1].length_m, rows[0].length_m) << "any angle is shorter than from cell to cell";
  EXPECT_EQ(json_of(rows, 1)[1]["library"], ompl_version());
}

TEST(Compared, NamesAreWordsOrListsAndUnknownOnesAreRefused) {
  EXPECT_THAT(contestants_named({"wang,rrtstar", "traditional"}), ElementsAre("wang", "rrtstar", "traditional"));
  EXPECT_THAT(map_kinds_named("qu"), ElementsAre("qu-simple", "qu-maze"));
  try {
    contestants_named({"rrt-star"});
    FAIL();
  } catch (const config::BadInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean rrtstar?"));
  }
  EXPECT_THROW(map_kinds_named("wank-1"), config::BadInput);
}

}  // namespace
}  // namespace aisle::lab
