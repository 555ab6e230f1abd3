// What a researcher may set of a planner, by name.
#include "services/global-planner/core/parameters.hpp"

#include <gmock/gmock.h>

#include <algorithm>
#include <random>
#include <stdexcept>
#include <string>

#include "services/global-planner/core/traditional_astar.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tests/support/random_grid.hpp"

namespace aisle::global_planner {
namespace {

using testing::Contains;
using testing::HasSubstr;

std::vector<std::string> names_of(const char* planner) {
  std::vector<std::string> names;
  for (const Parameter& parameter : find_variant(planner)->parameters()) names.push_back(parameter.name);
  return names;
}

PlannedPath planned(const char* planner, const std::vector<std::pair<std::string, std::string>>& set,
                    const grid::ClearanceField& clearance) {
  Parameters parameters;
  for (const auto& [name, value] : set) parameters.set(name, value);
  return find_variant(planner)->make(parameters)->plan({clearance, {0.5, 0.5}, {29.5, 29.5}}, nullptr);
}

grid::ClearanceField some_map(unsigned seed) {
  std::mt19937 random(seed);
  return grid::ClearanceField(test_support::random_blocks(random, 30, 25, 5, 1.0), 5.0);
}

std::string complaint(const char* planner, const std::string& name, const std::string& value) {
  Parameters parameters;
  parameters.set(name, value);
  try {
    find_variant(planner)->make(parameters);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "none";
}

TEST(PlannerParameters, EveryWeightAndRuleOfAPapersSearchHasAName) {
  for (const char* planner : {"li", "wu", "qu", "yu", "wang", "modified-astar"}) {
    EXPECT_THAT(names_of(planner), Contains("passes")) << planner;
    EXPECT_THAT(names_of(planner), Contains("neighbours")) << planner;
    EXPECT_THAT(names_of(planner), Contains("closed")) << planner;
  }
  EXPECT_THAT(names_of("li"), Contains("distance_weight"));
  EXPECT_THAT(names_of("qu"), Contains("least_weight"));
  EXPECT_THAT(names_of("yu"), Contains("beta"));
  EXPECT_THAT(names_of("wang"), Contains("log_base"));
  EXPECT_THAT(names_of("ant-colony"), Contains("evaporation"));
}

// A pass that is right is of no use where a variant does not have it.
TEST(PlannerParameters, HaveThePassesOfTheirPapers) {
  const auto passes_of = [](const char* planner) {
    for (const Parameter& parameter : find_variant(planner)->parameters())
      if (parameter.name == "passes") return parameter.value;
    return std::string("no such parameter");
  };
  EXPECT_EQ(passes_of("li"), "collinear-but-one-beside-obstacles,right-angle") << "IV.B.2";
  EXPECT_EQ(passes_of("wu"), "collinear,interpolated-forward,interpolated-backward") << "2.2";
  EXPECT_EQ(passes_of("qu"), "collinear,safe-distance") << "2.3.2";
  EXPECT_EQ(passes_of("yu"), "collinear,line-of-sight,interpolated-at-safe-distance") << "2.3";
  EXPECT_EQ(passes_of("wang"), "collinear,line-of-sight") << "2.2.2";
  EXPECT_EQ(passes_of("modified-astar"), "none");
}

TEST(PlannerParameters, SetToTheirDefaultsChangeNothing) {
  for (const Variant& variant : all_variants()) {
    Parameters defaults;
    for (const Parameter& parameter : variant.parameters()) defaults.set(parameter.name, parameter.value);
    for (unsigned seed = 1; seed <= 3; ++seed) {
      const grid::ClearanceField clearance = some_map(seed);
      const Problem problem{clearance, {0.5, 0.5}, {29.5, 29.5}};
      const PlannedPath plain = variant.make()->plan(problem, nullptr);
      const PlannedPath set = variant.make(defaults)->plan(problem, nullptr);
      EXPECT_EQ(set.waypoints_in_map, plain.waypoints_in_map) << variant.name;
      EXPECT_EQ(set.expanded, plain.expanded) << variant.name;
    }
  }
}

TEST(PlannerParameters, WithoutPassesAPathGoesFromCellToCell) {
  const grid::ClearanceField clearance = some_map(1);
  const PlannedPath bare = planned("wang", {{"passes", "none"}}, clearance);
  const PlannedPath whole = planned("wang", {}, clearance);
  EXPECT_EQ(bare.expanded, whole.expanded) << "the search is the same";
  EXPECT_GT(bare.waypoints_in_map.size(), 25U);
  EXPECT_LT(whole.waypoints_in_map.size(), bare.waypoints_in_map.size());
}

TEST(PlannerParameters, WithoutItsDistanceWeightWangIsTheModifiedAStar) {
  const grid::ClearanceField clearance = some_map(2);
  const PlannedPath unweighted = planned("wang", {{"distance_weight", "0"}, {"passes", "none"}}, clearance);
  const PlannedPath modified = planned("modified-astar", {}, clearance);
  EXPECT_EQ(unweighted.waypoints_in_map, modified.waypoints_in_map);
  EXPECT_EQ(unweighted.expanded, modified.expanded);
}

TEST(PlannerParameters, WithAnyDiagonalAndNoPassesWuIsTheTraditionalAStar) {
  const grid::ClearanceField clearance = some_map(3);
  const PlannedPath drawn = planned("wu", {{"neighbours", "any"}, {"passes", "none"}}, clearance);
  const PlannedPath traditional =
      traditional_astar(Heuristic::kEuclidean)->plan({clearance, {0.5, 0.5}, {29.5, 29.5}}, nullptr);
  EXPECT_EQ(drawn.waypoints_in_map, traditional.waypoints_in_map);
}

TEST(PlannerParameters, BetaOfYuChangesWhatIsExpanded) {
  const grid::ClearanceField clearance = some_map(4);
  EXPECT_LT(planned("yu", {{"beta", "1"}}, clearance).expanded, planned("yu", {{"beta", "0"}}, clearance).expanded);
}

TEST(PlannerParameters, AreRefusedWithWhatWouldDo) {
  EXPECT_THAT(complaint("yu", "beta", "1.5"), HasSubstr("beta: '1.5' is no number from 0 to 1"));
  EXPECT_THAT(complaint("yu", "beta", "half"), HasSubstr("no number"));
  EXPECT_THAT(complaint("yu", "beta", "nan"), HasSubstr("no number"));
  EXPECT_THAT(complaint("yu", "gamma", "1"), HasSubstr("gamma is no parameter of this planner; there are beta"));
  EXPECT_THAT(complaint("li", "heuristic", "euclid"), HasSubstr("not one of euclidean, manhattan, chebyshev, octile"));
  EXPECT_THAT(complaint("wang", "passes", "collinear,magic"), HasSubstr("'magic'"));
  EXPECT_THAT(complaint("jps", "beta", "1"), HasSubstr("it has none"));
}

}  // namespace
}  // namespace aisle::global_planner
