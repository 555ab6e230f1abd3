// The judge finds what it must find: otherwise a run without findings says nothing.
#include "tools/lab/traffic/floor_judge.hpp"

#include <gtest/gtest.h>

#include "common/grid/occupancy_grid.hpp"

namespace aisle::lab {
namespace {

using geometry::Point2;

/// 10 m x 10 m of free floor.
class FloorJudgeTest : public testing::Test {
 protected:
  grid::OccupancyGrid grid_{grid::Geometry{100, 100, 0.1, {0.0, 0.0}}};
  grid::ClearanceField clearance_{grid_};
  FloorJudge judge_{clearance_};

  static JudgedVehicle at(const std::string& id, double x, double y, std::vector<Point2> road = {}) {
    JudgedVehicle vehicle{id, geometry::disc(0.35), {x, y, 0.0}, true, {}, {}};
    if (!road.empty()) vehicle.roads_in_map.push_back(std::move(road));
    return vehicle;
  }
};

TEST_F(FloorJudgeTest, FindsNothingWhereVehiclesAndRoadsKeepApart) {
  judge_.look(0.0, {at("a", 2.0, 2.0, {{2.0, 2.0}, {6.0, 2.0}}), at("b", 2.0, 4.0, {{2.0, 4.0}, {6.0, 4.0}})});

  EXPECT_TRUE(judge_.findings().empty());
  EXPECT_EQ(judge_.contacts() + judge_.held_twice() + judge_.wall_contacts() + judge_.off_road(), 0);
}

TEST_F(FloorJudgeTest, CountsAContactOnceFromItsBeginningToItsEnd) {
  for (const double x : {3.5, 2.6, 2.5, 3.5, 2.6}) judge_.look(0.0, {at("a", 2.0, 2.0), at("b", x, 2.0)});

  EXPECT_EQ(judge_.contacts(), 2);
  EXPECT_NEAR(judge_.least_clearance_m(), -0.2, 1e-9);
}

TEST_F(FloorJudgeTest, FindsFloorThatTwoHold) {
  judge_.look(0.0, {at("a", 2.0, 5.0, {{2.0, 5.0}, {8.0, 5.0}}), at("b", 5.0, 2.0, {{5.0, 2.0}, {5.0, 8.0}})});

  EXPECT_EQ(judge_.held_twice(), 1);
  EXPECT_EQ(judge_.contacts(), 0);
}

TEST_F(FloorJudgeTest, FindsAVehicleBeyondItsRoad) {
  JudgedVehicle vehicle = at("a", 5.0, 2.0);
  vehicle.granted_in_map = {{{2.0, 2.0}, {4.0, 2.0}}};
  judge_.look(0.0, {vehicle});

  EXPECT_EQ(judge_.off_road(), 1);
}

TEST_F(FloorJudgeTest, FindsAWall) {
  judge_.look(0.0, {at("a", 0.2, 5.0)});

  EXPECT_EQ(judge_.wall_contacts(), 1);
}

}  // namespace
}  // namespace aisle::lab
