// Where a vehicle's way leads around what stands there, over some cycles with invented times.
#include "services/local-planner/core/avoidance.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/local-planner/stage.hpp"

namespace aisle::local_planner {
namespace {

class Avoiding : public testing::Test {
 protected:
  explicit Avoiding(const grid::OccupancyGrid& grid = hall(20.0, 10.0))
      : stage({3.0, 5.0, 0.0}, grid), way(stage.straight_way()) {
    avoidance.begin();
    stuck.begin(kStart);
  }

  Ruling rule(double later_s) { return avoidance.rule(stage.moment(later_s), stage.around, leave, way, stuck); }

  /// Cycles while the vehicle stands, one every 0.1 s. @returns what happened
  std::vector<std::string> stand(double from_s, double to_s) {
    std::vector<std::string> told;
    for (double t = from_s; t <= to_s; t += 0.1)
      for (const Event& event : rule(t).events) told.push_back(event.text);
    return told;
  }

  Stage stage;
  Way way;
  Stuck stuck;
  Leave leave;
  Avoidance avoidance{Settings{}, true};
};

class AvoidingInAnAisle : public Avoiding {
 protected:
  AvoidingInAnAisle() : Avoiding(aisle(1.2)) {}
};

TEST_F(Avoiding, AloneItMayDriveAllItsWay) {
  const Ruling ruling = rule(0.0);
  EXPECT_TRUE(std::isinf(ruling.stop_at_m));
  EXPECT_TRUE(ruling.events.empty());
  EXPECT_GT(way.speed_at(1.0), 0.0) << "the way has its profile";
}

TEST_F(Avoiding, StopsWhereItsRoadEnds) {
  leave.stop_at_m = 4.0;
  EXPECT_DOUBLE_EQ(rule(0.0).stop_at_m, 4.0);
}

TEST_F(Avoiding, ADetourIsSplicedIntoTheWay) {
  stage.around.add_standing({{5.0, 5.0}, 0.3}, {});
  const Ruling ruling = rule(0.0);
  ASSERT_EQ(ruling.events.size(), 1U);
  EXPECT_EQ(ruling.events[0].text, "detour around an obstacle");
  EXPECT_TRUE(way.is_on_detour());
  EXPECT_EQ(avoidance.blocking(way), nullptr);
}

TEST_F(Avoiding, InATubeItStopsBeforeWhatStandsThere) {
  stage.around.add_standing({{5.0, 5.0}, 0.3}, {});
  leave.is_in_tube = true;
  const Ruling ruling = rule(0.0);
  EXPECT_FALSE(way.is_on_detour());
  ASSERT_NE(avoidance.blocking(way), nullptr);
  EXPECT_LT(ruling.stop_at_m, 2.0 - 0.65);
}

TEST_F(AvoidingInAnAisle, StopsBeforeWhatClosesTheWay) {
  stage.around.add_standing({{6.0, 5.0}, 0.3}, {});
  const Ruling ruling = rule(0.0);
  ASSERT_NE(avoidance.blocking(way), nullptr);
  const double begin_m = avoidance.blocking(way)->where.begin_m;
  EXPECT_NEAR(ruling.stop_at_m, begin_m - 0.1, 1e-9);
}

TEST_F(Avoiding, BacksOffWhereTryingDoesNotHelp) {
  const std::vector<std::string> told = stand(0.0, 12.0);
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told[0], "backs off to try again");
  EXPECT_TRUE(way.backs_off());
  EXPECT_GE(way.current().length_m(), 0.7);
}

TEST_F(Avoiding, ComesBackFromThere) {
  stand(0.0, 12.0);
  ASSERT_TRUE(way.backs_off());
  const geometry::Point2 there = way.current().points().back();
  stage.place({there.x, there.y, 0.0});
  way.progress(there);
  way.progress(there);
  rule(12.1);
  EXPECT_FALSE(way.backs_off());
}

TEST_F(Avoiding, ComesBackFromAPlaceThatItDoesNotReach) {
  stand(0.0, 9.0);
  ASSERT_TRUE(way.backs_off());
  stand(9.0, 25.0);
  EXPECT_TRUE(way.backs_off());
  stand(25.0, 29.5);
  EXPECT_FALSE(way.backs_off());
}

TEST_F(Avoiding, NeverBacksOffInATubeNorWhereItWaitsForRoad) {
  leave.is_in_tube = true;
  EXPECT_TRUE(stand(0.0, 20.0).empty());
  leave = {0.05, false};
  EXPECT_TRUE(stand(20.0, 40.0).empty());
}

TEST_F(AvoidingInAnAisle, DoesNotBackOffFromWhatClosesTheWay) {
  stage.around.add_standing({{5.0, 5.0}, 0.3}, {});
  EXPECT_TRUE(stand(0.0, 20.0).empty());
  EXPECT_FALSE(way.backs_off());
}

TEST_F(Avoiding, AWayBackLeadsToNoPeer) {
  PeerMotion peer;
  for (const double x : {2.0, 4.0}) {
    peer.stopping_in_map = {{x, 5.0}};
    stage.around.peer_motions.push_back(peer);
  }
  const auto points = way_back(stage.moment(), stage.around, way);
  ASSERT_GE(points.size(), 2U);
  EXPECT_GT(std::abs(points.back().y - 5.0), 0.5);
  stage.inputs.vehicle = forklift();
  EXPECT_TRUE(way_back(stage.moment(), stage.around, way).empty());
}

TEST(AvoidanceOfAPlannerWithoutAPath, MakesNoDetours) {
  Stage stage;
  Way way = stage.straight_way();
  Stuck stuck;
  stuck.begin(kStart);
  Avoidance avoidance(Settings{}, false);
  stage.around.add_standing({{5.0, 5.0}, 0.3}, {});
  avoidance.rule(stage.moment(), stage.around, {}, way, stuck);
  EXPECT_FALSE(way.is_on_detour());
}

}  // namespace
}  // namespace aisle::local_planner
