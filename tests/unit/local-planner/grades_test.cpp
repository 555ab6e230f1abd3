// The grades of recovery as values, in their order; how they are driven stands in recovery_test.cpp.
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <vector>

#include "services/local-planner/core/recovery.hpp"
#include "tests/unit/local-planner/hall.hpp"

namespace aisle::local_planner {
namespace {

using geometry::Pose2;

/// Stands in a hall, 0.04 m before the wall at x = 9.95 m, or elsewhere; aims through the wall.
class Cornered {
 public:
  explicit Cornered(Pose2 base = {9.56, 5.0, 0.0}) : scene_{clearance_, base, {}, 0.35, {}, 1.2, movers_, peers_} {}

  WayOut look(bool stands, bool may_turn = true) {
    DwaSettings settings;
    settings.linear_samples = 3;
    settings.angular_samples = 3;
    const Choice choice = choose(scene_, aim_, wang(), settings);
    EXPECT_TRUE(is_refused(choice));
    return way_out({scene_, aim_, choice, stands, may_turn, 0.0}, wang(), settings);
  }
  void meet(Mover mover) { movers_ = {mover}; }

 private:
  grid::ClearanceField clearance_{hall(10.0, 10.0)};
  std::vector<Mover> movers_;
  std::vector<PeerMotion> peers_;
  Scene scene_;
  Aim aim_{{12.0, 5.0}, 0.2, 0.6, {}};
};

TEST(Grades, StandInTheOrderInWhichTheyAreTried) {
  EXPECT_LT(Grade::kNone, Grade::kSlower);
  EXPECT_LT(Grade::kSlower, Grade::kFiner);
  EXPECT_LT(Grade::kFiner, Grade::kTurn);
  EXPECT_LT(Grade::kTurn, Grade::kBackOff);
  EXPECT_LT(Grade::kBackOff, Grade::kAsk);
}

TEST(WayOut, IsToGoSlowerWhileItMoves) { EXPECT_EQ(Cornered().look(false).grade, Grade::kSlower); }

TEST(WayOut, IsATurnToTheNearestOpenHeadingBeforeAWall) {
  const WayOut found = Cornered().look(true);
  EXPECT_EQ(found.grade, Grade::kTurn);
  ASSERT_TRUE(found.turn_rad);
  EXPECT_GT(std::abs(*found.turn_rad), 1.0);
  EXPECT_LT(std::abs(*found.turn_rad), 2.2);
}

TEST(WayOut, IsNoTurnForWhatHasCorners) {
  const WayOut found = Cornered().look(true, false);
  EXPECT_EQ(found.grade, Grade::kTurn);
  EXPECT_FALSE(found.turn_rad);
}

TEST(WayOut, BeforePeopleIsNoLookElsewhere) {
  Cornered person({5.0, 5.0, 0.0});
  person.meet({{5.75, 5.0}, {-0.3, 0.0}});
  const WayOut found = person.look(true);
  EXPECT_EQ(found.grade, Grade::kTurn);
  EXPECT_FALSE(found.turn_rad);
}

TEST(WayOut, IsAFinerLookWhereTheCoarseOneOverlooksAGap) {
  grid::OccupancyGrid grid = hall(10.0, 10.0);
  block(grid, 5.3, 0.0, 10.0, 4.45);  // a gap of 0.85 m, looked into at an angle
  block(grid, 5.3, 5.3, 10.0, 10.0);
  const grid::ClearanceField clearance(grid);
  const std::vector<Mover> nobody;
  const std::vector<PeerMotion> no_peers;
  DwaSettings coarse;
  coarse.linear_samples = 2;
  coarse.angular_samples = 3;
  int finer = 0;
  for (double yaw_rad = -0.8; yaw_rad < 0.8; yaw_rad += 0.05) {
    const Scene scene{clearance, {5.0, 4.9, yaw_rad}, {}, 0.35, {}, 1.2, nobody, no_peers};
    const Aim aim{{7.0, 4.9}, 0.2, 0.6, {}};
    const Choice choice = choose(scene, aim, wang(), coarse);
    if (!is_refused(choice)) continue;
    const WayOut found = way_out({scene, aim, choice, true, true, -yaw_rad}, wang(), coarse);
    EXPECT_EQ(found.grade == Grade::kFiner, found.choice.moving > 0);
    EXPECT_FALSE(found.grade == Grade::kFiner && found.turn_rad);
    finer += found.grade == Grade::kFiner ? 1 : 0;
  }
  EXPECT_GT(finer, 0);
}

/// Looks every 0.1 s for so long; the moments at which it backs off, in s.
std::vector<double> back_offs(Patience& patience, const Attempt& attempt, double seconds) {
  std::vector<double> at;
  const time::Stamp begin{std::chrono::seconds(100)};
  patience.begin(begin);
  for (double t = 0.0; t < seconds; t += 0.1)
    if (patience.look(attempt, begin + time::from_seconds(t)) == Grade::kBackOff) at.push_back(t);
  return at;
}

TEST(Patience, EndsAfterATurnAboutAndLastsLongerEachTime) {
  Patience patience;
  const std::vector<double> at = back_offs(patience, {5.0}, 40.0);
  const kinematics::Limits limits;
  const double first_s =
      3.0 + geometry::kPi / limits.max_turn_radps + limits.max_turn_radps / limits.max_turn_acceleration_radps2;
  ASSERT_GE(at.size(), 3u);
  EXPECT_NEAR(at[0], first_s, 0.15);
  EXPECT_NEAR(at[1] - at[0], first_s + 4.0, 0.15);
  EXPECT_NEAR(at[2] - at[1], first_s + 8.0, 0.15);
}

TEST(Patience, IsForTrying) {
  Patience patience;
  Attempt waits{5.0};
  waits.waits = true;
  EXPECT_TRUE(back_offs(patience, waits, 60.0).empty());
  Attempt back{5.0};
  back.backs_off = true;
  EXPECT_TRUE(back_offs(patience, back, 60.0).empty());
}

TEST(Patience, AsksWhereBackingOffMovesNothing) {
  Patience patience;
  Attempt closed{5.0};
  closed.is_closed = true;
  EXPECT_TRUE(back_offs(patience, closed, 60.0).empty());
  EXPECT_EQ(patience.look(closed, time::Stamp{std::chrono::seconds(200)}), Grade::kAsk);
}

TEST(Patience, BeginsAnewWithEachGoodPiece) {
  Patience patience;
  time::Stamp now{std::chrono::seconds(100)};
  patience.begin(now);
  for (double left_m = 20.0; left_m > 0.0; left_m -= 0.1, now += std::chrono::seconds(1))
    EXPECT_EQ(patience.look({left_m}, now), Grade::kNone) << left_m;
}

TEST(Patience, CountsAWayRoundAsNoStepBack) {
  Patience patience;
  time::Stamp now{std::chrono::seconds(100)};
  patience.begin(now);
  EXPECT_EQ(patience.look({5.0}, now), Grade::kNone);
  patience.lengthen(3.0);
  now += std::chrono::seconds(4);
  EXPECT_EQ(patience.look({7.0}, now), Grade::kNone);  // 1 m nearer on a way that is 3 m longer
  EXPECT_EQ(patience.look({7.0}, now + std::chrono::seconds(4)), Grade::kNone);
  EXPECT_EQ(patience.look({7.0}, now + std::chrono::seconds(10)), Grade::kBackOff);
}

}  // namespace
}  // namespace aisle::local_planner
