// What the status says of a vehicle that stands, and the way that it claims.
#include "services/local-planner/core/telling.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <optional>

#include "tests/unit/local-planner/hall.hpp"

namespace aisle::local_planner {
namespace {

struct Standstill {
  Advice advice;
  std::optional<Blocked> blocked;
  Choice choice;

  Output told(double stuck_s) const {
    Output out;
    out.phase = Phase::kDriving;
    tell_why_it_stands({advice, blocked, choice, stuck_s, 3.0, 0.4}, out);
    return out;
  }
};

TEST(WhyItStands, IsWhomItWaitsFor) {
  Standstill stands;
  stands.advice.yields_to = "agv-2";
  EXPECT_EQ(stands.told(0.0).phase, Phase::kWaiting);
  EXPECT_EQ(stands.told(0.0).reason, Reason::kYielding);
  EXPECT_EQ(stands.told(0.0).detail, "yields to agv-2");
  stands.advice.follows = true;
  EXPECT_EQ(stands.told(0.0).reason, Reason::kVehicle);
  EXPECT_EQ(stands.told(0.0).detail, "behind agv-2");
}

TEST(WhyItStands, IsWhatClosesTheWayWithItsPlaceAfterAWhile) {
  Standstill stands;
  stands.blocked = Blocked{{4.0, 5.0, {4.2, 1.0}}, {}};
  EXPECT_EQ(stands.told(2.9).phase, Phase::kDriving);
  const Output out = stands.told(3.1);
  EXPECT_EQ(out.phase, Phase::kBlocked);
  EXPECT_EQ(out.reason, Reason::kObstacle);
  EXPECT_EQ(out.blocked_at_in_map, (geometry::Point2{4.2, 1.0}));
  EXPECT_DOUBLE_EQ(out.blocked_radius_m, 0.4);
  stands.blocked->vehicle_id = "agv-3";
  EXPECT_EQ(stands.told(3.1).reason, Reason::kVehicle);
  EXPECT_EQ(stands.told(3.1).detail, "no way around agv-3");
}

TEST(WhyItStands, IsWhoeverRefusesEverySpeed) {
  Standstill stands;
  EXPECT_EQ(stands.told(1.0).reason, Reason::kNone);
  stands.choice.rejected[static_cast<int>(Obstruction::kMover)] = 1;
  EXPECT_EQ(stands.told(0.4).reason, Reason::kNone) << "it has just stopped";
  EXPECT_EQ(stands.told(1.0).reason, Reason::kObstacle);
  stands.choice.rejected[static_cast<int>(Obstruction::kPeer)] = 1;
  EXPECT_EQ(stands.told(1.0).reason, Reason::kVehicle);
}

class ClaimedWay : public testing::Test {
 protected:
  ClaimedWay() {
    way.adopt(Route(resample({{2.0, 5.0}, {38.0, 5.0}}, 0.2)), {2.0, 5.0}, false);
    way.profile(clearance, 0.35, {1.0, 1.2, 0.6, 0.6, true});
  }
  grid::ClearanceField clearance{hall(40.0, 10.0)};
  Way way;
};

TEST_F(ClaimedWay, ReachAsFarAsTheyMayAndTellTheTimeToTheEnd) {
  const Claim claim = claim_of(way, 1e18);
  ASSERT_FALSE(claim.points.empty());
  EXPECT_LE(claim.points.size(), 62u);
  EXPECT_NEAR(claim.points.back().base_in_map.x, 26.0, 1e-6);
  EXPECT_GT(claim.time_left_s, claim.points.back().offset_s + 10.0);
  EXPECT_LT(claim.time_left_s, 45.0);
}

TEST_F(ClaimedWay, EndWhereItMustStop) {
  const Claim claim = claim_of(way, 3.0);
  ASSERT_FALSE(claim.points.empty());
  EXPECT_NEAR(claim.points.back().base_in_map.x, 5.0, 1e-6);
  EXPECT_TRUE(claim_of(way, 0.0).points.empty());
  for (std::size_t i = 1; i < claim.points.size(); ++i)
    EXPECT_GT(claim.points[i].offset_s, claim.points[i - 1].offset_s);
}

}  // namespace
}  // namespace aisle::local_planner
