// What is on the wire, and what the referee makes of it: a test plays the simulation, the planners and the vehicle.
#include "tools/referee/referee_service.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <cstdint>
#include <functional>
#include <string>

#include "common/process/clock.hpp"
#include "tests/integration/bus/two_buses.hpp"

namespace aisle::referee {
namespace {

using bus_test::run_until;

constexpr int kDomain = 229;

bus::Settings site(const std::string& name) {
  bus::Settings settings = bus_test::loopback(kDomain, name);
  settings.partition = "referee-test-" + std::to_string(getpid());
  return settings;
}

class Refereed : public ::testing::Test {
 protected:
  Refereed() {
    EXPECT_TRUE(run_until({&fleet_, &ear_}, [this] {
      return truths_.matched_readers() == 1 && states_.matched_readers() == 1 && plans_.matched_readers() == 1 &&
             goals_.matched_readers() == 1 && statuses_.matched_readers() == 1;
    }));
  }

  Origin origin(const std::string& source) {
    Origin by;
    by.source_id(source);
    by.boot_id(1);
    by.epoch(1);
    by.sequence_number(++sequence_);
    by.stamp_ns(process::wall_clock_ns());
    return by;
  }

  void show(const std::string& id, BodyKind kind, double x_m, double y_m, double speed_mps) {
    WorldObstacle truth;
    truth.obstacle_id(id);
    truth.by(origin(id));
    truth.kind(kind == BodyKind::kVehicle ? aisle::BodyKind::BODY_VEHICLE : aisle::BodyKind::BODY_PERSON);
    truth.shape(FootprintKind::FOOTPRINT_DISC);
    truth.base_in_map().x_m(x_m);
    truth.base_in_map().y_m(y_m);
    truth.velocity_x_mps(speed_mps);
    truth.radius_m(0.35);
    truths_.write(truth);
  }

  void report(const std::string& commanded_agv_id, std::uint32_t epoch) {
    VehicleState state;
    state.agv_id("agv-1");
    state.by(origin("fake-vehicle-agv-1"));
    state.command_agv_id(commanded_agv_id);
    state.command_by(origin("local-planner-agv-1"));
    state.command_by().epoch(epoch);
    state.command_plan_id(1);
    states_.write(state);
  }

  void give_goal(double x_m) {
    Goal goal;
    goal.agv_id("agv-1");
    goal.by(origin("dispatcher"));
    goal.goal_id("agv-1/0");
    goal.pose_in_map().x_m(x_m);
    goal.position_tolerance_m(0.1);
    goals_.write(goal);
  }

  void say_arrived() {
    NavigationStatus status;
    status.agv_id("agv-1");
    status.by(origin("local-planner-agv-1"));
    status.goal_id("agv-1/0");
    status.phase(NavigationPhase::PHASE_ARRIVED);
    statuses_.write(status);
  }

  bool hears_until(const std::function<bool()>& done) { return run_until({&fleet_, &ear_}, done); }
  /// Repeats `say` every 20 ms until `done`: best-effort samples may be lost.
  bool repeats_until(const std::function<void()>& say, const std::function<bool()>& done) {
    auto next = std::chrono::steady_clock::now();
    return run_until({&fleet_, &ear_}, [&] {
      if (std::chrono::steady_clock::now() >= next) {
        say();
        next += std::chrono::milliseconds(20);
      }
      return done();
    });
  }

  Walls walls_{grid::OccupancyGrid({100, 100, 0.1, {0.0, 0.0}})};
  bus::DdsBus ear_{site("referee")};
  service::Shell shell_{ear_, {"referee", "referee", "", 1, "host-1", 1}};
  RefereeService referee_{shell_, walls_, Expectation{{{"agv-1", 1}}}};
  bus::DdsBus fleet_{site("fleet")};
  bus::Writer<topics::WorldObstacle> truths_{fleet_.writer<topics::WorldObstacle>()};
  bus::Writer<topics::VehicleState> states_{fleet_.writer<topics::VehicleState>()};
  bus::Writer<topics::Plan> plans_{fleet_.writer<topics::Plan>()};
  bus::Writer<topics::Goal> goals_{fleet_.writer<topics::Goal>()};
  bus::Writer<topics::NavigationStatus> statuses_{fleet_.writer<topics::NavigationStatus>()};
  std::uint64_t sequence_{0};
};

TEST_F(Refereed, AVehicleThatJumpsThroughAPersonBetweenTwoSamplesTouchesIt) {
  ASSERT_TRUE(repeats_until(
      [&] {
        show("person-1", BodyKind::kPerson, 5.0, 5.0, 0.0);
        show("agv-1", BodyKind::kVehicle, 3.0, 5.0, 1.0);
      },
      [&] { return referee_.judge().contacts().clearances().overall_m().has_value(); }));
  EXPECT_TRUE(referee_.judge().contacts().contacts().empty());
  ASSERT_TRUE(repeats_until(
      [&] {
        show("person-1", BodyKind::kPerson, 5.0, 5.0, 0.0);
        show("agv-1", BodyKind::kVehicle, 7.0, 5.0, 1.0);
      },
      [&] { return !referee_.judge().contacts().contacts().empty(); }));
  const Contact& contact = referee_.judge().contacts().contacts()[0];
  EXPECT_EQ(contact.pair, PairClass::kVehiclePerson);
  EXPECT_EQ(contact.a, "agv-1");
  EXPECT_TRUE(contact.vehicle_moved());
}

TEST_F(Refereed, ACommandForAnotherVehicleAndAnEpochThatGoesBackAreNamed) {
  ASSERT_TRUE(repeats_until([&] { report("agv-2", 3); }, [&] { return referee_.judge().violations() == 1; }));
  ASSERT_TRUE(repeats_until([&] { report("agv-1", 2); }, [&] { return referee_.judge().violations() == 2; }));
  const RunReport report = referee_.finish();
  EXPECT_EQ(report.violations[0].kind, AuthorityViolation::Kind::kForeignVehicle);
  EXPECT_EQ(report.violations[1].kind, AuthorityViolation::Kind::kEpochWentBack);
  EXPECT_FALSE(report.passed());
}

TEST_F(Refereed, ARunIsOverWhenTheVehicleStandsAtItsGoal) {
  give_goal(4.0);
  ASSERT_TRUE(hears_until([&] { return referee_.judge().goals().assigned_count() == 1; }));
  EXPECT_FALSE(referee_.is_over());
  ASSERT_TRUE(repeats_until(
      [&] {
        show("agv-1", BodyKind::kVehicle, 4.02, 0.0, 0.0);
        say_arrived();
      },
      [&] { return referee_.is_over(); }));
  EXPECT_TRUE(referee_.finish().passed());
}

TEST_F(Refereed, ATruthThatIsNoNumberIsCountedAndNotJudged) {
  ASSERT_TRUE(repeats_until([&] { show("agv-1", BodyKind::kVehicle, std::nan(""), 0.0, 0.0); },
                            [&] { return shell_.health().counters["dropped_world_obstacle"] > 0; }));
  EXPECT_EQ(referee_.judge().vehicles_seen(), 0);
}

}  // namespace
}  // namespace aisle::referee
