#include "tools/lab/traffic_bounds/fleet_case.hpp"

#include <gtest/gtest.h>

#include "common/config/reader.hpp"
#include "tests/unit/lab/traffic_bounds/small_floor.hpp"

namespace aisle::lab {
namespace {

class FleetCase : public testing::Test {
 protected:
  FloorModel model_{small_floor()};

  static std::vector<geometry::Point2> starts_of(const scenario::Scenario& fleet) {
    std::vector<geometry::Point2> starts;
    for (const scenario::Vehicle& vehicle : fleet.vehicles) starts.push_back(vehicle.start_in_map.position());
    return starts;
  }
};

TEST_F(FleetCase, ASmallerFleetIsTheBeginningOfALargerOne) {
  const scenario::Scenario large = draw_fleet(model_, 3, 6, 60.0);
  const scenario::Scenario small = draw_fleet(model_, 3, 2, 60.0);

  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(small.vehicles[i].start_in_map.x, large.vehicles[i].start_in_map.x);
    EXPECT_EQ(small.vehicles[i].start_in_map.y, large.vehicles[i].start_in_map.y);
    EXPECT_EQ(small.missions[i].goals_in_map.back().x, large.missions[i].goals_in_map.back().x);
  }
  EXPECT_EQ(first_of(large, 2).vehicles.size(), 2U);
  EXPECT_EQ(first_of(large, 2, 1).missions[1].goals_in_map.size(), 1U);
}

TEST_F(FleetCase, StartsAndFirstGoalsAreApartAndOnFreeFloor) {
  const scenario::Scenario fleet = draw_fleet(model_, 1, 8, 60.0);
  const std::vector<geometry::Point2> starts = starts_of(fleet);

  for (std::size_t i = 0; i < starts.size(); ++i) {
    EXPECT_GE(model_.clearance.clearance_m(starts[i]), 0.35);
    for (std::size_t k = 0; k < i; ++k) {
      EXPECT_GE(geometry::distance(starts[i], starts[k]), 0.99);
      EXPECT_GE(geometry::distance(fleet.missions[i].goals_in_map.front().position(),
                                   fleet.missions[k].goals_in_map.front().position()),
                0.99);
    }
  }
}

TEST_F(FleetCase, ASeedDrawsOneFleetAndAnotherSeedAnother) {
  EXPECT_EQ(starts_of(draw_fleet(model_, 1, 4, 60.0)).front().x, starts_of(draw_fleet(model_, 1, 4, 60.0)).front().x);

  const auto a = draw_fleet(model_, 1, 4, 60.0).missions.front().goals_in_map;
  const auto b = draw_fleet(model_, 2, 4, 60.0).missions.front().goals_in_map;
  bool differs = false;
  for (std::size_t i = 0; i < a.size(); ++i) differs = differs || a[i].x != b[i].x || a[i].y != b[i].y;
  EXPECT_TRUE(differs);
}

TEST_F(FleetCase, SaysThatThereIsNoRoom) { EXPECT_THROW(draw_fleet(model_, 1, 300, 60.0), config::BadInput); }

}  // namespace
}  // namespace aisle::lab
