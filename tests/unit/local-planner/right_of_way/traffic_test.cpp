#include "services/local-planner/core/right_of_way/traffic.hpp"

#include <gtest/gtest.h>

namespace aisle::local_planner {
namespace {

using geometry::Point2;

/// A way at 1 m/s, as a claim.
std::vector<IntentPoint> claim(const std::vector<Point2>& points) {
  const Route route(points);
  std::vector<IntentPoint> out;
  for (double s = 0.0; s <= route.length_m(); s += 0.4)
    out.push_back({s, {route.at(s).x, route.at(s).y, route.heading_at(s)}});
  return out;
}

PeerView peer(const std::string& id, const std::vector<Point2>& points, double speed_mps = 1.0) {
  PeerView view;
  view.id = id;
  view.base_in_map = {points.front().x, points.front().y, 0.0};
  view.speed_mps = speed_mps;
  view.stopping_m = 0.5 * speed_mps * speed_mps / 1.2;
  view.has_goal = true;
  view.claim = claim(points);
  return view;
}

/// Seen from one vehicle on its way.
struct Me {
  Me(const std::string& name, const std::vector<Point2>& points)
      : id(name), route(resample(points, 0.2)), profile(route.points().size(), 1.0) {}
  Advice among(const std::vector<PeerView>& peers, double s_m = 0.0) const {
    return advise({id, 0.35, s_m, 1.0, 0.5, route.at(s_m), route, profile}, peers, {});
  }
  std::string id;
  Route route;
  std::vector<double> profile;
};

const std::vector<Point2> kEast{{0.0, 0.0}, {12.0, 0.0}};
const std::vector<Point2> kNorth{{5.0, -5.0}, {5.0, 7.0}};

TEST(Traffic, TheSmallerNumberGoesFirst) {
  EXPECT_TRUE(outranks("agv-1", "agv-2"));
  EXPECT_TRUE(outranks("agv-2", "agv-10"));
  EXPECT_FALSE(outranks("agv-10", "agv-2"));
}

TEST(Traffic, AtACrossingTheOtherWaitsBeforeTheConflict) {
  EXPECT_TRUE(Me("agv-1", kEast).among({peer("agv-2", kNorth)}).yields_to.empty());
  const Advice advice = Me("agv-2", kNorth).among({peer("agv-1", kEast)});
  EXPECT_EQ(advice.yields_to, "agv-1");
  EXPECT_LT(advice.stop_at_m, 5.0 - 0.7);
  EXPECT_GT(advice.stop_at_m, 2.5);
  EXPECT_FALSE(advice.follows);
}

TEST(Traffic, ExactlyOneOfTwoWaits) {
  for (const double lead : {0.0, 1.0, 2.0}) {
    const std::vector<Point2> east{{-lead, 0.0}, {12.0, 0.0}};
    const bool first_waits = !Me("agv-1", east).among({peer("agv-2", kNorth)}).yields_to.empty();
    const bool second_waits = !Me("agv-2", kNorth).among({peer("agv-1", east)}).yields_to.empty();
    EXPECT_NE(first_waits, second_waits) << lead;
  }
}

TEST(Traffic, WhoIsThroughInTimeNeedNotWait) {
  EXPECT_TRUE(
      Me("agv-2", {{5.0, -1.2}, {5.0, 7.0}}).among({peer("agv-1", {{-7.0, 0.0}, {12.0, 0.0}})}).yields_to.empty());
}

TEST(Traffic, WhoIsInTheConflictGoesOn) {
  const Advice advice = Me("agv-1", kEast).among({peer("agv-2", {{5.0, -0.3}, {5.0, 7.0}}, 0.3)});
  EXPECT_EQ(advice.yields_to, "agv-2");
  EXPECT_TRUE(Me("agv-2", {{5.0, -0.3}, {5.0, 7.0}}).among({peer("agv-1", kEast)}).yields_to.empty());
}

TEST(Traffic, FollowsBehindWhoGoesTheSameWay) {
  const Advice advice = Me("agv-1", kEast).among({peer("agv-2", {{2.0, 0.0}, {12.0, 0.0}}, 0.2)});
  EXPECT_TRUE(advice.follows);
  EXPECT_LT(advice.stop_at_m, 2.0 - 0.7);
  EXPECT_TRUE(Me("agv-2", {{2.0, 0.0}, {12.0, 0.0}}).among({peer("agv-1", kEast)}).yields_to.empty());
}

TEST(Traffic, OppositeLanesDoNotConflict) {
  const Advice advice = Me("agv-2", kEast).among({peer("agv-1", {{12.0, 1.0}, {0.0, 1.0}})});
  EXPECT_TRUE(advice.yields_to.empty());
  EXPECT_TRUE(advice.gives_way_to.empty());
}

TEST(Traffic, HeadOnTheOneOfHigherNumberGivesWay) {
  const std::vector<Point2> west{{12.0, 0.0}, {-4.0, 0.0}};
  EXPECT_TRUE(Me("agv-1", kEast).among({peer("agv-2", west)}).gives_way_to.empty());
  EXPECT_EQ(Me("agv-2", kEast).among({peer("agv-1", west)}).gives_way_to, std::vector<std::string>{"agv-1"});
}

TEST(Traffic, TheRightOfWayOfWhoStandsEnds) {
  PeerView standing = peer("agv-1", kEast, 0.0);
  EXPECT_FALSE(Me("agv-2", kNorth).among({standing}).yields_to.empty());
  standing.standing_s = 10.0;
  EXPECT_TRUE(Me("agv-2", kNorth).among({standing}).yields_to.empty());
}

TEST(Traffic, WhoHasNoGoalClaimsNothing) {
  PeerView parked = peer("agv-1", kEast, 0.0);
  parked.has_goal = false;
  EXPECT_TRUE(Me("agv-2", kNorth).among({parked}).yields_to.empty());
}

TEST(Claims, AreFoundBetweenTheirPoints) {
  const auto way = claim(kEast);
  EXPECT_TRUE(is_claimed(way, {3.3, 0.2}, 0.25));
  EXPECT_FALSE(is_claimed(way, {3.3, 0.3}, 0.25));
}

}  // namespace
}  // namespace aisle::local_planner
