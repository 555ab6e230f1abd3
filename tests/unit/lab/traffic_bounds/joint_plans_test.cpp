#include "tools/lab/traffic_bounds/joint_plans.hpp"

#include <gtest/gtest.h>

#include "tests/unit/lab/traffic_bounds/small_floor.hpp"

namespace aisle::lab {
namespace {

TEST(JointPlans, OneVehicleIsPlannedAsAlone) {
  const FloorModel model(small_floor());
  const JointPlans plans = plan_from_nothing(model, draw_fleet(model, 1, 1, 60.0));

  EXPECT_EQ(plans.planned, 1U);
  EXPECT_GT(plans.ends_s, 0.0);
  EXPECT_DOUBLE_EQ(plans.stretch(), 1.0);
}

TEST(JointPlans, SeveralTakeNoLessThanEachAlone) {
  const FloorModel model(small_floor());
  const JointPlans plans = plan_from_nothing(model, draw_fleet(model, 1, 4, 60.0));

  EXPECT_EQ(plans.planned, 4U);
  EXPECT_GE(plans.stretch(), 1.0 - 1e-9);
}

}  // namespace
}  // namespace aisle::lab
