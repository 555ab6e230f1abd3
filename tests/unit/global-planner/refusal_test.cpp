#include "services/global-planner/core/refusal.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>
#include <vector>

#include "services/global-planner/core/variant.hpp"
#include "tests/support/ascii_grid.hpp"

namespace aisle::global_planner {
namespace {

using geometry::Point2;
using test_support::find_letter;

const std::vector<std::string> kTwoRooms{"............", ".......#....", ".S.....#..G.", ".......#....",
                                         "............", "############", "...P........"};

struct Case {
  const char* what;
  Point2 start, goal;
  double radius_m;
  Refusal refusal;
};

TEST(Refusal, EachWrongInputHasItsOwnNameAndOneLine) {
  const grid::ClearanceField clearance(test_support::grid_from_text(kTwoRooms), 10.0);
  const Point2 s = find_letter(kTwoRooms, 'S');
  const Point2 g = find_letter(kTwoRooms, 'G');
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Case> cases{{"start in a wall", {7.5, 4.5}, g, 0.0, Refusal::kStartInObstacle},
                                {"goal in a wall", s, {7.5, 4.5}, 0.0, Refusal::kGoalInObstacle},
                                {"start outside", {-1.0, 4.5}, g, 0.0, Refusal::kStartOutOfMap},
                                {"goal outside", s, {3.0, 1e9}, 0.0, Refusal::kGoalOutOfMap},
                                {"start NaN", {nan, 4.5}, g, 0.0, Refusal::kNotFinite},
                                {"radius NaN", s, g, nan, Refusal::kNotFinite},
                                {"start in a nook", {0.5, 4.5}, g, 1.2, Refusal::kStartTooTight},
                                {"goal in a nook", s, {11.5, 4.5}, 1.2, Refusal::kGoalTooTight},
                                {"every gap too narrow", s, g, 0.6, Refusal::kTooWide},
                                {"walled off", s, find_letter(kTwoRooms, 'P'), 0.0, Refusal::kNoWay}};
  for (const Variant& variant : all_variants()) {
    std::set<std::string> lines;
    for (const Case& c : cases) {
      const Problem problem{clearance, c.start, c.goal, c.radius_m};
      const PlannedPath plan = variant.make()->plan(problem, nullptr);
      ASSERT_NE(plan.outcome, Outcome::kFound) << variant.name << ": " << c.what;
      const RefusalReport report = explain(problem, plan.outcome, nullptr);
      EXPECT_STREQ(name(report.refusal), name(c.refusal)) << variant.name << ": " << c.what;
      EXPECT_EQ(report.line.find('\n'), std::string::npos);
      EXPECT_TRUE(lines.insert(report.line).second) << c.what << " says what another says: " << report.line;
    }
  }
}

TEST(Refusal, SaysHowWideTheWayIs) {
  const grid::ClearanceField clearance(test_support::grid_from_text(kTwoRooms), 10.0);
  const Problem problem{clearance, find_letter(kTwoRooms, 'S'), find_letter(kTwoRooms, 'G'), 0.6};
  EXPECT_DOUBLE_EQ(widest_way_m(problem, nullptr), 0.5);
  EXPECT_NE(explain(problem, Outcome::kNoPath, nullptr).line.find("0.50 m pass"), std::string::npos);
}

}  // namespace
}  // namespace aisle::global_planner
