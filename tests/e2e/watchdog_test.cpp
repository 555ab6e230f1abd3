// Kills the local planner of a driving vehicle, and measures from ground truth how it comes to a stand.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/dds/dds_bus.hpp"
#include "common/scenario/scenario.hpp"
#include "tests/support/places.hpp"
#include "tools/demo/child.hpp"
#include "tools/demo/domain_lock.hpp"
#include "tools/demo/fleet.hpp"

namespace aisle::e2e {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr const char* kVehicle = "agv-1";

struct Truth {
  Clock::time_point arrived;
  double x_m, y_m, speed_mps;
};

/// The fleet of a scenario, without a referee, and an ear on its bus.
class Watchdog : public ::testing::Test {
 protected:
  void SetUp() override {
    settings_.scenario_file = test_support::source_folder() / "deploy/scenarios/crossing.yaml";
    settings_.config_folder = test_support::source_folder() / "deploy/config";
    settings_.out = test_support::program_folder() / "../e2e/watchdog";
    settings_.domain = lock_.domain();
    fs::remove_all(settings_.out);
    fs::create_directories(settings_.out / "state");
    listen();
    for (const demo::Process& process :
         demo::processes_of(scenario::read_scenario(settings_.scenario_file), settings_)) {
      if (process.is_referee) continue;
      auto child = std::make_unique<demo::Child>(process, test_support::program_folder() / process.program,
                                                 settings_.out / (process.instance + ".log"), false);
      if (process.instance == std::string("local-planner-") + kVehicle) local_planner_ = child.get();
      children_.push_back(std::move(child));
    }
  }

  void listen() {
    bus::Settings site;
    site.domain = lock_.domain();
    site.interfaces = {"127.0.0.1"};
    site.participant_name = "watchdog-test";
    bus_ = std::make_unique<bus::DdsBus>(site);
    bus_->on<topics::WorldObstacle>([this](const aisle::WorldObstacle& s, const bus::SampleInfo& info) {
      if (info.kind != bus::SampleKind::kData || s.obstacle_id().to_string() != kVehicle) return;
      way_.push_back({Clock::time_point(info.arrived), s.base_in_map().x_m(), s.base_in_map().y_m(),
                      std::hypot(s.velocity_x_mps(), s.velocity_y_mps())});
    });
    bus_->on<topics::VehicleState>([this](const aisle::VehicleState& s, const bus::SampleInfo& info) {
      if (info.kind != bus::SampleKind::kData || s.agv_id().to_string() != kVehicle || !killed_at_ || held_at_) return;
      if (s.hold() != HoldReason::HOLD_NONE) held_at_ = Clock::time_point(info.arrived);
    });
    bus_->on<topics::VehicleInfo>([this](const aisle::VehicleInfo& s, const bus::SampleInfo& info) {
      if (info.kind == bus::SampleKind::kData && s.agv_id().to_string() == kVehicle)
        deceleration_mps2_ = s.max_deceleration_mps2();
    });
  }

  bool wait_until(const std::function<bool()>& condition, std::chrono::seconds limit) {
    const Clock::time_point end = Clock::now() + limit;
    while (!condition() && Clock::now() < end) bus_->run_once(std::chrono::milliseconds(20));
    return condition();
  }

  /// At a constant speed for half a second, so that no acceleration is still under way.
  bool cruises() const {
    if (way_.size() < 30 || deceleration_mps2_ <= 0.0) return false;
    const double speed_mps = way_.back().speed_mps;
    for (std::size_t i = way_.size() - 25; i < way_.size(); ++i) {
      if (std::fabs(way_[i].speed_mps - speed_mps) > 0.02) return false;
    }
    return speed_mps > 0.5;
  }

  demo::DomainLock lock_ = demo::DomainLock::take_any(getpid());
  demo::RunSettings settings_;
  std::unique_ptr<bus::Bus> bus_;
  std::vector<std::unique_ptr<demo::Child>> children_;
  demo::Child* local_planner_{nullptr};
  std::vector<Truth> way_;
  double deceleration_mps2_{0.0};
  std::optional<Clock::time_point> killed_at_;
  std::optional<Clock::time_point> held_at_;
};

double seconds_between(Clock::time_point a, Clock::time_point b) {
  return std::chrono::duration<double>(b - a).count();
}

TEST_F(Watchdog, StopsAVehicleWhoseLocalPlannerIsKilled) {
  ASSERT_NE(local_planner_, nullptr);
  ASSERT_TRUE(wait_until([this] { return cruises(); }, std::chrono::seconds(60)))
      << "the vehicle never drove at a steady 0.5 m/s";
  local_planner_->send(SIGKILL);
  killed_at_ = Clock::now();
  const std::size_t at_kill = way_.size() - 1;
  const double speed_mps = way_[at_kill].speed_mps;
  ASSERT_TRUE(wait_until([this] { return held_at_ && way_.back().speed_mps < 1e-3; }, std::chrono::seconds(10)))
      << "it never came to a stand";

  double way_m = 0.0;
  std::size_t stood = at_kill;
  for (std::size_t i = at_kill + 1; i < way_.size(); ++i) {
    way_m += std::hypot(way_[i].x_m - way_[i - 1].x_m, way_[i].y_m - way_[i - 1].y_m);
    if (way_[i].speed_mps >= 1e-3) stood = i + 1;
  }
  const double braking_m = speed_mps * speed_mps / (2.0 * deceleration_mps2_);
  std::printf("from %.2f m/s to a stand in %.3f m (allowed %.3f m), HOLD after %.0f ms\n", speed_mps, way_m,
              1.05 * (speed_mps * 0.25 + braking_m), 1e3 * seconds_between(*killed_at_, *held_at_));
  EXPECT_LE(way_m, 1.05 * (speed_mps * 0.25 + braking_m))
      << "from " << speed_mps << " m/s at " << deceleration_mps2_ << " m/s2";
  EXPECT_GE(way_m, 0.9 * braking_m) << "faster than the vehicle can brake: the test measures something else";
  ASSERT_LT(stood, way_.size());
  EXPECT_LE(seconds_between(*killed_at_, way_[stood].arrived), 1.05 * (0.25 + speed_mps / deceleration_mps2_) + 0.02);
  EXPECT_LE(seconds_between(*killed_at_, *held_at_), 0.3) << "HOLD was named too late";
}

}  // namespace
}  // namespace aisle::e2e
