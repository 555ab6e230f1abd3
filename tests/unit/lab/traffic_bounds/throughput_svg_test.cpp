#include "tools/lab/traffic_bounds/throughput_svg.hpp"

#include <gtest/gtest.h>

namespace aisle::lab {
namespace {

TEST(ThroughputSvg, DrawsTheCurvesThatThereAre) {
  FloorFigures floor;
  floor.floor = "rooms <1>";
  for (const std::size_t vehicles : {std::size_t{20}, std::size_t{5}}) {
    FleetRow row;
    row.vehicles = vehicles;
    row.bound = 150.0;
    row.reached = ReachedFigures{};
    row.reached->goals_per_vehicle_hour = 140.0;
    floor.rows.push_back(row);
  }
  const std::string svg = throughput_svg({floor});

  EXPECT_NE(svg.find("rooms &lt;1&gt;"), std::string::npos);
  EXPECT_NE(svg.find(">reached<"), std::string::npos);
  EXPECT_NE(svg.find(">PIBT bound<"), std::string::npos);
  EXPECT_EQ(svg.find(">simulated site<"), std::string::npos) << "it was not driven";
  EXPECT_EQ(svg.find("nan"), std::string::npos);
}

}  // namespace
}  // namespace aisle::lab
