#include "tools/referee/core/zone_watch.hpp"

#include <gtest/gtest.h>

#include <string>

namespace aisle::referee {
namespace {

using fleet::Zone;

/// A zone of 4 x 4 m around the origin, and discs of 0.3 m.
class ZoneWatchTest : public ::testing::Test {
 protected:
  void watch(Zone::Kind kind) {
    Zone zone;
    zone.id = "dock";
    zone.kind = kind;
    zone.points_in_map = {{-2.0, -2.0}, {2.0, 2.0}};
    zone.max_speed_mps = kind == Zone::Kind::kSpeed ? 0.3 : 0.0;
    watch_.zones_seen({zone});
  }

  void see(const std::string& id, double x, double y, BodyKind kind = BodyKind::kVehicle) {
    watch_.body_seen({id, kind, {0.3, 0.0, 0.0}, {x, y, 0.0}, 0.0, t_s_, 1, 0.0});
  }

  /// Along y = 0, in steps of 0.1 s; negative speeds lead back.
  void drive(double from_x, double to_x, double mps) {
    for (double x = from_x; (to_x - x) * mps > 0.0; x += 0.1 * mps) {
      t_s_ += 0.1;
      see("agv-1", x, 0.0);
    }
  }

  void stand(double x, double seconds) {
    for (double left_s = seconds; left_s > 0.0; left_s -= 0.1) {
      t_s_ += 0.1;
      see("agv-1", x, 0.0);
    }
  }

  std::size_t breaches() const { return watch_.violations().size(); }

  ZoneWatch watch_;
  double t_s_{0.0};
};

TEST_F(ZoneWatchTest, AnOutlineInAKeepOutZoneIsToldOncePerStay) {
  watch(Zone::Kind::kKeepOut);
  drive(-4.0, -2.35, 0.5);
  EXPECT_EQ(breaches(), 0u);
  drive(-2.35, 0.0, 0.5);
  ASSERT_EQ(breaches(), 1u);
  EXPECT_EQ(watch_.violations()[0].agv_id, "agv-1");
  EXPECT_NE(watch_.violations()[0].text.find("enters the keep-out zone dock"), std::string::npos);
  drive(0.0, 4.0, 0.5);
  drive(4.0, 0.0, -0.5);
  EXPECT_EQ(breaches(), 2u);
}

TEST_F(ZoneWatchTest, WhoIsInsideFromTheBeginningMayLeave) {
  watch(Zone::Kind::kKeepOut);
  drive(0.0, 4.0, 0.5);
  EXPECT_EQ(breaches(), 0u);
}

TEST_F(ZoneWatchTest, ASpeedZoneIsDrivenSlowly) {
  watch(Zone::Kind::kSpeed);
  drive(-4.0, -2.4, 1.0);
  drive(-2.4, 2.4, 0.3);
  EXPECT_EQ(breaches(), 0u);
  drive(2.4, 4.0, 1.0);
  drive(4.0, -4.0, -0.5);
  EXPECT_EQ(breaches(), 1u);
}

TEST_F(ZoneWatchTest, AOneWayZoneIsNotDrivenBack) {
  watch(Zone::Kind::kOneWay);
  drive(-4.0, 4.0, 0.5);
  EXPECT_EQ(breaches(), 0u);
  drive(4.0, -4.0, -0.5);
  EXPECT_EQ(breaches(), 1u);
}

TEST_F(ZoneWatchTest, NobodyStandsWhereNoneMayStopButBeforeAPerson) {
  watch(Zone::Kind::kNoStopping);
  drive(-4.0, 0.0, 0.5);
  see("person-1", 1.5, 0.0, BodyKind::kPerson);
  stand(0.0, 5.0);
  EXPECT_EQ(breaches(), 0u);
  watch_.body_gone("person-1");
  stand(0.0, 0.2);
  EXPECT_EQ(breaches(), 1u);
}

TEST_F(ZoneWatchTest, OneVehicleAtATime) {
  watch(Zone::Kind::kOneVehicle);
  see("agv-2", 5.0, 0.0);
  drive(-4.0, 0.0, 0.5);
  see("agv-2", 2.35, 0.0);
  EXPECT_EQ(breaches(), 0u);
  see("agv-2", 2.2, 0.0);
  ASSERT_EQ(breaches(), 1u);
  EXPECT_NE(watch_.violations()[0].text.find("is beside agv-1 in the one-vehicle zone dock"), std::string::npos);
}

TEST_F(ZoneWatchTest, ARectangleIsSeenByItsSides) {
  watch(Zone::Kind::kKeepOut);
  const Shape forklift{0.0, 2.0, 1.0};
  watch_.body_seen({"agv-1", BodyKind::kVehicle, forklift, {-4.0, 2.4, 0.0}, 0.0, 0.1, 1, 0.0});
  watch_.body_seen({"agv-1", BodyKind::kVehicle, forklift, {0.0, 2.55, 0.0}, 0.0, 0.2, 1, 0.0});
  EXPECT_EQ(breaches(), 0u);
  watch_.body_seen({"agv-1", BodyKind::kVehicle, forklift, {0.0, 2.4, 0.0}, 0.0, 0.3, 1, 0.0});
  EXPECT_EQ(breaches(), 1u);
}

}  // namespace
}  // namespace aisle::referee
