// What the status says of a vehicle that stands.
#include "services/local-planner/core/telling.hpp"

#include <gtest/gtest.h>

#include <optional>

namespace aisle::local_planner {
namespace {

struct Standstill {
  bool is_at_limit{false};
  std::optional<Grant> grant;
  std::optional<Blocked> blocked;
  Choice choice;

  Output told(double stuck_s) const {
    Output out;
    out.phase = Phase::kDriving;
    tell_why_it_stands({is_at_limit, grant, blocked, choice, stuck_s, 3.0, 0.4}, out);
    return out;
  }
};

TEST(WhyItStands, IsWhatIsNotGrantedAndForWhomItWaits) {
  Standstill stands;
  stands.is_at_limit = true;
  EXPECT_EQ(stands.told(0.0).phase, Phase::kWaiting);
  EXPECT_EQ(stands.told(0.0).reason, Reason::kNoGrant);
  EXPECT_EQ(stands.told(0.0).detail, "nothing is granted yet");
  stands.grant = Grant{};
  EXPECT_EQ(stands.told(0.0).detail, "the granted road ends here");
  stands.grant->waits_for = {"agv-2", "agv-3"};
  EXPECT_EQ(stands.told(0.0).detail, "for agv-2, agv-3");
  stands.grant->reason = "goal taken by agv-7";
  EXPECT_EQ(stands.told(0.0).detail, "for agv-2, agv-3: goal taken by agv-7");
  stands.grant->waits_for.clear();
  EXPECT_EQ(stands.told(0.0).detail, "goal taken by agv-7");
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
  stands.blocked->thing = Disc{{4.9, 1.1}, 0.2};
  EXPECT_EQ(stands.told(3.1).blocked_at_in_map, (geometry::Point2{4.9, 1.1})) << "the thing itself";
  EXPECT_DOUBLE_EQ(stands.told(3.1).blocked_radius_m, 0.2);
  stands.blocked->vehicle_id = "agv-3";
  EXPECT_EQ(stands.told(3.1).reason, Reason::kVehicle);
  EXPECT_EQ(stands.told(3.1).detail, "no way around agv-3");
}

TEST(WhyItStands, IsWhoeverRefusesEverySpeed) {
  Standstill stands;
  EXPECT_EQ(stands.told(1.0).reason, Reason::kNone);
  stands.choice.rejected[static_cast<std::size_t>(Obstruction::kMover)] = 1;
  EXPECT_EQ(stands.told(0.4).reason, Reason::kNone) << "it has just stopped";
  EXPECT_EQ(stands.told(1.0).reason, Reason::kObstacle);
  stands.choice.rejected[static_cast<std::size_t>(Obstruction::kPeer)] = 1;
  EXPECT_EQ(stands.told(1.0).reason, Reason::kVehicle);
}

}  // namespace
}  // namespace aisle::local_planner
