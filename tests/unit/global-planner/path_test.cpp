#include <gtest/gtest.h>

#include <vector>

#include "services/global-planner/core/drivable.hpp"
#include "services/global-planner/core/nearest_reachable.hpp"
#include "services/global-planner/core/passes/passes.hpp"
#include "services/global-planner/core/path_checker.hpp"
#include "services/global-planner/core/path_progress.hpp"
#include "services/global-planner/core/stamped_discs.hpp"
#include "tests/support/ascii_grid.hpp"

namespace aisle::global_planner {
namespace {

using geometry::Point2;
using Path = std::vector<Point2>;

struct Room {
  grid::OccupancyGrid grid;
  grid::ClearanceField clearance;
  explicit Room(const std::vector<std::string>& lines, double resolution_m = 1.0)
      : grid(test_support::grid_from_text(lines, resolution_m)), clearance(grid, 10.0) {}
};

TEST(Collinear, KeepsOnlyTheTurns) {
  const Room room({".....", ".....", "....."});
  const Problem problem{room.clearance, {0.5, 0.5}, {3.5, 1.5}};
  Path path{{0.5, 0.5}, {1.5, 0.5}, {2.5, 0.5}, {3.5, 1.5}};
  passes::collinear(Drivable(problem), path);
  EXPECT_EQ(path, (Path{{0.5, 0.5}, {2.5, 0.5}, {3.5, 1.5}}));
}

TEST(Collinear, KeepsAPointWhereThePathTurnsBack) {
  const Room room({"....."});
  Path path{{0.5, 0.5}, {3.5, 0.5}, {1.5, 0.5}};
  passes::collinear(Drivable({room.clearance, {0.5, 0.5}, {1.5, 0.5}}), path);
  EXPECT_EQ(path.size(), 3U);
}

TEST(GreedyLineOfSight, JoinsWhatSeesEachOtherAndKeepsTheRest) {
  const Room room({".....", "..#..", "..#..", "....."});
  const Problem problem{room.clearance, {0.5, 2.5}, {4.5, 2.5}};
  Path path{{0.5, 2.5}, {1.5, 3.5}, {2.5, 3.5}, {3.5, 3.5}, {4.5, 2.5}};
  passes::greedy_line_of_sight(Drivable(problem), path);
  EXPECT_EQ(path, (Path{{0.5, 2.5}, {2.5, 3.5}, {4.5, 2.5}}));
  EXPECT_EQ(why_not_drivable(problem, path), "");
}

TEST(PathChecker, SeesAPathThroughAWallAndWrongEnds) {
  const Room room({".....", "..#..", "....."});
  const Problem problem{room.clearance, {0.5, 1.5}, {4.5, 1.5}};
  EXPECT_FALSE(is_drivable(problem, {{0.5, 1.5}, {4.5, 1.5}}));
  EXPECT_TRUE(is_drivable(problem, {{0.5, 1.5}, {1.5, 2.5}, {3.5, 2.5}, {4.5, 1.5}}));
  EXPECT_FALSE(is_drivable(problem, {{0.5, 1.5}, {1.5, 2.5}, {3.5, 2.5}}));
  EXPECT_FALSE(is_drivable(problem, {{0.5, 0.5}, {1.5, 2.5}, {3.5, 2.5}, {4.5, 1.5}}));
  EXPECT_FALSE(is_drivable(problem, {{0.5, 1.5}, {-5.5, 2.5}, {3.5, 2.5}, {4.5, 1.5}}));
  EXPECT_FALSE(is_drivable(problem, {}));
}

TEST(PathChecker, WantsTheWholeRadius) {
  const Room room({".......", ".......", ".......", "#######"});
  const Path path{{2.5, 1.5}, {4.5, 1.5}};
  EXPECT_TRUE(is_drivable({room.clearance, path.front(), path.back(), 0.45}, path));
  EXPECT_FALSE(is_drivable({room.clearance, path.front(), path.back(), 0.75}, path));
}

TEST(NearestReachable, IsTheBestThatTheVehicleCanDo) {
  const std::vector<std::string> text{"S..###", "...#G#", "...###"};
  const Room room(text);
  const auto point = nearest_reachable(
      {room.clearance, test_support::find_letter(text, 'S'), test_support::find_letter(text, 'G')}, nullptr);
  ASSERT_TRUE(point);
  EXPECT_EQ(*point, (Point2{2.5, 1.5}));
}

TEST(StampedDiscs, LeaveNoTrace) {
  Room room({"..........", "....#.....", "..........", ".......##.", ".........."}, 0.2);
  const std::vector<float> clearance_before = room.clearance.cells_m();
  {
    const StampedDiscs stamped(room.grid, room.clearance, {{{0.9, 0.5}, 0.25}, {{1.0, 0.5}, 0.2}, {{-0.1, 0.5}, 0.3}});
    EXPECT_EQ(room.clearance.clearance_m(Point2{0.9, 0.5}), 0.0);
    EXPECT_EQ(room.clearance.clearance_m(grid::Cell{0, 2}), 0.0);
    EXPECT_GT(room.clearance.clearance_m(grid::Cell{2, 0}), 0.0);
    grid::OccupancyGrid with_discs = room.grid;
    for (int y = 0; y < with_discs.geometry().height; ++y) {
      for (int x = 0; x < with_discs.geometry().width; ++x) {
        if (room.clearance.clearance_m(grid::Cell{x, y}) == 0.0) with_discs.set({x, y}, grid::Occupancy::kOccupied);
      }
    }
    EXPECT_EQ(room.clearance.cells_m(), grid::ClearanceField(with_discs, 10.0).cells_m());
  }
  EXPECT_EQ(room.clearance.cells_m(), clearance_before);
}

TEST(PathProgress, FollowsTheVehicleAndNeverGoesBack) {
  PathProgress progress({{0.0, 0.0}, {10.0, 0.0}, {10.0, 0.5}, {0.0, 0.5}});
  progress.advance({2.0, 0.45});  // nearer to the way back, which is far along the path
  EXPECT_EQ(progress.remaining().front(), (Point2{2.0, 0.0}));
  EXPECT_NEAR(progress.off_path_m(), 0.45, 1e-9);
  progress.advance({1.0, 0.0});
  EXPECT_EQ(progress.remaining().front(), (Point2{2.0, 0.0}));
  for (double x = 2.0; x <= 10.0; x += 0.5) progress.advance({x, 0.0});
  progress.advance({9.0, 0.5});
  EXPECT_EQ(progress.remaining(), (Path{{9.0, 0.5}, {0.0, 0.5}}));
}

}  // namespace
}  // namespace aisle::global_planner
