// A path and a drive as rows: waypoints, speeds, clearances, times.
#include <gmock/gmock.h>

#include "tests/support/ascii_grid.hpp"
#include "tools/lab/driving/map_drive.hpp"
#include "tools/lab/sweep/drive_rows.hpp"
#include "tools/lab/sweep/plan_rows.hpp"
#include "tools/sim/site.hpp"

namespace aisle::lab {
namespace {

const std::vector<std::string> kHall{"..........", "..........", "....##....", "..........", ".........."};

TEST(PlanRows, HaveTheFiguresAndEachWaypoint) {
  const grid::ClearanceField clearance(test_support::grid_from_text(kHall), 5.0);
  OfflineTask task;
  task.queries = {{{1.5, 2.5}, {8.5, 2.5}, 0.0}};

  std::vector<Row> rows;
  plan_offline(
      task, {global_planner::find_variant("wang")}, clearance, [] { return false; },
      [&](const OfflineAnswer& answer) { rows = plan_rows(answer, clearance); });

  ASSERT_GE(rows.size(), 4U) << "the figures, the ends, and a turn around the block";
  EXPECT_EQ(rows[0]["kind"], "plan");
  EXPECT_EQ(rows[0]["nodes"], rows.size() - 1);
  EXPECT_EQ(rows[1]["x_m"], 1.5);
  EXPECT_EQ(rows.back()["x_m"], 8.5);
  EXPECT_EQ(rows.back()["yaw_rad"], rows[rows.size() - 2]["yaw_rad"]) << "at the goal as on the last leg";
  for (std::size_t i = 1; i < rows.size(); ++i) EXPECT_GT(rows[i]["clearance_m"].get<double>(), 0.0);
}

TEST(PlanRows, OfAPathThatWasNotFoundHaveNoFigures) {
  const grid::ClearanceField clearance(test_support::grid_from_text(kHall), 5.0);
  OfflineTask task;
  task.queries = {{{1.5, 2.5}, {4.5, 2.5}, 0.0}};

  std::vector<Row> rows;
  plan_offline(
      task, {global_planner::find_variant("astar")}, clearance, [] { return false; },
      [&](const OfflineAnswer& answer) { rows = plan_rows(answer, clearance); });

  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0]["outcome"], "goal_blocked");
  EXPECT_TRUE(rows[0]["length_m"].is_null());
}

TEST(DriveRows, HaveARowACycleAndThePlan) {
  const Subject subject{test_support::grid_from_text(kHall), {{{1.5, 3.5}, {8.5, 3.5}, 0.0}}};
  sim::Setup setup = map_setup("hall", subject, subject.queries.front(), 0.35);
  setup.planner = "astar";

  DriveRows rows(setup, 3);
  sim::Hooks hooks;
  hooks.on_cycle = [&](const sim::Cycle& cycle) { rows.take(cycle); };
  const sim::Outcome outcome = sim::drive(setup, {}, hooks);
  ASSERT_EQ(outcome.result.goals_reached, 1);
  EXPECT_EQ(outcome.result.trace_hash, sim::drive(setup).result.trace_hash) << "looking changes nothing";

  double fastest_mps = 0.0;
  double before_s = -1.0;
  int cycles = 0, waypoints = 0;
  for (const Row& row : rows.rows()) {
    EXPECT_EQ(row["query"], 3U) << "a waypoint, too, says which query it is of";
    if (row["kind"] == "waypoint") ++waypoints;
    if (row["kind"] != "cycle") continue;
    ++cycles;
    EXPECT_GT(row["t_s"].get<double>(), before_s);
    EXPECT_GT(row["clearance_m"].get<double>(), 0.0);
    EXPECT_LE(row["clearance_m"].get<double>(), DriveRows::kLookM);
    EXPECT_GE(row["compute_us"].get<double>(), 0.0);
    before_s = row["t_s"];
    fastest_mps = std::max(fastest_mps, row["v_mps"].get<double>());
  }
  EXPECT_GT(fastest_mps, 0.5);
  EXPECT_GE(waypoints, 2);
  EXPECT_GT(cycles, 40 * outcome.result.driven_s) << "fifty a second";
}

}  // namespace
}  // namespace aisle::lab
