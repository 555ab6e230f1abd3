// Places that a vehicle makes room at.
#include "services/local-planner/core/right_of_way/stepping_aside.hpp"

#include <gtest/gtest.h>

#include "tests/unit/local-planner/stage.hpp"

namespace aisle::local_planner {
namespace {

using Ids = std::vector<std::string>;
constexpr double kMarginM = 0.15;

class Aside : public testing::Test {
 protected:
  /// A peer that comes towards the vehicle at (3, 5), along its lane.
  PeerView oncoming(const std::string& id) const { return stage.peer(id, {7.0, 5.0}, {1.0, 5.0}); }
  std::vector<geometry::Point2> way_for(const Ids& for_whom) const {
    return way_aside(stage.moment(), stage.around, stage.straight_way(), for_whom, kMarginM);
  }

  Stage stage;
};

TEST_F(Aside, LeavesTheClaimOfThePeerThatAsks) {
  stage.around.peers = {oncoming("agv-2")};
  const auto way = way_for({"agv-2"});
  ASSERT_GE(way.size(), 2U);
  EXPECT_GE(std::abs(way.back().y - 5.0), 0.35 + 0.35 + kMarginM);
}

TEST_F(Aside, LeavesTheClaimsOfAllThatGoFirstAndOfNoOther) {
  stage.around.peers = {stage.peer("agv-2", {5.0, 6.0}, {1.0, 6.0}), oncoming("agv-0")};
  for (PeerView& peer : stage.around.peers) peer.radius_m = 0.3;
  const auto way = way_for({"agv-0"});
  ASSERT_GE(way.size(), 2U);
  EXPECT_GE(std::abs(way.back().y - 5.0), 0.35 + 0.3 + kMarginM);

  stage.around.peers = {oncoming("agv-2")};
  EXPECT_NEAR(geometry::distance(way_for({}).back(), {3.0, 5.0}), 0.8, 0.15) << "agv-2 does not go first";
}

TEST_F(Aside, ForNobodyIsAPlaceNotFarAway) {
  const auto way = way_for({});
  ASSERT_GE(way.size(), 2U);
  EXPECT_GE(geometry::distance(way.back(), {3.0, 5.0}), 0.7);
  EXPECT_LE(geometry::distance(way.back(), {3.0, 5.0}), 1.0);
}

TEST_F(Aside, AForkliftStaysWhereItIs) {
  stage.inputs.vehicle = forklift();
  EXPECT_TRUE(way_for({}).empty());
}

TEST_F(Aside, OnlyPeersNearHereAreGivenWay) {
  stage.around.peers = {oncoming("agv-2"), stage.peer("agv-3", {12.0, 5.0}, {1.0, 5.0})};
  Advice advice;
  advice.gives_way_to = {"agv-2", "agv-3"};
  EXPECT_EQ(asking_for_room(advice, stage.around, stage.moment()), Ids{"agv-2"});
}

TEST_F(Aside, ItIsStuckWithNearPeersThatMeanToMove) {
  stage.around.peers = {stage.peer("agv-2", {5.0, 5.0}, {1.0, 5.0}), stage.peer("agv-3", {4.0, 5.0}, {1.0, 5.0}),
                        oncoming("agv-4")};
  stage.around.peers[1].has_goal = false;
  EXPECT_EQ(stuck_with(stage.around, stage.moment()), Ids{"agv-2"});
}

}  // namespace
}  // namespace aisle::local_planner
