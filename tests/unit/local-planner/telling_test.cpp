// What the status says of a vehicle that stands.
#include "services/local-planner/core/telling.hpp"

#include <gtest/gtest.h>

#include <optional>

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

}  // namespace
}  // namespace aisle::local_planner
