// Each pass on a path drawn by hand, and all of them on random paths: drivable before, drivable after, no longer, same
// ends.
#include "services/global-planner/core/passes/passes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "services/global-planner/core/path_checker.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tests/support/ascii_grid.hpp"
#include "tests/support/random_grid.hpp"

namespace aisle::global_planner {
namespace {

using geometry::Point2;
using Path = std::vector<Point2>;

Path passed(Pass pass, const std::vector<std::string>& lines, Path path, double safe_distance_m = 0.0) {
  const grid::ClearanceField clearance(test_support::grid_from_text(lines), 10.0);
  Problem problem{clearance, path.front(), path.back()};
  problem.safe_distance_m = safe_distance_m;
  pass(Drivable(problem), path);
  EXPECT_EQ(why_not_drivable(problem, path), "");
  return path;
}

const std::vector<std::string> kOpen{".......", ".......", ".......", ".......", ".......", ".......", "......."};
const std::vector<std::string> kBlock{".......", ".......", ".......", "..##...", "..##...", ".......", "......."};

// LI IV.B.2a: of the collinear nodes N4 to N8 the path goes on to N8, the one with obstacles around it.
TEST(CollinearButOneBesideObstacles, GoesOnToTheFirstPointBesideAnObstacle) {
  const Path straight{{0.5, 1.5}, {1.5, 1.5}, {2.5, 1.5}, {3.5, 1.5}, {4.5, 1.5}, {5.5, 1.5}, {6.5, 1.5}};
  EXPECT_EQ(passed(passes::collinear_but_one_beside_obstacles, kOpen, straight), (Path{{0.5, 1.5}, {6.5, 1.5}}));
  EXPECT_EQ(passed(passes::collinear_but_one_beside_obstacles, kBlock, straight),
            (Path{{0.5, 1.5}, {1.5, 1.5}, {6.5, 1.5}}))
      << "four of its points have the block beside them";
}

TEST(CollinearButOneBesideObstacles, KeepsOneOfEachStraightRun) {
  const Path corner{{0.5, 0.5}, {1.5, 1.5}, {2.5, 1.5}, {3.5, 1.5}, {4.5, 1.5}, {5.5, 1.5},
                    {5.5, 2.5}, {5.5, 3.5}, {5.5, 4.5}, {5.5, 5.5}, {5.5, 6.5}};
  EXPECT_EQ(passed(passes::collinear_but_one_beside_obstacles, kBlock, corner),
            (Path{{0.5, 0.5}, {1.5, 1.5}, {2.5, 1.5}, {5.5, 1.5}, {5.5, 6.5}}));
}

TEST(RightAngle, IsCutWhereTheCornerIsFreeAndStaysWhereItIsNot) {
  EXPECT_EQ(passed(passes::right_angle, kOpen, {{1.5, 1.5}, {2.5, 1.5}, {2.5, 2.5}}), (Path{{1.5, 1.5}, {2.5, 2.5}}));
  const Path around{{1.5, 2.5}, {1.5, 1.5}, {2.5, 1.5}};
  EXPECT_EQ(passed(passes::right_angle, kBlock, around), around);
  const Path far{{0.5, 0.5}, {5.5, 0.5}, {5.5, 5.5}};
  EXPECT_EQ(passed(passes::right_angle, kOpen, far), far) << "only neighbouring cells";
}

TEST(SafeDistance, JoinsOnlyWhatKeepsIt) {
  const Path around{{1.5, 1.5}, {3.5, 1.5}, {5.5, 1.5}, {5.5, 3.5}};
  EXPECT_EQ(passed(passes::safe_distance, kBlock, around), (Path{{1.5, 1.5}, {5.5, 1.5}, {5.5, 3.5}}));
  EXPECT_EQ(passed(passes::safe_distance, kBlock, around, 0.8).size(), 4U);
}

// QU 2.3.2: "the above steps are repeated from the beginning". Without a safe distance a line of sight is one round.
TEST(SafeDistance, GoesOnUntilNothingChanges) {
  const std::unique_ptr<Planner> greedy = find_variant("greedy")->make();
  int more_than_one_round = 0;
  for (unsigned seed = 1; seed <= 100; ++seed) {
    std::mt19937 random(seed);
    const grid::ClearanceField clearance(test_support::random_blocks(random, 40, 25, 8, 0.1), 3.0);
    const Problem problem{clearance, {0.05, 0.05}, {3.95, 3.95}};
    const Path path = greedy->plan(problem, nullptr).waypoints_in_map;
    Path once = path, last = path;
    passes::greedy_line_of_sight(Drivable(problem), once);
    passes::safe_distance(Drivable(problem), last);
    more_than_one_round += last != once ? 1 : 0;
    Path again = last;
    passes::greedy_line_of_sight(Drivable(problem), again);
    EXPECT_EQ(again, last) << "seed " << seed;
  }
  EXPECT_GT(more_than_one_round, 0);
}

TEST(Interpolated, PullsACornerAlongItsSegment) {
  const Path around{{0.5, 4.5}, {0.5, 0.5}, {6.5, 0.5}};
  const Path forward = passed(passes::interpolated_forward, kBlock, around);
  ASSERT_EQ(forward.size(), 3U);
  EXPECT_EQ(forward[1].y, 0.5);
  EXPECT_GT(forward[1].x, 1.4);
  const Path backward = passed(passes::interpolated_backward, kBlock, around);
  ASSERT_EQ(backward.size(), 3U);
  EXPECT_EQ(backward[1].x, 0.5);
  EXPECT_GT(backward[1].y, 0.9);
  EXPECT_EQ(passed(passes::interpolated_forward, kOpen, around), (Path{{0.5, 4.5}, {6.5, 0.5}}));
}

// YU 2.3 (3): points between two nodes are tried one after the other, until a line comes nearer to an obstacle than the
// safe distance.
TEST(InterpolatedAtSafeDistance, MovesANodeAlongItsSegmentForAsLongAsTheLineKeepsIt) {
  const Path around{{0.5, 4.5}, {0.5, 0.5}, {6.5, 0.5}};
  const Path free = passed(passes::interpolated_at_safe_distance, kBlock, around, 0.0);
  const Path near = passed(passes::interpolated_at_safe_distance, kBlock, around, 0.3);
  const Path far = passed(passes::interpolated_at_safe_distance, kBlock, around, 1.2);
  ASSERT_EQ(near.size(), 3U);
  ASSERT_EQ(far.size(), 3U);
  EXPECT_EQ(near[1].y, 0.5) << "between the nodes, not at one of them";
  EXPECT_GT(near[1].x, 0.5);
  EXPECT_GE(free[1].x, near[1].x);
  EXPECT_GT(near[1].x, far[1].x) << "more room, less of a short cut";

  const grid::ClearanceField clearance(test_support::grid_from_text(kBlock), 10.0);
  for (int i = 0; i <= 40; ++i)
    EXPECT_GE(clearance.clearance_m(near[0] + (i / 40.0) * (near[1] - near[0])), 0.3 - 1e-6);
}

TEST(InterpolatedAtSafeDistance, StopsAtTheFirstLineThatDoesNot) {
  // The end of the second segment is in sight past the block, but the points before it are not.
  const std::vector<std::string> block{".......", ".......", ".......", ".#.....", "......."};
  const Path around{{0.5, 3.5}, {0.5, 0.5}, {6.5, 0.5}, {6.5, 3.5}};
  EXPECT_EQ(passed(passes::interpolated_at_safe_distance, block, around, 0.3), around);
  EXPECT_NE(passed(passes::interpolated_forward, block, around), around) << "WU takes the farthest of all";
}

/// WU's step 2 as it is said: samples are tried one by one, from the farthest on.
Path plainly_interpolated(const Drivable& drivable, const Path& path) {
  Path kept{path.front()};
  for (std::size_t i = 1; i + 1 < path.size(); ++i) {
    const int samples = std::clamp(
        static_cast<int>(std::ceil(geometry::distance(path[i], path[i + 1]) / drivable.geometry().resolution_m)), 1,
        64);
    Point2 seen = path[i];
    for (int k = 1; k <= samples; ++k) {
      const Point2 sample =
          k == samples ? path[i + 1] : path[i] + (static_cast<double>(k) / samples) * (path[i + 1] - path[i]);
      if (drivable.is_line_free(kept.back(), sample)) seen = sample;
    }
    if (seen != path[i + 1]) kept.push_back(seen);
  }
  kept.push_back(path.back());
  return kept;
}

TEST(Interpolated, IsWhatTryingEverySampleGives) {
  const std::unique_ptr<Planner> greedy = find_variant("greedy")->make();
  int changed = 0;
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    const grid::ClearanceField clearance(test_support::random_blocks(random, 60, 40, 10, 0.1), 3.0);
    const Problem problem{clearance, {0.03, 0.04}, {5.96, 5.92}, seed % 2 == 0 ? 0.2 : 0.0, 0.02};
    const PlannedPath plan = greedy->plan(problem, nullptr);
    if (plan.outcome != Outcome::kFound) continue;
    const Drivable drivable(problem);
    Path path = plan.waypoints_in_map;
    passes::collinear(drivable, path);
    if (seed % 3 != 0) passes::greedy_line_of_sight(drivable, path);
    const Path expected = plainly_interpolated(drivable, path);
    changed += expected != path ? 1 : 0;
    passes::interpolated_forward(drivable, path);
    EXPECT_EQ(path, expected) << "seed " << seed;
  }
  EXPECT_GT(changed, 60);
}

struct Named {
  const char* name;
  Pass pass;
};

TEST(EveryPass, LeavesADrivablePathDrivableAndNoLonger) {
  const std::vector<Named> all{{"P1", passes::collinear},
                               {"P1a", passes::collinear_but_one_beside_obstacles},
                               {"P2", passes::right_angle},
                               {"P3", passes::greedy_line_of_sight},
                               {"P4", passes::safe_distance},
                               {"P5", passes::interpolated_forward},
                               {"P5 safe", passes::interpolated_at_safe_distance},
                               {"P6", passes::interpolated_backward}};
  const std::unique_ptr<Planner> greedy = find_variant("greedy")->make();
  for (unsigned seed = 1; seed <= 200; ++seed) {
    std::mt19937 random(seed);
    const grid::ClearanceField clearance(test_support::random_blocks(random, 40, 25, 8, 0.1), 3.0);
    Problem problem{clearance, {0.03, 0.04}, {3.96, 3.92}, seed % 2 == 0 ? 0.2 : 0.0, 0.02};
    problem.safe_distance_m = seed % 3 == 0 ? 0.25 : 0.0;
    const PlannedPath plan = greedy->plan(problem, nullptr);
    if (plan.outcome != Outcome::kFound) continue;
    for (const Named& named : all) {
      Path path = plan.waypoints_in_map;
      named.pass(Drivable(problem), path);
      EXPECT_EQ(why_not_drivable(problem, path), "") << named.name << ", seed " << seed;
      EXPECT_LE(path_length_m(path), plan.length_m + 1e-9) << named.name << ", seed " << seed;
      EXPECT_LE(path.size(), plan.waypoints_in_map.size()) << named.name << ", seed " << seed;
    }
  }
}

}  // namespace
}  // namespace aisle::global_planner
