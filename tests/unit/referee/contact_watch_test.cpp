#include "tools/referee/core/contact_watch.hpp"

#include <gtest/gtest.h>

namespace aisle::referee {
namespace {

using geometry::Pose2;

BodySample vehicle(const std::string& id, double t_s, const Pose2& at, double speed_mps = 1.0) {
  return {id, BodyKind::kVehicle, {0.35, 0.0, 0.0}, at, speed_mps, t_s, 1};
}
BodySample person(const std::string& id, double t_s, const Pose2& at, double speed_mps = 1.0) {
  return {id, BodyKind::kPerson, {0.25, 0.0, 0.0}, at, speed_mps, t_s, 1};
}

TEST(ContactWatch, SeesVehiclesThatCrossBetweenTheirSamples) {
  ContactWatch watch(nullptr);
  watch.see(vehicle("a", 0.0, {-2, 0, 0}));
  watch.see(vehicle("b", 0.0, {0, -2, 0}));
  watch.see(vehicle("a", 1.0, {2, 0, 0}));
  watch.see(vehicle("b", 1.0, {0, 2, 0}));
  watch.advance(1.0);
  ASSERT_EQ(watch.contacts().size(), 1u);
  const Contact& contact = watch.contacts()[0];
  EXPECT_EQ(contact.pair, PairClass::kVehicleVehicle);
  EXPECT_NEAR(contact.begin_s, 0.5, 1e-9);
  EXPECT_NEAR(contact.relative_speed_mps, 4.0 * std::sqrt(2.0), 1e-9);
  EXPECT_TRUE(contact.vehicle_moved());
  EXPECT_NEAR(contact.at_in_map.x, 0.0, 1e-9);
}

/// 2.4 x 1.1 m around a point 0.4 m before the base.
BodySample forklift(double t_s, const Pose2& at, double speed_mps) {
  return {"forklift", BodyKind::kVehicle, {0.0, 2.4, 1.1}, at, speed_mps, t_s, 1, 0.4};
}

TEST(ContactWatch, JudgesARectangleAroundItsMiddleAndNotItsBase) {
  ContactWatch watch(nullptr);
  watch.see(forklift(0.0, {0, 0, 0}, 0.0));
  watch.see(person("before", 0.0, {1.95, 0, 0}, 0.0));
  watch.see(person("behind", 0.0, {-1.15, 0, 0}, 0.0));
  watch.advance(0.1);
  EXPECT_TRUE(watch.contacts().empty());
  EXPECT_NEAR(*watch.clearances().overall_m(), 0.1, 1e-9);
  watch.see(person("before", 0.2, {1.8, 0, 0}, 0.0));
  watch.advance(0.3);
  ASSERT_EQ(watch.contacts().size(), 1u);
  EXPECT_FALSE(watch.contacts()[0].vehicle_moved());
}

TEST(ContactWatch, ClearanceOfMovingVehiclesIsKeptApart) {
  ContactWatch watch(nullptr);
  watch.see(vehicle("a", 0.0, {0, 0, 0}, 0.0));
  watch.see(person("p", 0.0, {0.7, 0, 0}));
  watch.advance(0.1);
  EXPECT_NEAR(*watch.clearances().overall_m(), 0.1, 1e-9);
  EXPECT_FALSE(watch.clearances().moving_vehicle_m) << "a person who comes near a standing vehicle is no doing of it";

  watch.see(person("p", 0.2, {1.0, 0, 0}));
  watch.see(vehicle("a", 0.2, {0, 0, 0}, 0.0));
  watch.see(vehicle("a", 0.4, {0, -0.1, 0}, 0.3));
  watch.advance(0.4);
  ASSERT_TRUE(watch.clearances().moving_vehicle_m);
  EXPECT_GT(*watch.clearances().moving_vehicle_m, 0.1);
  EXPECT_LT(*watch.clearances().moving_vehicle_m, 0.41);
}

TEST(ContactWatch, ARectangleThatSwingsOnTheSpotMoves) {
  ContactWatch watch(nullptr);
  watch.see(person("beside", 0.0, {1.4, 0.9, 0}, 0.0));
  for (int i = 0; i <= 20; ++i) watch.see(forklift(0.02 * i, {0, 0, 0.02 * i}, 0.0));
  watch.advance(0.4);
  ASSERT_EQ(watch.contacts().size(), 1u);
  EXPECT_TRUE(watch.contacts()[0].vehicle_moved());
}

TEST(ContactWatch, ComparesPlacesOfTheSameTimeThoughSamplesDiffer) {
  // One follows the other 1 m behind at 2 m/s, with samples shifted by 15 ms: never nearer than 0.3 m.
  ContactWatch watch(nullptr);
  for (int i = 0; i <= 100; ++i) {
    const double t = 0.02 * i;
    watch.see(vehicle("front", t, {2.0 * t + 1.0, 0, 0}));
    watch.see(vehicle("rear", t + 0.015, {2.0 * (t + 0.015), 0, 0}));
    watch.advance(t - 0.1);
  }
  EXPECT_TRUE(watch.contacts().empty());
  EXPECT_NEAR(*watch.clearances().overall_m(), 0.3, 1e-6);
}

TEST(ContactWatch, MergesTouchesOfOneMeetingAndCountsALaterOneAgain) {
  ContactWatch watch(nullptr);
  watch.see(vehicle("a", 0.0, {0, 0, 0}, 0.0));
  const auto person_at = [&](double t, double x) {
    watch.see(person("p", t, {x, 0, 0}));
    watch.see(vehicle("a", t, {0, 0, 0}, 0.0));
    watch.advance(t);
  };
  person_at(0.0, 2.0);
  person_at(1.0, 0.59);
  person_at(1.1, 0.61);  // 1 cm off: still the same touch
  person_at(1.2, 0.59);
  person_at(1.3, 0.70);
  person_at(1.4, 0.59);  // 10 cm off, but only for 0.2 s
  EXPECT_EQ(watch.contacts().size(), 1u);
  person_at(2.0, 2.0);
  person_at(3.0, 2.0);
  person_at(4.0, 0.5);
  EXPECT_EQ(watch.contacts().size(), 2u);
}

TEST(ContactWatch, TellsAPersonWhoWalksIntoAStandingVehicle) {
  ContactWatch watch(nullptr);
  for (int i = 0; i <= 40; ++i) {
    const double t = 0.05 * i;
    watch.see(vehicle("a", t, {0, 0, 0}, 0.0));
    watch.see(person("p", t, {2.0 - t, 0, 0}));
  }
  watch.advance(2.0);
  ASSERT_EQ(watch.contacts().size(), 1u);
  EXPECT_FALSE(watch.contacts()[0].vehicle_moved());
  EXPECT_NEAR(watch.contacts()[0].relative_speed_mps, 1.0, 1e-6);
  EXPECT_NEAR(watch.contacts()[0].begin_s, 1.4, 0.051);
}

TEST(ContactWatch, LeavesPersonsToThemselves) {
  ContactWatch watch(nullptr);
  watch.see(person("p", 0.0, {0, 0, 0}));
  watch.see(person("q", 0.0, {0.1, 0, 0}));
  watch.advance(1.0);
  EXPECT_TRUE(watch.contacts().empty());
  EXPECT_FALSE(watch.clearances().overall_m());
}

TEST(ContactWatch, SweepsFromWhereALateBodyWasHeldToWhereItAppears) {
  // The samples of "a" stop for a second while it drives on, through "b".
  ContactWatch watch(nullptr);
  watch.see(vehicle("b", 0.0, {1.5, 0, 0}, 0.0));
  watch.see(vehicle("a", 0.0, {0, 0, 0}));
  watch.advance(1.0);
  EXPECT_TRUE(watch.contacts().empty());
  watch.see(vehicle("a", 1.1, {3.0, 0, 0}));
  watch.advance(1.2);
  ASSERT_EQ(watch.contacts().size(), 1u);
}

TEST(ContactWatch, DoesNotSweepABodyThatWasSetDownAnew) {
  ContactWatch watch(nullptr);
  watch.see(vehicle("b", 0.0, {1.5, 0, 0}, 0.0));
  watch.see(vehicle("a", 0.0, {0, 0, 0}));
  watch.advance(1.0);
  BodySample again = vehicle("a", 1.1, {3.0, 0, 0});
  again.boot_id = 2;
  watch.see(again);
  watch.advance(1.2);
  EXPECT_TRUE(watch.contacts().empty());
}

TEST(ContactWatch, KeepsASilentVehicleInPlaceAndForgetsASilentPerson) {
  ContactWatch watch(nullptr);
  watch.see(vehicle("dead", 0.0, {0, 0, 0}, 0.0));
  watch.see(person("left", 0.0, {5, 0, 0}));
  watch.see(vehicle("b", 0.0, {-3, 0, 0}, 0.0));
  watch.advance(10.0);
  watch.see(vehicle("b", 10.1, {-3, 0, 0}));
  watch.see(vehicle("b", 12.0, {6, 0, 0}));
  watch.advance(12.0);
  ASSERT_EQ(watch.contacts().size(), 1u);
  EXPECT_EQ(watch.contacts()[0].pair, PairClass::kVehicleVehicle);
}

TEST(ContactWatch, SeesAWallCornerThatIsClipped) {
  grid::OccupancyGrid map({40, 40, 0.1, {0.0, 0.0}});
  map.set({20, 20}, grid::Occupancy::kOccupied);  // 2.0..2.1 in x and y
  const Walls walls(map);
  ContactWatch clips(&walls);
  clips.see(vehicle("a", 0.0, {1.0, 1.66, 0}));
  clips.see(vehicle("a", 1.0, {3.0, 1.66, 0}));
  clips.advance(1.0);
  ASSERT_EQ(clips.contacts().size(), 1u);
  EXPECT_EQ(clips.contacts()[0].b, "wall");
  ContactWatch misses(&walls);
  misses.see(vehicle("a", 0.0, {1.0, 1.64, 0}));
  misses.see(vehicle("a", 1.0, {3.0, 1.64, 0}));
  misses.advance(1.0);
  EXPECT_TRUE(misses.contacts().empty());
  EXPECT_NEAR(*misses.clearances().least_m[static_cast<std::size_t>(PairClass::kVehicleWall)], 0.01, 1e-9);
}

TEST(ContactWatch, SeesABlockWithItsCorners) {
  ContactWatch watch(nullptr);
  const BodySample block{"box", BodyKind::kBlock, {0.0, 0.8, 0.8}, {0, 0, geometry::kPi / 4}, 0.0, 0.0, 1};
  watch.see(block);  // its corner reaches 0.566 m along x
  watch.see(vehicle("a", 0.0, {0.93, -1, 0}));
  watch.see(vehicle("a", 1.0, {0.93, 1, 0}));
  watch.advance(1.0);
  EXPECT_TRUE(watch.contacts().empty());
  watch.see(vehicle("a", 2.0, {0.91, 1, 0}));
  watch.see(vehicle("a", 2.5, {0.91, -1, 0}));
  watch.advance(2.5);
  ASSERT_EQ(watch.contacts().size(), 1u);
  EXPECT_EQ(watch.contacts()[0].pair, PairClass::kVehicleBlock);
}

}  // namespace
}  // namespace aisle::referee
