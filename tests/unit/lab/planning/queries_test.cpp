#include "tools/lab/planning/queries.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "common/config/reader.hpp"
#include "tools/lab/planning/chosen_planners.hpp"

namespace aisle::lab {
namespace {

using testing::HasSubstr;

const grid::Geometry kMap{6, 4, 0.5, {10.0, 20.0}};

class Queries : public testing::Test {
 protected:
  std::filesystem::path written(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = std::filesystem::path(testing::TempDir()) / ("aisle-queries-" + name);
    std::ofstream(file) << text;
    return file;
  }
  std::string complaint(const std::string& text) const {
    try {
      read_queries(written("bad", text), kMap, 10);
    } catch (const config::BadInput& error) {
      return error.what();
    }
    return "none";
  }
};

TEST_F(Queries, ScenariosCountRowsFromTheTop) {
  const auto queries = read_queries(written("a.scen", "version 1\r\n3\tm.map\t6\t4\t0\t0\t5\t3\t5.5\r\n"), kMap, 10);
  ASSERT_EQ(queries.size(), 1U);
  EXPECT_EQ(queries[0].start_in_map, (geometry::Point2{10.25, 21.75}));
  EXPECT_EQ(queries[0].goal_in_map, (geometry::Point2{12.75, 20.25}));
  EXPECT_DOUBLE_EQ(queries[0].optimum_m, 2.75);
}

TEST_F(Queries, PlainLinesAreReadTooAndThinnedEvenly) {
  const auto file = written("a.q", "0 0 1 1 1\n1 0 1 1 1\n2 0 1 1 1\n3 0 1 1 1\n4 0 1 1 1\n\n");
  EXPECT_EQ(read_queries(file, kMap, 10).size(), 5U);
  const auto some = read_queries(file, kMap, 3);
  ASSERT_EQ(some.size(), 3U);
  EXPECT_EQ(some[1].start_in_map.x, 11.25);
  EXPECT_EQ(some[2].start_in_map.x, 12.25);
}

TEST_F(Queries, WhatIsWrongIsSaidWithItsLine) {
  EXPECT_THAT(complaint("version 1\n3 m.map 6 4 0 0 5 3\n"), HasSubstr(":2: expected"));
  EXPECT_THAT(complaint("version 1\n3 m.map 7 4 0 0 5 3 5\n"), HasSubstr("7 x 4"));
  EXPECT_THAT(complaint("version 1\n3 m.map 6 4 0 0 6 3 5\n"), HasSubstr("cell 6 3 is outside"));
  EXPECT_THAT(complaint("0 0 1 1 nan\n"), HasSubstr(":1: expected"));
  EXPECT_THAT(complaint("0 0 1 1 1 1\n"), HasSubstr(":1: expected"));
  EXPECT_THAT(complaint(""), HasSubstr("has no scenario"));
  EXPECT_THROW(read_queries("/no/such.scen", kMap, 10), config::BadInput);
}

TEST(ChosenPlanners, AreAllOrThoseNamed) {
  EXPECT_EQ(chosen_planners({}).size(), global_planner::all_variants().size());
  EXPECT_EQ(chosen_planners({"theta", "astar"}).front()->name, "theta");
  try {
    chosen_planners({"wnag"});
    ADD_FAILURE() << "an unknown planner was taken";
  } catch (const config::BadInput& error) {
    EXPECT_THAT(error.what(), HasSubstr("did you mean wang?"));
  }
}

}  // namespace
}  // namespace aisle::lab
