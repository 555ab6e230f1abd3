#include "tools/lockstep/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <random>
#include <set>

#include "services/global-planner/core/fleet_planner.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tools/lockstep/world.hpp"

namespace aisle::lockstep {
namespace {

using geometry::Point2;
using geometry::Pose2;
using local_planner::Output;
using local_planner::Phase;

constexpr double kDt = 0.02;

double cpu_us() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
}

struct Agv {
  VehicleSetup setup;
  Wheels wheels;
  local_planner::LocalPlanner core;
  local_planner::Inputs inputs;
  Output output;
  std::vector<local_planner::IntentPoint> intent;   // as last published
  time::Stamp intent_at{};
  Phase published_phase{Phase::kWaiting};
  local_planner::Reason published_reason{};
  std::size_t goal{0};
  bool done{false};
  double last_turn{0.0};
};

class Run {
 public:
  Run(const Setup& setup, const Watch& watch)
      : setup_(setup), watch_(watch), grid_(setup.grid), clearance_(setup.grid, 3.0), tracker_(setup.sensor_range_m, setup.seed), random_(setup.seed),
        fleet_({}, global_planner::find_variant(setup.planner)->make()) {
    for (const VehicleSetup& v : setup.vehicles) {
      agvs_.push_back({v, Wheels(v, setup.dead_time_s), local_planner::LocalPlanner(setup.settings), {}, {}, {}, {}, {}, {}, 0, false, 0.0});
      result_.goals_assigned += static_cast<int>(v.goals_in_map.size());
    }
    for (const MoverSetup& m : setup.movers) walkers_.emplace_back(m);
  }

  Result all() {
    for (Agv& agv : agvs_) {
      agv.inputs.vehicle = agv.setup.vehicle;
      fleet_.set_vehicle(agv.setup.vehicle.id, agv.setup.vehicle.radius_m);
      give_goal(agv);
    }
    fleet_.set_map("lockstep", revision_, grid_, {0, 0}, {grid_.geometry().width - 1, grid_.geometry().height - 1});
    const int steps = static_cast<int>(setup_.duration_s / kDt);
    for (tick_ = 0; tick_ < steps; ++tick_) {
      t_ = tick_ * kDt;
      step();
      if (std::all_of(agvs_.begin(), agvs_.end(), [](const Agv& a) { return a.done; })) break;
    }
    result_.time_s = t_;
    for (const Agv& agv : agvs_)
      if (!agv.done) note(agv, std::string("goal missed: ") + name(agv.output.phase) + ", " + name(agv.output.reason) + " " + agv.output.detail);
    result_.step_us_mean = steps_ > 0 ? total_us_ / static_cast<double>(steps_) : 0.0;
    return result_;
  }

 private:
  time::Stamp now() const { return time::from_seconds(100.0 + t_); }

  void note(const std::string& text) {
    char line[400];
    std::snprintf(line, sizeof line, "%7.2f %s", t_, text.c_str());
    result_.log.emplace_back(line);
  }

  void note(const Agv& agv, const std::string& text) {
    char line[400];
    std::snprintf(line, sizeof line, "%7.2f %s (%.2f, %.2f, %.2f) %s", t_, agv.setup.vehicle.id.c_str(), agv.wheels.base_in_map().x,
                  agv.wheels.base_in_map().y, agv.wheels.base_in_map().yaw, text.c_str());
    result_.log.emplace_back(line);
  }

  /// The goal that the dispatcher would give now.
  void give_goal(const Agv& agv) {
    global_planner::Goal goal;
    goal.id = agv.setup.vehicle.id + "-" + std::to_string(agv.goal);
    goal.pose_in_map = agv.setup.goals_in_map[agv.goal];
    goal.position_tolerance_m = 0.15;
    goal.yaw_tolerance_rad = agv.setup.heading_matters ? 0.1 : 0.0;
    fleet_.set_goal(agv.setup.vehicle.id, goal);
  }

  /// As aisle-global-planner does: hears the vehicles at 10 Hz, publishes what is due.
  void plan() {
    for (const Agv& agv : agvs_) fleet_.set_pose(agv.setup.vehicle.id, agv.wheels.base_in_map(), now());
    while (const auto made = fleet_.step(now(), [] { return false; })) {
      if (made->trigger != global_planner::Trigger::kNewGoal) ++result_.replans;
      local_planner::Plan plan;
      plan.id = made->plan_id;
      plan.goal_id = made->goal.id;
      plan.map_revision = made->map_revision;
      plan.outcome = made->outcome == global_planner::FleetOutcome::kFound ? local_planner::Plan::Outcome::kFound : local_planner::Plan::Outcome::kNotFound;
      plan.detail = made->detail;
      plan.goal_in_map = made->goal.pose_in_map;
      plan.position_tolerance_m = made->goal.position_tolerance_m;
      plan.yaw_tolerance_rad = made->goal.yaw_tolerance_rad;
      plan.waypoints_in_map = made->waypoints_in_map;
      for (Agv& agv : agvs_)
        if (agv.setup.vehicle.id == made->agv_id) agv.inputs.plan = plan;
    }
    for (const std::string& event : fleet_.take_events()) note("global: " + event);
  }

  /// What the global planner hears of `navigation_status`.
  void announce(const Agv& agv) {
    using Navigation = global_planner::Navigation;
    Navigation navigation;
    navigation.goal_id = agv.inputs.plan ? agv.inputs.plan->goal_id : "";
    navigation.plan_id = agv.inputs.plan ? agv.inputs.plan->id : 0;
    const Phase phase = agv.output.phase;
    navigation.activity = phase == Phase::kBlocked                            ? Navigation::Activity::kBlocked
                          : phase == Phase::kArrived                          ? Navigation::Activity::kArrived
                          : phase == Phase::kFailed || phase == Phase::kHeld  ? Navigation::Activity::kStopped
                                                                              : Navigation::Activity::kUnderway;
    navigation.cause = agv.output.reason == local_planner::Reason::kVehicle    ? Navigation::Cause::kVehicle
                       : agv.output.reason == local_planner::Reason::kObstacle ? Navigation::Cause::kObstacle
                                                                               : Navigation::Cause::kOther;
    navigation.blocked_at_in_map = agv.output.blocked_at_in_map;
    navigation.blocked_radius_m = agv.output.blocked_radius_m;
    fleet_.set_navigation(agv.setup.vehicle.id, navigation, now());
  }

  void step() {
    edit_map();
    const bool scan = tick_ % 5 == 0;
    move_people();
    if (tick_ % 5 == 2) publish_tracks();
    if (scan) track();
    if (scan) plan();
    for (Agv& agv : agvs_) {
      agv.inputs.clearance = &clearance_;
      agv.inputs.map_revision = revision_;
      local_planner::VehicleState state{agv.wheels.base_in_map(), agv.wheels.twist()};
      if (setup_.state_noise_m > 0.0) {
        std::normal_distribution<double> noise(0.0, setup_.state_noise_m);
        state.base_in_map.x += noise(random_), state.base_in_map.y += noise(random_);
      }
      agv.inputs.state.set(state, now());
      agv.inputs.tracker_alive = now();
      agv.inputs.tracks = tracks_;
    }
    for (Agv& agv : agvs_) control(agv);
    for (Agv& agv : agvs_) {
      const Pose2 before = agv.wheels.base_in_map();
      agv.wheels.step(agv.output.twist, kDt);
      result_.distance_m += geometry::distance(before.position(), agv.wheels.base_in_map().position());
      hash(agv.wheels.base_in_map());
      const double w = agv.wheels.twist().angular_radps;
      if (std::abs(w) > 0.05) {
        if (w * agv.last_turn < 0.0) ++result_.turn_sign_changes;
        agv.last_turn = w;
      }
    }
    judge();
    if (watch_ && tick_ % 5 == 0) {
      std::vector<Pose2> vehicles;
      std::vector<Point2> people;
      std::vector<Output> outputs;
      for (const Agv& a : agvs_) vehicles.push_back(a.wheels.base_in_map()), outputs.push_back(a.output);
      for (const Walker& w : walkers_) people.push_back(w.is_present() ? w.position_in_map() : Point2{-100.0, -100.0});
      watch_(t_, vehicles, people, outputs);
    }
  }

  void hash(const Pose2& pose) {
    for (const double value : {pose.x, pose.y, pose.yaw}) {
      std::uint64_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      result_.trace_hash = (result_.trace_hash ^ bits) * 1099511628211ULL;
    }
  }

  void edit_map() {
    for (const EditSetup& edit : setup_.edits) {
      if (t_ < edit.at_s || t_ >= edit.at_s + kDt) continue;
      const auto& g = grid_.geometry();
      const grid::Cell low = g.cell_at(edit.low_in_map);
      const grid::Cell high = g.cell_at(edit.high_in_map);
      bool occupied = false;      // as a site would: nobody blocks a place where a vehicle stands
      for (const Agv& a : agvs_)
        occupied = occupied || (a.wheels.base_in_map().x > edit.low_in_map.x - 1.0 && a.wheels.base_in_map().x < edit.high_in_map.x + 1.0 &&
                                a.wheels.base_in_map().y > edit.low_in_map.y - 1.0 && a.wheels.base_in_map().y < edit.high_in_map.y + 1.0);
      if (occupied) continue;
      for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x)
          if (g.contains({x, y})) grid_.set({x, y}, grid::Occupancy::kOccupied);
      clearance_.update(grid_, low, high);
      ++revision_;
      fleet_.set_map("lockstep", revision_, grid_, low, high);
    }
  }

  void move_people() {
    std::vector<local_planner::Disc> vehicles;
    for (const Agv& a : agvs_) vehicles.push_back({a.wheels.base_in_map().position(), a.setup.vehicle.radius_m});
    for (Walker& walker : walkers_) walker.step(t_, kDt, vehicles);
  }

  void track() {
    std::vector<PerfectTracker::Body> bodies;
    for (const Walker& w : walkers_) bodies.push_back({w.position_in_map(), w.velocity_in_map(), w.radius_m(), w.is_present()});
    for (const BlockSetup& b : setup_.blocks) bodies.push_back({b.center_in_map, {}, 0.67 * b.edge_m, t_ >= b.appear_s});
    std::vector<Pose2> sensors;
    for (const Agv& a : agvs_) sensors.push_back(a.wheels.base_in_map());
    tracker_.scan(bodies, sensors, grid_);
  }

  /// Two cycles after the scan.
  void publish_tracks() {
    for (const auto& seen : tracks_) fleet_.drop_track(seen.track.id);
    tracks_ = tracker_.tracks();
    for (auto& seen : tracks_) {
      seen.arrived = now();
      if (seen.track.is_static) fleet_.set_static_track(seen.track.id, {seen.track.position_in_map, seen.track.radius_m});
    }
  }

  void control(Agv& agv) {
    agv.inputs.peers.clear();
    for (const Agv& other : agvs_) {
      if (&other == &agv) continue;
      agv.inputs.peers.push_back({other.setup.vehicle.id, other.setup.vehicle.radius_m, other.setup.vehicle.limits, *other.inputs.state.any(),
                                  other.inputs.state.arrived(), other.published_phase, other.published_reason, other.intent, other.intent_at});
    }
    const double begin = cpu_us();
    agv.output = agv.core.step(agv.inputs, now());
    const double us = cpu_us() - begin;
    total_us_ += us;
    ++steps_;
    result_.step_us_max = std::max(result_.step_us_max, us);
    for (const auto& event : agv.output.events) note(agv, event.text);
    const bool changed = agv.output.phase != agv.published_phase || agv.output.reason != agv.published_reason;
    if (changed) note(agv, std::string(name(agv.output.phase)) + ", " + name(agv.output.reason) + " " + agv.output.detail);
    if (changed || tick_ % 5 == 0) {
      agv.intent = agv.output.intent;
      agv.intent_at = now();
      agv.published_phase = agv.output.phase;
      agv.published_reason = agv.output.reason;
      announce(agv);
    }
    if (agv.output.phase == Phase::kArrived && !agv.done) {
      ++result_.goals_reached;
      if (++agv.goal == agv.setup.goals_in_map.size()) agv.done = true;
      else give_goal(agv);
    }
  }

  void contact(const Agv& agv, double gap, bool moving, const std::string& what) {
    if (moving) result_.least_clearance_m = std::min(result_.least_clearance_m, gap);
    const std::string key = agv.setup.vehicle.id + what;
    if (gap > 0.02) touching_.erase(key);
    if (gap > 0.0) return;
    const bool known = touching_.count(key) > 0;
    const bool known_moving = moving_.count(key) > 0 && known;
    touching_.insert(key);
    if (!known) ++result_.contacts, moving_.erase(key);
    if (moving && !known_moving) ++result_.contacts_moving_vehicle, moving_.insert(key);
    if (!known || (moving && !known_moving)) note(agv, "CONTACT with " + what + (moving ? " moving at " + std::to_string(agv.wheels.twist().linear_mps) : " standing"));
  }

  void judge() {
    for (std::size_t i = 0; i < agvs_.size(); ++i) {
      const Agv& a = agvs_[i];
      const Point2 p = a.wheels.base_in_map().position();
      const bool moving = std::abs(a.wheels.twist().linear_mps) > 0.05;
      const double r = a.setup.vehicle.radius_m;
      if (clearance_.clearance_m(p) < r + 0.1) contact(a, distance_to_walls_m(grid_, p) - r, moving, "wall");
      for (std::size_t k = 0; k < setup_.blocks.size(); ++k)
        if (t_ >= setup_.blocks[k].appear_s)
          contact(a, distance_to_square_m(p, setup_.blocks[k].center_in_map, setup_.blocks[k].edge_m) - r, moving, "block " + std::to_string(k));
      for (std::size_t k = 0; k < walkers_.size(); ++k)
        if (walkers_[k].is_present())
          contact(a, geometry::distance(p, walkers_[k].position_in_map()) - r - walkers_[k].radius_m(), moving, "person " + std::to_string(k));
      for (std::size_t k = 0; k < agvs_.size(); ++k)
        if (k != i) contact(a, geometry::distance(p, agvs_[k].wheels.base_in_map().position()) - r - agvs_[k].setup.vehicle.radius_m, moving, agvs_[k].setup.vehicle.id);
    }
  }

  const Setup& setup_;
  const Watch& watch_;
  grid::OccupancyGrid grid_;
  grid::ClearanceField clearance_;
  PerfectTracker tracker_;
  std::mt19937_64 random_;
  global_planner::FleetPlanner fleet_;
  std::vector<Agv> agvs_;
  std::vector<Walker> walkers_;
  std::vector<local_planner::SeenTrack> tracks_;
  std::set<std::string> touching_, moving_;
  std::uint64_t revision_{1};
  int tick_{0};
  double t_{0.0};
  double total_us_{0.0};
  std::uint64_t steps_{0};
  Result result_;
};

}  // namespace

Result run(const Setup& setup, const Watch& watch) { return Run(setup, watch).all(); }

}  // namespace aisle::lockstep
