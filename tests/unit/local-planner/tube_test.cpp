// What keeps to the floor that is held for a vehicle.
#include "services/local-planner/core/tube.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "services/local-planner/core/dwa.hpp"
#include "tests/unit/local-planner/hall.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Point2;
using geometry::Twist2;

const std::vector<Point2> kAlongX{{2.0, 5.0}, {10.0, 5.0}};

TEST(OffPath, IsTheDistanceOfADiscFromTheNearestPoint) {
  EXPECT_NEAR(off_path_m(kAlongX, {4.0, 5.3, 2.0}, {0.0}, true), 0.3, 1e-9);
  EXPECT_DOUBLE_EQ(off_path_m(kAlongX, {13.0, 9.0, 0.0}, {0.0}, true), 5.0) << "beyond its end";
  EXPECT_NEAR(off_path_m({{2.0, 5.0}}, {2.0, 5.2, 0.0}, {0.0, 1.0}, false), 0.2, 1e-9) << "a point";
}

TEST(OffPath, OfALongVehicleCountsHowItIsTurned) {
  const std::vector<double> discs{-0.5, 0.5, 1.5};
  EXPECT_NEAR(off_path_m(kAlongX, {4.0, 5.0, 0.1}, discs, false), 0.15, 1e-3);
  EXPECT_NEAR(off_path_m(kAlongX, {4.0, 5.0, 0.1}, discs, true), 0.0, 1e-9) << "it may turn anywhere";
}

TEST(OffPath, OnAnArcOfFewPointsTheHeadingIsTheArcs) {
  std::vector<Point2> arc;
  for (double yaw = 0.0; yaw < 1.6; yaw += 0.2) arc.push_back({2.0 * std::sin(yaw), 2.0 - 2.0 * std::cos(yaw)});
  for (double yaw = 0.3; yaw < 1.1; yaw += 0.05) {
    const geometry::Pose2 on_it{2.0 * std::sin(yaw), 2.0 - 2.0 * std::cos(yaw), yaw};
    EXPECT_LT(off_path_m(arc, on_it, {-0.5, 0.5, 1.4}, false), 0.03) << yaw;
  }
}

TEST(TubeAlong, ReachesAsFarAsTheVehicleMayGo) {
  const Route lane(resample(kAlongX, 0.2));
  EXPECT_NEAR(tube_along(lane, 3.0, 100.0, 0.1).path_in_map.back().x, 6.5, 1e-9);
  EXPECT_NEAR(tube_along(lane, 3.0, 3.4, 0.1).path_in_map.back().x, 5.4, 1e-9);
  EXPECT_NEAR(tube_along(lane, 3.0, 3.4, 0.1).path_in_map.front().x, 4.5, 1e-9);
}

class KeepingToATube : public testing::Test {
 protected:
  Scene scene(geometry::Pose2 base, Twist2 twist) const {
    Scene scene{clearance, base, twist, 0.35, {}, 1.2, movers, peers};
    scene.tube = &tube;
    return scene;
  }
  bool keeps(geometry::Pose2 base, Twist2 twist, Twist2 wanted) const {
    const Scene at = scene(base, twist);
    return TubeKeeping(at, tube, DwaSettings{}).to(wanted);
  }

  grid::ClearanceField clearance{hall(20.0, 10.0)};
  std::vector<Mover> movers;
  std::vector<PeerMotion> peers;
  Tube tube{kAlongX, 0.1};
};

TEST_F(KeepingToATube, StraightOnAlongThePath) {
  EXPECT_TRUE(keeps({4.0, 5.0, 0.0}, {1.2, 0.0, 0.0}, {1.2, 0.0, 0.0}));
}

TEST_F(KeepingToATube, NotInABendThatBrakingWouldLeaveItOn) {
  EXPECT_FALSE(keeps({4.0, 5.0, 0.0}, {1.2, 0.8, 0.0}, {1.2, 0.8, 0.0}));
  EXPECT_TRUE(keeps({4.0, 5.0, 0.0}, {0.2, 0.3, 0.0}, {0.2, 0.3, 0.0})) << "it stands sooner";
}

TEST_F(KeepingToATube, NotBeyondTheEndOfWhatIsGranted) {
  EXPECT_FALSE(keeps({9.5, 5.0, 0.0}, {1.2, 0.0, 0.0}, {1.2, 0.0, 0.0}));
  EXPECT_TRUE(keeps({9.5, 5.0, 0.0}, {0.6, 0.0, 0.0}, {0.4, 0.0, 0.0}));
}

TEST_F(KeepingToATube, TurnsOnTheSpotAnywhere) { EXPECT_TRUE(keeps({4.0, 5.05, 2.0}, {}, {0.0, 1.0, 0.0})); }

TEST_F(KeepingToATube, OutOfItOnlyTowardsIt) {
  EXPECT_TRUE(keeps({4.0, 5.3, -0.5}, {}, {0.3, 0.0, 0.0}));
  EXPECT_FALSE(keeps({4.0, 5.3, 0.5}, {}, {0.3, 0.0, 0.0}));
}

TEST_F(KeepingToATube, AVehicleThatCannotTurnOnTheSpotMaySwingOutABit) {
  Scene at = scene({4.0, 5.09, -0.1}, {});
  at.limits.model = kinematics::Model::kTricycle;
  at.discs_ahead_m = {0.0, 1.0};
  EXPECT_TRUE(TubeKeeping(at, tube, DwaSettings{}).to({0.3, 0.0, 0.0}));
  at.base_in_map = {4.0, 5.6, 0.3};
  EXPECT_FALSE(TubeKeeping(at, tube, DwaSettings{}).to({0.3, 0.0, 0.0})) << "far out it comes no farther";
}

TEST_F(KeepingToATube, TheWindowTakesOnlyWhatKeepsToTheTube) {
  Aim aim;
  aim.target_in_map = {5.0, 5.8};  // beside the path
  const Scene at = scene({4.0, 5.0, 0.0}, {1.2, 0.3, 0.0});
  const Choice choice = choose(at, aim, wang(), {});
  ASSERT_TRUE(choice.found);
  EXPECT_GT(choice.rejected_by(Obstruction::kTube), 0);
  EXPECT_TRUE(keeps(at.base_in_map, at.twist, choice.twist));

  Scene free = at;
  free.tube = nullptr;
  EXPECT_EQ(choose(free, aim, wang(), {}).rejected_by(Obstruction::kTube), 0);
}

}  // namespace
}  // namespace aisle::local_planner
