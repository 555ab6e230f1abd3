// Many vehicles that ask at once, and one edit that blocks the way of some of them.
#include <gtest/gtest.h>

#include <map>
#include <string>

#include "services/global-planner/core/fleet_planner.hpp"
#include "services/global-planner/core/path_checker.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

using geometry::Point2;
constexpr double kRadius_m = 0.2;
constexpr int kCrossing = 10;
constexpr int kStaying = 90;

/// A hall of 40 x 30 m with a wall at x = 20 m that has two gaps, at y = 5 and at y = 25 m.
class Crowd : public ::testing::TestWithParam<std::string> {
 protected:
  Crowd() : planner_(FleetSettings{}, find_variant(GetParam())->make()) {
    fill(20.0, 0.0, 20.2, 30.0, grid::Occupancy::kOccupied);
    fill(20.0, 4.0, 20.2, 6.0, grid::Occupancy::kFree);
    fill(20.0, 24.0, 20.2, 26.0, grid::Occupancy::kFree);
    planner_.set_map("hall", 1, grid_, {0, 0}, {399, 299});
    for (int i = 0; i < kCrossing; ++i)
      ask("crossing-" + std::to_string(i), {2.0 + 1.5 * i, 5.0}, {38.0 - 1.5 * i, 5.0});
    for (int i = 0; i < kStaying; ++i) {
      ask("staying-" + std::to_string(i), {1.0 + 1.2 * (i % 15), 8.0 + 1.2 * static_cast<double>(i / 15)},
          {18.0 - 1.2 * (i % 15), 20.0 + 1.2 * static_cast<double>(i / 15)});
    }
  }

  void fill(double x0, double y0, double x1, double y1, grid::Occupancy occupancy) {
    const grid::Cell low = grid_.geometry().cell_at({x0 + 0.01, y0 + 0.01});
    const grid::Cell high = grid_.geometry().cell_at({x1 - 0.01, y1 - 0.01});
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) grid_.set({x, y}, occupancy);
    }
  }
  void ask(const std::string& id, Point2 start, Point2 goal) {
    planner_.set_vehicle(id, kRadius_m);
    planner_.set_pose(id, {start.x, start.y, 0.0}, now_);
    planner_.set_goal({id, "goal of " + id, {goal.x, goal.y, 0.0}, 0.1, 0.0, false});
  }
  std::map<std::string, Plan> all_plans() {
    std::map<std::string, Plan> plans;
    while (auto plan = planner_.step(now_, nullptr)) {
      EXPECT_EQ(plans.count(plan->agv_id), 0U) << plan->agv_id << " was answered twice";
      plans[plan->agv_id] = *plan;
    }
    return plans;
  }
  bool is_drivable_now(const Plan& plan) const {
    const grid::ClearanceField clearance(grid_, 2.0);
    return is_drivable({clearance, plan.waypoints_in_map.front(), plan.waypoints_in_map.back(), kRadius_m},
                       plan.waypoints_in_map);
  }

  grid::OccupancyGrid grid_{grid::Geometry{400, 300, 0.1, {}}};
  FleetPlanner planner_;
  time::Stamp now_{time::from_seconds(100.0)};
};

TEST_P(Crowd, IsAnsweredOneByOneEachOnce) {
  const auto plans = all_plans();
  ASSERT_EQ(plans.size(), static_cast<std::size_t>(kCrossing + kStaying));
  for (const auto& [id, plan] : plans) {
    EXPECT_EQ(plan.outcome, PlanOutcome::kFound) << id << ": " << plan.detail;
    EXPECT_EQ(plan.trigger, PlanTrigger::kNewGoal) << id;
  }
  EXPECT_EQ(planner_.searches(), static_cast<std::uint64_t>(kCrossing + kStaying));
  EXPECT_TRUE(all_plans().empty());
}

TEST_P(Crowd, GetsNewPlansOnlyWhereAnEditBlocksTheOld) {
  const auto before = all_plans();
  ASSERT_EQ(before.size(), static_cast<std::size_t>(kCrossing + kStaying));
  fill(20.0, 4.0, 20.2, 6.0, grid::Occupancy::kOccupied);
  planner_.set_map("hall", 2, grid_, grid_.geometry().cell_at({20.05, 4.05}), grid_.geometry().cell_at({20.15, 5.95}));
  const auto after = all_plans();
  ASSERT_EQ(after.size(), before.size());
  for (const auto& [id, plan] : after) {
    const bool crosses = id.rfind("crossing", 0) == 0;
    EXPECT_EQ(plan.map_revision, 2U) << id;
    EXPECT_EQ(plan.id != before.at(id).id, crosses) << id;
    EXPECT_EQ(plan.waypoints_in_map != before.at(id).waypoints_in_map, crosses) << id;
    ASSERT_EQ(plan.outcome, PlanOutcome::kFound) << id << ": " << plan.detail;
    if (!crosses) continue;
    EXPECT_EQ(plan.trigger, PlanTrigger::kMapChanged) << id;
    EXPECT_GT(plan.length_m, before.at(id).length_m) << id;
    EXPECT_TRUE(is_drivable_now(plan)) << id;
  }
  EXPECT_EQ(planner_.searches(), static_cast<std::uint64_t>(2 * kCrossing + kStaying));
}

INSTANTIATE_TEST_SUITE_P(Planners, Crowd, ::testing::Values("wang", "jps", "astar"),
                         [](const auto& tested) { return tested.param; });

}  // namespace
}  // namespace aisle::global_planner
