#pragma once
// A vehicle in the loop with its planner, for the tests of this folder.
#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "services/local-planner/core/planner.hpp"

namespace aisle::local_planner {

/// One vehicle that obeys its planner a dead time later, in a world that the test writes.
class Drive {
 public:
  explicit Drive(const grid::OccupancyGrid& grid, geometry::Pose2 start = {3.0, 5.0, 0.0},
                 const Variant& variant = wang(), const Settings& settings = {})
      : planner(make_planner(settings, variant)), base(start), clearance_(grid) {
    inputs.clearance = &clearance_;
    inputs.map_revision = 1;
    inputs.vehicle = Vehicle{"agv-1", geometry::disc(0.35), {}, 10.0, 0.2};
  }

  void give_plan(std::vector<geometry::Point2> waypoints, const std::string& goal_id = "goal-1") {
    Plan plan;
    plan.id = ++plans_;
    plan.goal_id = goal_id;
    plan.map_revision = inputs.map_revision;
    plan.goal_in_map = {waypoints.back().x, waypoints.back().y, 0.0};
    plan.waypoints_in_map = std::move(waypoints);
    inputs.plan = plan;
  }

  Output cycle() {
    now += std::chrono::milliseconds(20);
    if (state_comes) inputs.state.set({base, twist}, now);
    if (tracker_lives) inputs.tracker_heard = now;
    if (tracker_lives && lidar_lives) inputs.tracker_alive = now;
    output = planner->step(inputs, now);
    pipe_.push_back(output.twist);
    twist = kinematics::limit_change(twist, pipe_.size() > 5 ? pipe_.front() : geometry::Twist2{},
                                     inputs.vehicle->limits, 0.02);
    if (pipe_.size() > 5) pipe_.pop_front();
    base = kinematics::advance(base, twist, 0.02);
    return output;
  }
  /// Until it is true, at most so long. @returns whether it came true
  bool until(double seconds, const std::function<bool()>& is_true) {
    for (int i = 0; i < static_cast<int>(seconds / 0.02); ++i) {
      cycle();
      if (is_true()) return true;
    }
    return false;
  }
  bool until(double seconds, Phase phase) {
    return until(seconds, [&] { return output.phase == phase; });
  }
  void run(double seconds) {
    until(seconds, [] { return false; });
  }
  bool stops_within(double seconds) {
    return until(seconds, [&] { return std::abs(twist.linear_mps) < 1e-3 && std::abs(twist.angular_radps) < 1e-3; });
  }
  SeenTrack track(geometry::Point2 position, geometry::Point2 velocity, bool is_static) const {
    SeenTrack seen;
    seen.track.position_in_map = position;
    seen.track.velocity_in_map = velocity;
    seen.track.radius_m = 0.25;
    seen.track.is_static = is_static;
    seen.arrived = now;
    return seen;
  }

  Inputs inputs;
  std::unique_ptr<Planner> planner;
  Output output;
  geometry::Pose2 base;
  geometry::Twist2 twist;
  time::Stamp now{std::chrono::seconds(100)};
  bool state_comes{true};
  bool tracker_lives{true};
  bool lidar_lives{true};

 private:
  grid::ClearanceField clearance_;
  std::deque<geometry::Twist2> pipe_;
  std::uint64_t plans_{0};
};

}  // namespace aisle::local_planner
