// The speed of a cycle that drives by the dynamic window, and what its status says.
#include "services/local-planner/core/speed_choice.hpp"

#include <gtest/gtest.h>

#include "services/local-planner/core/target.hpp"
#include "services/local-planner/core/telling.hpp"
#include "tests/unit/local-planner/stage.hpp"

namespace aisle::local_planner {
namespace {

class SpeedOf : public testing::Test {
 protected:
  SpeedChoice choose(bool stays_here = false) const {
    const Moment moment = stage.moment();
    return choose_speed({moment, scene(moment), aim(), 0.0, stays_here, braking}, wang(), DwaSettings{});
  }
  Output told(bool backs_off, bool leaves_lane, double mover_gap_m = 0.6) const {
    const Moment moment = stage.moment();
    SpeedChoice speed = choose();
    speed.choice.mover_gap_m = mover_gap_m;
    return told_driving({scene(moment), speed, backs_off, leaves_lane});
  }
  void add_walker(geometry::Point2 position, geometry::Point2 velocity) {
    Mover walker;
    walker.position_in_map = position;
    walker.velocity_in_map = velocity;
    stage.around.movers.push_back(walker);
  }

  Stage stage;
  geometry::Twist2 braking{0.0, 0.123, 0.0};  // told from all that the window samples

 private:
  Scene scene(const Moment& moment) const {
    return {*stage.inputs.clearance, stage.motion.base_then,    {},  moment.discs.radius_m, moment.vehicle.limits, 1.0,
            stage.around.movers,     stage.around.peer_motions, 0.0, moment.discs.ahead_m};
  }
  static Aim aim() {
    Aim aim;
    aim.target_in_map = {5.0, 5.0};
    return aim;
  }
};

TEST_F(SpeedOf, IsTheWindowsBestWhereThereIsRoom) {
  const SpeedChoice speed = choose();
  EXPECT_GT(speed.wanted.linear_mps, 0.1);
  EXPECT_EQ(speed.grade, Grade::kNone);
  EXPECT_FALSE(speed.is_refused_by_people);
}

TEST_F(SpeedOf, IsNoneWhileItStaysBeforeWhatObstructsItsWay) { EXPECT_TRUE(is_zero(choose(true).wanted)); }

TEST_F(SpeedOf, IsRefusedByPeopleWhoWalkBy) {
  for (const double y : {4.3, 5.0, 5.7}) add_walker({3.75, y}, {-0.3, 0.0});
  const SpeedChoice speed = choose();
  EXPECT_LE(speed.wanted.linear_mps, kStandingMps);
  EXPECT_NE(speed.grade, Grade::kNone);
  EXPECT_TRUE(speed.is_refused_by_people);
}

TEST_F(SpeedOf, TheStatusSaysThatItDrives) {
  const Output out = told(false, false);
  EXPECT_EQ(out.phase, Phase::kDriving);
  EXPECT_EQ(out.detail, "");
  EXPECT_GT(out.twist.linear_mps, 0.1);
}

TEST_F(SpeedOf, TheStatusSaysThatItAvoidsWhileItLeavesItsLaneOrSomethingIsNear) {
  EXPECT_EQ(told(false, true).phase, Phase::kAvoiding);
  EXPECT_EQ(told(false, false, 0.3).phase, Phase::kAvoiding);
}

TEST_F(SpeedOf, TheStatusSaysThatItBacksOff) { EXPECT_EQ(told(true, true).detail, "recovers: backs off"); }

TEST(ToldOffPath, AsksForAnotherPlanFromWhereItIs) {
  const Output out = told_off_path({3.0, 5.0});
  EXPECT_EQ(out.phase, Phase::kBlocked);
  EXPECT_EQ(out.reason, Reason::kOffPath);
  EXPECT_EQ(out.blocked_at_in_map, (geometry::Point2{3.0, 5.0}));
  EXPECT_TRUE(is_zero(out.twist));
}

}  // namespace
}  // namespace aisle::local_planner
