#include <gmock/gmock.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "tools/referee/core/judge.hpp"
#include "tools/referee/report/fleet_svg.hpp"
#include "tools/referee/report/report_json.hpp"
#include "tools/referee/report/speeds_svg.hpp"
#include "tools/referee/report/summary.hpp"
#include "tools/referee/report/write_report.hpp"

namespace aisle::referee {
namespace {

using geometry::Point2;
using geometry::Pose2;
using ::testing::HasSubstr;
using ::testing::Not;

grid::OccupancyGrid rack_hall() {
  grid::OccupancyGrid map({400, 250, 0.1, {0.0, 0.0}});
  const auto fill = [&](int x0, int y0, int x1, int y1) {
    for (int y = y0; y < y1; ++y) {
      for (int x = x0; x < x1; ++x) map.set({x, y}, grid::Occupancy::kOccupied);
    }
  };
  fill(0, 0, 400, 2);
  fill(0, 248, 400, 250);
  fill(0, 0, 2, 250);
  fill(398, 0, 400, 250);
  for (int row = 0; row < 5; ++row) {
    for (int half = 0; half < 2; ++half) fill(60 + half * 160, 40 + row * 38, 180 + half * 160, 52 + row * 38);
  }
  return map;
}

/// Five vehicles on smooth loops, a person, a block, an edit, and one contact: invented figures for the writers.
RunReport invented_run(const Walls& walls) {
  Judge judge(&walls, {{{"agv-1", 2}, {"agv-2", 2}, {"agv-3", 2}, {"agv-4", 2}, {"agv-5", 2}}});
  const auto drives = [](int i, double t_s) {
    const double phase = 0.25 * t_s * (i % 2 == 0 ? 1.0 : -1.0) + i;
    return Pose2{20.0 + (8.0 + i) * std::cos(phase), 12.5 + (3.0 + 1.6 * i) * std::sin(phase),
                 geometry::wrap(std::atan2((3.0 + 1.6 * i) * std::cos(phase), -(8.0 + i) * std::sin(phase)) +
                                (i % 2 == 0 ? 0.0 : geometry::kPi))};
  };
  for (int i = 0; i < 5; ++i) {
    for (int g = 0; g < 2; ++g) {
      GoalRecord goal;
      goal.agv_id = "agv-" + std::to_string(i + 1);
      goal.goal_id = goal.agv_id + "-" + std::to_string(g);
      goal.pose_in_map = drives(i, 10.0 + 10.0 * g);
      goal.position_tolerance_m = 0.2;
      goal.assigned_s = 10.0 * g;
      if (g == 0) judge.goal_arrived(goal, false);
    }
    PlanNews plan;
    plan.agv_id = "agv-" + std::to_string(i + 1);
    plan.plan_id = 1;
    plan.found = true;
    plan.planning_ms = 3.0 + i;
    for (int k = 0; k <= 10; ++k) plan.waypoints_in_map.push_back(drives(i, k).position() + Point2{0.3, 0.2});
    judge.plan_arrived(plan);
  }
  EditRow edit{"e1", true, {{18, 7}, {21, 7}, {21, 9.2}, {18, 9.2}}, 6'000'000'000, 6.0, -1.0, "", 0};
  judge.edit_asked(edit);
  judge.edit_answered({"e1", true, "applied", 2, 6.01});
  for (int tick = 0; tick <= 1200; ++tick) {
    const double t_s = 0.02 * tick;
    for (int i = 0; i < 5; ++i) {
      const std::string id = "agv-" + std::to_string(i + 1);
      const bool holds = i == 1 && t_s > 4.0 && t_s < 5.0;
      judge.vehicle_reported({id, 1, t_s, 1.0, holds, id, "lp", 1, 1, static_cast<std::uint64_t>(tick) + 1, 1}, 0);
      judge.body_seen({id, BodyKind::kVehicle, {0.35, 0, 0}, drives(i, t_s), 0.9 + 0.3 * std::sin(t_s + i), t_s, 1});
      judge.command_arrived(
          {id, 1'000'000'000 + tick * 20'000'000LL, 1'000'000'000 + (tick / 5) * 100'000'000LL, 2.0, t_s});
      if (t_s >= 10.0)
        judge.navigation_arrived({id, id + "-0", GoalNews::Phase::kArrived, "", t_s}, i == 2 && t_s > 12 && t_s < 15);
    }
    judge.body_seen({"person-1", BodyKind::kPerson, {0.25, 0, 0}, {2.0 + 1.2 * t_s, 9.0, 0.0}, 1.2, t_s, 1});
    judge.body_seen({"block-1", BodyKind::kBlock, {0.0, 0.8, 0.8}, {35.0, 22.0, 0.3}, 0.0, t_s, 1});
    if (tick % 5 == 0) judge.advance(t_s - 0.1);
  }
  judge.health_arrived({"map-1", "map", 1, 2.0, 18.0});
  RunReport report = judge.finish(24.0);
  report.scenario = "invented <hall>";
  report.seed = 7;
  report.ended_because = "the test said so";
  return report;
}

class Reports : public ::testing::Test {
 protected:
  grid::OccupancyGrid map_{rack_hall()};
  Walls walls_{map_};
  RunReport report_{invented_run(walls_)};
};

TEST_F(Reports, HaveEveryFieldThatReadersRelyOn) {
  const nlohmann::ordered_json json = to_json(report_);
  for (const char* key : {"scenario",
                          "seed",
                          "duration_s",
                          "vehicles",
                          "goals_assigned",
                          "goals_reached",
                          "goals_failed",
                          "contacts",
                          "contacts_moving_vehicle",
                          "least_clearance_m",
                          "distance_m",
                          "stops",
                          "replans",
                          "planning_ms_p50",
                          "planning_ms_p99",
                          "control_ms_p50",
                          "control_ms_p99",
                          "scan_to_command_ms_p50",
                          "scan_to_command_ms_p99",
                          "map_edit_to_plan_ms_p99",
                          "command_gap_ms_p50",
                          "command_gap_ms_p99",
                          "command_gap_ms_max",
                          "cpu_percent_total",
                          "contact_list",
                          "authority_violations",
                          "vehicle_rows",
                          "service_rows"}) {
    EXPECT_TRUE(json.contains(key)) << key;
  }
  EXPECT_EQ(json["vehicles"], 5);
  EXPECT_EQ(json["contacts"], report_.contacts.size());
  EXPECT_EQ(json["contact_list"].size(), report_.contacts.size());
  EXPECT_EQ(json["goals_reached"], 5);
  EXPECT_EQ(json["goals_failed"].size(), 1u);  // the five that were never given, in one row
  EXPECT_EQ(json["service_rows"][0]["resident_mb_max"], 18.0);
}

TEST_F(Reports, SayNullWhereNobodySawAFigure) {
  EXPECT_TRUE(to_json(RunReport{})["least_clearance_m"].is_null());
  EXPECT_TRUE(to_json(RunReport{})["planning_ms_p99"].is_null());
}

TEST_F(Reports, DrawEveryVehicleGoalAndContact) {
  const std::string svg = fleet_svg(report_, walls_);
  for (int i = 1; i <= 5; ++i) EXPECT_THAT(svg, HasSubstr(">agv-" + std::to_string(i) + "<"));
  EXPECT_THAT(svg, HasSubstr("invented &lt;hall&gt;"));
  ASSERT_FALSE(report_.contacts.empty());
  EXPECT_THAT(svg, HasSubstr("<title>" + report_.contacts[0].a + " and " + report_.contacts[0].b));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(speeds_svg(report_), Not(HasSubstr("nan")));
}

TEST_F(Reports, AreDrawnOfAnEmptyRunToo) {
  const Walls none(grid::OccupancyGrid({10, 10, 0.1, {0, 0}}));
  EXPECT_THAT(fleet_svg(RunReport{}, none), HasSubstr("</svg>"));
  EXPECT_THAT(speeds_svg(RunReport{}), HasSubstr("</svg>"));
  EXPECT_THAT(summary(RunReport{}), HasSubstr("goals reached"));
}

TEST(Troubles, AreALineForEachReasonNotToPass) {
  RunReport report;
  EXPECT_TRUE(report.troubles().empty());
  report.duration_s = 90.0;
  report.goals_expected = 2;
  GoalRecord goal;
  goal.agv_id = "agv-1";
  goal.goal_id = "agv-1-0";
  goal.outcome = GoalOutcome::kFailed;
  goal.reason = "no way";
  report.goals.push_back(goal);
  report.violations.push_back({AuthorityViolation::Kind::kStalePlan, "agv-2", 3.5, "obeyed plan 1 of 2"});
  EXPECT_THAT(report.troubles(),
              ::testing::ElementsAre("   3.500 VIOLATION of authority: agv-2 obeyed plan 1 of 2",
                                     "  90.000 agv-1 goal missed: agv-1-0 no way", "  90.000 goals never given: 1"));
}

TEST_F(Reports, AreWrittenWhole) {
  const char* kept = std::getenv("AISLE_TEST_OUT");
  const std::filesystem::path folder =
      kept != nullptr ? std::filesystem::path(kept)
                      : std::filesystem::temp_directory_path() / ("aisle-report-" + std::to_string(getpid()));
  write_report(report_, walls_, folder);
  std::ifstream file(folder / "report.json");
  EXPECT_EQ(nlohmann::json::parse(file)["scenario"], "invented <hall>");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 3);
  if (kept == nullptr) std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace aisle::referee
