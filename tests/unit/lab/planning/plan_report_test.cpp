#include "tools/lab/planning/plan_report.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "services/global-planner/core/path_figures.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tests/support/ascii_grid.hpp"
#include "tools/lab/planning/plan_svg.hpp"

namespace aisle::lab {
namespace {

using global_planner::path_figures;

TEST(PathFigures, CountWhatThePapersCount) {
  const grid::ClearanceField clearance(test_support::grid_from_text({".....", ".....", "....#"}), 10.0);
  const auto figures = path_figures(clearance, {{0.5, 0.5}, {1.5, 0.5}, {2.5, 0.5}, {3.5, 1.5}, {3.5, 2.5}});
  EXPECT_DOUBLE_EQ(figures.length_m, 3.0 + std::sqrt(2.0));
  EXPECT_EQ(figures.nodes, 5);
  EXPECT_EQ(figures.turning_points, 2);
  EXPECT_NEAR(figures.turning_angle_rad, 0.5 * geometry::kPi, 1e-12);
  EXPECT_DOUBLE_EQ(figures.least_clearance_m, 0.5);
}

TEST(PlanReport, HasTheNamedFieldsAndNullsWhereNothingWasSolved) {
  const std::vector<std::string> text{"S....", ".###.", "....G"};
  const grid::ClearanceField clearance(test_support::grid_from_text(text), 10.0);
  const auto planner = global_planner::find_variant("astar")->make();
  const global_planner::Problem problem{clearance, test_support::find_letter(text, 'S'),
                                        test_support::find_letter(text, 'G')};
  global_planner::Problem refused = problem;
  refused.radius_m = 3.0;
  std::vector<Tally> tallies{Tally("astar"), Tally("astar")};
  tallies[0].add(ask(*planner, problem), 5.0);
  tallies[0].add(ask(*planner, refused), 0.0);
  tallies[1].add(ask(*planner, refused), 0.0);
  const auto json = json_of(tallies);
  const char* names[] = {"planner",
                         "asked",
                         "solved",
                         "checker_failures",
                         "length_ratio_mean",
                         "length_ratio_max",
                         "nodes_mean",
                         "turning_points_mean",
                         "turning_angle_mean_rad",
                         "expanded_mean",
                         "time_us_p50",
                         "time_us_p99",
                         "least_clearance_m"};
  for (const char* name : names) EXPECT_TRUE(json[0].contains(name)) << name;
  EXPECT_EQ(json[0].size(), std::size(names));
  EXPECT_EQ(json[0]["asked"], 2);
  EXPECT_EQ(json[0]["solved"], 1);
  EXPECT_NEAR(json[0]["length_ratio_mean"].get<double>(), 6.0 / 5.0, 1e-9);
  EXPECT_EQ(json[1]["solved"], 0);
  EXPECT_TRUE(json[1]["length_ratio_mean"].is_null());
  EXPECT_TRUE(json[1]["least_clearance_m"].is_null());
  EXPECT_EQ(rows_of(tallies).size(), 3U);
  EXPECT_EQ(rows_of(tallies)[0].size(), rows_of(tallies)[2].size());
}

TEST(PlanReport, CountsPathsThatTheCheckerRefuses) {
  Answer answer;
  answer.plan.outcome = global_planner::Outcome::kFound;
  answer.fault = "touches an obstacle at (1, 2)";
  Tally tally("wrong");
  tally.add(answer, 1.0);
  EXPECT_EQ(tally.checker_failures(), 1);
  EXPECT_EQ(tally.first_fault(), answer.fault);
}

TEST(PlanSvg, DrawsTheMapAndEachPath) {
  const std::string svg = plan_svg(test_support::grid_from_text({"..#", "..?"}),
                                   {{"astar", {{0.5, 0.5}, {1.5, 0.5}}}, {"wang", {{0.5, 0.5}, {1.5, 1.5}}}});
  EXPECT_THAT(svg, testing::StartsWith("<svg "));
  EXPECT_THAT(svg, testing::HasSubstr(">wang</text>"));
  EXPECT_THAT(svg, testing::HasSubstr("fill=\"#4a5462\""));
  EXPECT_THAT(svg, testing::EndsWith("</svg>\n"));
}

}  // namespace
}  // namespace aisle::lab
