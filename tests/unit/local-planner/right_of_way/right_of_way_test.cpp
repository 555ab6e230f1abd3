// Where a vehicle's way leads among others, over some cycles with invented times.
#include "services/local-planner/core/right_of_way/right_of_way.hpp"

#include <gtest/gtest.h>

#include "tests/unit/local-planner/stage.hpp"

namespace aisle::local_planner {
namespace {

class Among : public testing::Test {
 protected:
  explicit Among(const grid::OccupancyGrid& grid = hall(20.0, 10.0))
      : stage({3.0, 5.0, 0.0}, grid), way(stage.straight_way()) {
    right_of_way.begin();
    stuck.begin(kStart);
  }

  Ruling rule(double later_s) { return right_of_way.rule(stage.moment(later_s), stage.around, {}, way, stuck); }

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
  RightOfWay right_of_way{Settings{}, true};
};

class AmongInAnAisle : public Among {
 protected:
  AmongInAnAisle() : Among(aisle(1.2)) {}
};

TEST_F(Among, AloneItMayDriveAllItsWay) {
  const Ruling ruling = rule(0.0);
  EXPECT_TRUE(std::isinf(ruling.stop_at_m));
  EXPECT_TRUE(ruling.events.empty());
  EXPECT_TRUE(std::isinf(right_of_way.claim_end_m(ruling.advice, way)));
  EXPECT_GT(way.speed_at(1.0), 0.0) << "the way has its profile";
}

TEST_F(Among, ADetourIsSplicedIntoTheWay) {
  stage.around.add_standing({{5.0, 5.0}, 0.3}, {});
  const Ruling ruling = rule(0.0);
  ASSERT_EQ(ruling.events.size(), 1U);
  EXPECT_EQ(ruling.events[0].text, "detour around an obstacle");
  EXPECT_TRUE(way.is_on_detour());
  EXPECT_EQ(right_of_way.blocking(way), nullptr);
}

TEST_F(AmongInAnAisle, StopsAndEndsItsClaimBeforeWhatClosesTheWay) {
  stage.around.add_standing({{6.0, 5.0}, 0.3}, {});
  const Ruling ruling = rule(0.0);
  ASSERT_NE(right_of_way.blocking(way), nullptr);
  const double begin_m = right_of_way.blocking(way)->where.begin_m;
  EXPECT_NEAR(ruling.stop_at_m, begin_m - 0.1, 1e-9);
  EXPECT_NEAR(right_of_way.claim_end_m(ruling.advice, way), begin_m, 1e-9);
}

TEST_F(Among, StepsAsideForAPeerThatGoesFirstAndComesBack) {
  stage.around.peers = {stage.peer("agv-0", {7.0, 5.0}, {1.0, 5.0})};
  EXPECT_TRUE(stand(0.0, 0.9).empty());
  EXPECT_EQ(rule(0.9).stop_at_m, way.s_m()) << "it stays where it is asked for room";
  const std::vector<std::string> told = stand(1.0, 2.5);
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0], "steps aside for agv-0");
  ASSERT_TRUE(way.is_aside());
  EXPECT_FALSE(right_of_way.backs_off(way)) << "that is a courtesy";

  stage.around.peers.clear();
  const geometry::Point2 there = way.current().points().back();
  stage.place({there.x, there.y, 0.0});
  way.progress(there);
  way.progress(there);
  rule(3.0);
  EXPECT_FALSE(way.is_aside());
}

TEST_F(Among, ComesBackFromAPlaceThatItDoesNotReach) {
  stage.around.peers = {stage.peer("agv-0", {7.0, 5.0}, {1.0, 5.0})};
  stand(0.0, 2.5);
  ASSERT_TRUE(way.is_aside());
  stage.around.peers.clear();
  stand(3.0, 20.0);
  EXPECT_TRUE(way.is_aside());
  stand(20.0, 23.0);
  EXPECT_FALSE(way.is_aside());
}

TEST_F(Among, BacksOffWhereTryingDoesNotHelp) {
  const std::vector<std::string> told = stand(0.0, 12.0);
  ASSERT_FALSE(told.empty());
  EXPECT_EQ(told[0], "backs off to try again");
  EXPECT_TRUE(right_of_way.backs_off(way));
}

TEST_F(AmongInAnAisle, DoesNotBackOffFromWhatClosesTheWay) {
  stage.around.add_standing({{5.0, 5.0}, 0.3}, {});
  EXPECT_TRUE(stand(0.0, 20.0).empty());
  EXPECT_FALSE(way.is_aside());
}

TEST(RightOfWayOfAPlannerWithoutAPath, MakesNoDetours) {
  Stage stage;
  Way way = stage.straight_way();
  Stuck stuck;
  stuck.begin(kStart);
  RightOfWay right_of_way(Settings{}, false);
  stage.around.add_standing({{5.0, 5.0}, 0.3}, {});
  right_of_way.rule(stage.moment(), stage.around, {}, way, stuck);
  EXPECT_FALSE(way.is_on_detour());
}

}  // namespace
}  // namespace aisle::local_planner
