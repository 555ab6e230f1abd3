// The whole experiment, on a small map.
#include "tools/lab/traffic_bounds/traffic_experiment.hpp"

#include <gtest/gtest.h>

#include "tests/unit/lab/traffic_bounds/small_floor.hpp"
#include "tools/lab/traffic_bounds/traffic_tables.hpp"

namespace aisle::lab {
namespace {

FloorFigures measure(std::vector<std::size_t> vehicles) {
  TrafficExperiment experiment;
  experiment.vehicles = std::move(vehicles);
  experiment.seconds = 60.0;
  return measure_floor(small_floor(), experiment, {});
}

TEST(TrafficExperiment, OneVehicleIsAsGoodAsAlone) {
  const FloorFigures floor = measure({1});
  ASSERT_EQ(floor.rows.size(), 1U);
  const FleetRow& row = floor.rows.front();

  ASSERT_TRUE(row.reached && row.one_shot);
  EXPECT_GT(row.reached->goals, 2);
  EXPECT_DOUBLE_EQ(row.reached->time_to_alone, 1.0);
  EXPECT_DOUBLE_EQ(row.one_shot->ratio(1).value_or(0.0), 1.0);
  EXPECT_DOUBLE_EQ(row.one_shot->makespan_s, row.one_shot->alone_makespan_s);
  EXPECT_NEAR(row.reached->goals_per_vehicle_hour, *row.alone, 1e-9);

  // PIBT drives the shortest ways, whose steps are as long in the mean as the free run's; but for the last, open way.
  EXPECT_NEAR(row.bound / row.reached->goals_per_vehicle_hour, 1.0, 0.35);
}

TEST(TrafficExperiment, TheSameSeedGivesTheSameTables) {
  const FloorFigures a = measure({2, 3});
  const FloorFigures b = measure({2, 3});

  EXPECT_EQ(a.rows.size(), 2U);
  EXPECT_EQ(throughput_table(a), throughput_table(b));
  EXPECT_EQ(one_shot_table(a), one_shot_table(b));
  EXPECT_EQ(remarks(a), remarks(b));
  for (const FleetRow& row : a.rows) EXPECT_EQ(row.reached->findings, 0);
}

TEST(TrafficExperiment, OneShotHasItsFreeRunsWhereTheRunsAreShort) {
  TrafficExperiment experiment;
  experiment.vehicles = {1};
  experiment.seconds = 10.0;
  const FloorFigures floor = measure_floor(small_floor(), experiment, {});

  ASSERT_TRUE(floor.rows.at(0).one_shot);
  EXPECT_EQ(floor.rows[0].one_shot->goals, 1);
  EXPECT_GT(floor.rows[0].one_shot->alone_ends_s, 0.0);
}

TEST(TrafficExperiment, EndsWithCompleteRowsWhenItIsStopped) {
  TrafficExperiment experiment;
  experiment.vehicles = {1};
  experiment.goes_on = [] { return false; };

  EXPECT_TRUE(measure_floor(small_floor(), experiment, {}).rows.empty());
}

}  // namespace
}  // namespace aisle::lab
