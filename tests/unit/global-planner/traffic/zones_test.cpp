// Zones in the roadmap: which places and motions they close, slow down, and make one.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "services/global-planner/core/traffic/roadmap.hpp"
#include "tests/unit/global-planner/traffic/floors.hpp"
#include "tests/unit/global-planner/traffic/roadmap_checks.hpp"

namespace aisle::global_planner::traffic {
namespace {

using fleet::Zone;
using geometry::Point2;

Zone zone_of(Zone::Kind kind, Point2 low, Point2 high) {
  Zone zone;
  zone.id = "zone";
  zone.kind = kind;
  zone.points_in_map = {low, high};
  if (kind == Zone::Kind::kSpeed) zone.max_speed_mps = 0.3;
  return zone;
}

/// A floor, one kind of vehicle and its roadmap.
struct Net {
  FloorMap floor;
  Roadmap roadmap;
  KindId kind{0};

  explicit Net(FloorMap map, const std::vector<Zone>& zones = {}, const Kind& vehicle = cart())
      : floor(std::move(map)) {
    roadmap.set_zones(zones);
    roadmap.set_map(floor.clearance, {0, 0}, floor.high());
    kind = roadmap.kind(vehicle);
  }

  template <class Visit>
  void each_motion(Visit&& visit) const {
    for (MotionId id = 0; id < roadmap.motions(); ++id)
      if (roadmap.motion(id).from != kNoId && !roadmap.motion(id).is_temporary) visit(roadmap.motion(id));
  }

  int count(bool (*counts)(const Motion&)) const {
    int sum = 0;
    each_motion([&](const Motion& motion) { sum += counts(motion) ? 1 : 0; });
    return sum;
  }

  double seconds(Point2 from, Point2 to) {
    const PlaceId a = roadmap.temporary_place(kind, {from.x, from.y, 0.0});
    const PlaceId b = roadmap.temporary_place(kind, {to.x, to.y, 0.0});
    return roadmap.seconds_to(a, b);
  }
};

int open_motions(const Net& net) {
  return net.count([](const Motion& motion) { return !motion.is_closed; });
}

TEST(TrafficZones, MotionsAgainstAOneWayZoneAreClosedAndNoOthers) {
  Zone zone = zone_of(Zone::Kind::kOneWay, {4.0, 2.0}, {8.0, 6.0});
  zone.direction_rad = 0.0;
  const Net net(room(), {zone});

  int against = 0;
  net.each_motion([&](const Motion& motion) {
    const Point2 from = motion.path_in_map.front(), to = motion.path_in_map.back();
    const bool is_in = fleet::distance_m(zone, from, to) <= 0.0;
    const bool leads_back = to.x < from.x - 0.1;
    EXPECT_EQ(motion.is_closed, is_in && leads_back) << from.x << " " << from.y << " to " << to.x << " " << to.y;
    against += motion.is_closed ? 1 : 0;
  });
  EXPECT_GT(against, 5);
}

TEST(TrafficZones, ALaneThatIsOneWayIsDrivenOneWay) {
  Zone zone = zone_of(Zone::Kind::kOneWay, {6.0, 1.0}, {8.0, 4.0});
  zone.direction_rad = geometry::kPi;
  Net net(lane_with_bay(), {zone});
  EXPECT_TRUE(std::isfinite(net.seconds({19.0, 2.5}, {2.0, 2.5})));
  EXPECT_FALSE(std::isfinite(net.seconds({2.0, 2.5}, {19.0, 2.5})));
}

TEST(TrafficZones, MotionsInASpeedZoneAreSlow) {
  const Zone zone = zone_of(Zone::Kind::kSpeed, {4.0, 2.0}, {8.0, 6.0});
  const Net net(room(), {zone});
  net.each_motion([&](const Motion& motion) {
    EXPECT_DOUBLE_EQ(motion.speed_mps, meets(zone, motion.shape) ? 0.3 : cart().limits.max_speed_mps);
  });
}

TEST(TrafficZones, ShapesInAZoneForOneVehicleMeet) {
  const Zone zone = zone_of(Zone::Kind::kOneVehicle, {2.0, 1.0}, {10.0, 7.0});
  const Net net(room(), {zone});
  std::vector<const Motion*> inside, outside;
  net.each_motion([&](const Motion& motion) { (meets(zone, motion.shape) ? inside : outside).push_back(&motion); });
  ASSERT_GT(inside.size(), 20u);
  for (const Motion* motion : inside) EXPECT_TRUE(meet(motion->shape, inside.front()->shape, 0.05));
  for (const Motion* motion : outside)
    EXPECT_EQ(motion->shape.capsules().size(), swept_shape(cart(), motion->path_in_map).capsules().size());
}

TEST(TrafficZones, NoPlaceIsOpenWhereNobodyMayStopAndMotionsLeadThrough) {
  const Zone zone = zone_of(Zone::Kind::kNoStopping, {6.0, 1.0}, {8.0, 4.0});
  Net net(lane_with_bay(), {zone});
  for (PlaceId id = 0; id < net.roadmap.places(); ++id) {
    const Place& place = net.roadmap.place(id);
    if (place.standing.empty()) continue;
    EXPECT_EQ(place.is_closed, meets(zone, place.standing)) << place.base_in_map.x;
  }

  EXPECT_EQ(net.count([](const Motion& motion) { return motion.is_through && !motion.is_closed; }), 2);
  EXPECT_TRUE(std::isfinite(net.seconds({2.0, 2.5}, {19.0, 2.5})));
  EXPECT_TRUE(std::isfinite(net.seconds({19.0, 2.5}, {2.0, 2.5})));
}

TEST(TrafficZones, WhoStandsWhereNobodyMayStopFindsAWayOut) {
  Net net(lane_with_bay(), {zone_of(Zone::Kind::kNoStopping, {6.0, 1.0}, {8.0, 4.0})});
  EXPECT_TRUE(std::isfinite(net.seconds({7.0, 2.5}, {19.0, 2.5})));
  EXPECT_FALSE(std::isfinite(net.seconds({19.0, 2.5}, {7.0, 2.5})));
}

TEST(TrafficZones, AForkliftPassesStraightWhereNobodyMayStop) {
  const Zone zone = zone_of(Zone::Kind::kNoStopping, {5.0, 0.5}, {7.0, 8.5});
  Net net(room(), {zone}, forklift());
  EXPECT_GT(net.count([](const Motion& motion) { return motion.is_through && !motion.is_closed; }), 4);
}

TEST(TrafficZones, AnEditOfZonesIsTheSameAsAMapThatHadThem) {
  for (const Zone::Kind kind :
       {Zone::Kind::kSpeed, Zone::Kind::kOneWay, Zone::Kind::kNoStopping, Zone::Kind::kOneVehicle}) {
    const Zone zone = zone_of(kind, {4.0, 2.0}, {8.0, 6.0});
    const Net bare(room()), made(room(), {zone});
    Net edited(room());
    edited.roadmap.set_zones({zone});
    EXPECT_EQ(open_motions(edited), open_motions(made)) << fleet::name(kind);
    edited.roadmap.set_zones({});
    EXPECT_EQ(open_motions(edited), open_motions(bare)) << fleet::name(kind);
  }
}

}  // namespace
}  // namespace aisle::global_planner::traffic
