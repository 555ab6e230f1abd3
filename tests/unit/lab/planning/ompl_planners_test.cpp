// OMPL's planners as comparators: by our own rules, and the same path every time. Where the build found no OMPL, the
// name is known and its absence is said.
#include "tools/lab/planning/ompl_planners.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

#include "common/config/reader.hpp"
#include "services/global-planner/core/path_checker.hpp"
#include "tools/lab/planning/paper_maps.hpp"

namespace aisle::lab {
namespace {

using global_planner::Outcome;
using global_planner::PlannedPath;
using global_planner::Problem;
using ::testing::HasSubstr;

/// A drawn map with its clearances, for one query.
struct Place {
  DrawnMap map = paper_map(*find_paper_map_kind("wang-1"), 3);
  grid::ClearanceField clearance{map.grid, 10.0};
  Problem problem{clearance, map.start_in_map, map.goal_in_map};
};

SamplingBounds iterations(std::size_t count) {
  SamplingBounds bounds;
  bounds.iterations = count;
  return bounds;
}

std::string absence_of(const std::string& name) {
  try {
    ompl_planner(name, iterations(1));
  } catch (const config::BadEnvironment& error) {
    return error.what();
  }
  return "";
}

TEST(OmplPlanners, AreKnownByNameAndSaidToBeAbsent) {
  for (const std::string& name : ompl_planner_names()) {
    EXPECT_TRUE(is_ompl_planner(name));
    if (ompl_version().empty()) {
      EXPECT_THAT(absence_of(name), HasSubstr("libompl-dev"));
    }
  }
  EXPECT_FALSE(is_ompl_planner("wang"));
}

TEST(OmplPlanners, FindPathsThatAVehicleCanDriveAndTheSameOnesAgain) {
  if (ompl_version().empty()) return;  // AreKnownByNameAndSaidToBeAbsent
  const Place place;
  for (const std::string& name : ompl_planner_names()) {
    const auto planner = ompl_planner(name, iterations(1500));
    const PlannedPath first = planner->plan(place.problem, nullptr), again = planner->plan(place.problem, nullptr);
    ASSERT_EQ(first.outcome, Outcome::kFound) << name;
    EXPECT_EQ(global_planner::why_not_drivable(place.problem, first.waypoints_in_map), "") << name;
    EXPECT_EQ(first.waypoints_in_map, again.waypoints_in_map) << name;
    EXPECT_EQ(first.length_m, again.length_m) << name;
  }
}

TEST(OmplPlanners, WithoutAPathAfterItsIterationsAreOutOfTime) {
  if (ompl_version().empty()) return;  // AreKnownByNameAndSaidToBeAbsent
  const Place place;
  EXPECT_EQ(ompl_planner("rrtstar", iterations(2))->plan(place.problem, nullptr).outcome, Outcome::kOutOfTime);
  EXPECT_THROW(ompl_planner("wang", iterations(2)), std::invalid_argument);
}

}  // namespace
}  // namespace aisle::lab
