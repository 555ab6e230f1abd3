#include "services/local-planner/core/keep_out.hpp"

#include <gtest/gtest.h>

namespace aisle::local_planner {
namespace {

using geometry::Pose2;

/// A free floor of 10 x 10 m with a zone of 2 x 2 m in its middle, and a disc of 0.3 m.
class KeepOutTest : public ::testing::Test {
 protected:
  KeepOutTest() : grid_(grid::Geometry{100, 100, 0.1, {}}), clearance_(grid_) {
    zone_.id = "zone";
    zone_.points_in_map = {{4.0, 4.0}, {6.0, 6.0}};
    keep_out_.set_map(grid_, clearance_);
  }

  /// Is the zone's middle closed to a vehicle there?
  bool is_closed_at(double x, double y) {
    return keep_out_.clearance(Pose2{x, y, 0.0}, 0.3)->clearance_m(geometry::Point2{5.0, 5.0}) <= 0.0;
  }

  grid::OccupancyGrid grid_;
  grid::ClearanceField clearance_;
  fleet::Zone zone_;
  KeepOut keep_out_;
};

TEST_F(KeepOutTest, WithoutZonesTheMapsOwnFieldIsUsed) {
  EXPECT_EQ(keep_out_.clearance(Pose2{1.0, 1.0, 0.0}, 0.3), &clearance_);
  zone_.kind = fleet::Zone::Kind::kSpeed;
  keep_out_.set_zones({zone_});
  EXPECT_EQ(keep_out_.clearance(Pose2{1.0, 1.0, 0.0}, 0.3), &clearance_);
}

TEST_F(KeepOutTest, AZoneIsClosedToAVehicleOutside) {
  keep_out_.set_zones({zone_});
  EXPECT_TRUE(is_closed_at(1.0, 1.0));
  EXPECT_TRUE(is_closed_at(3.72, 5.0)) << "its outline touches the zone, no more";
}

TEST_F(KeepOutTest, AVehicleThatStandsInAZoneMayLeaveItAndNotComeBack) {
  keep_out_.set_zones({zone_});
  EXPECT_FALSE(is_closed_at(5.0, 5.0));
  EXPECT_FALSE(is_closed_at(3.65, 5.0));
  EXPECT_TRUE(is_closed_at(3.5, 5.0));
  EXPECT_TRUE(is_closed_at(3.69, 5.0));
}

TEST_F(KeepOutTest, ItKnowsTheNewestMapAndTheNewestZones) {
  keep_out_.set_zones({zone_});
  EXPECT_TRUE(is_closed_at(1.0, 1.0));
  keep_out_.set_zones({});
  EXPECT_FALSE(is_closed_at(1.0, 1.0));

  keep_out_.set_zones({zone_});
  grid_.set({10, 10}, grid::Occupancy::kOccupied);
  clearance_ = grid::ClearanceField(grid_);
  keep_out_.set_map(grid_, clearance_);
  EXPECT_LE(keep_out_.clearance(Pose2{9.0, 9.0, 0.0}, 0.3)->clearance_m(geometry::Point2{1.05, 1.05}), 0.0);
}

}  // namespace
}  // namespace aisle::local_planner
