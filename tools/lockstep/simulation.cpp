#include "tools/lockstep/simulation.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <memory>
#include <random>

#include "common/scenario/variation.hpp"
#include "services/fake-vehicle/core/simulated_vehicle.hpp"
#include "services/fake-world/core/world.hpp"
#include "services/global-planner/core/fleet_planner.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tools/lockstep/judge.hpp"
#include "tools/lockstep/perception.hpp"

namespace aisle::lockstep {
namespace {

using geometry::Body;
using geometry::Point2;
using geometry::Pose2;
using local_planner::Output;
using local_planner::Phase;

constexpr double kDt = 0.02;
constexpr int kSlowEvery = 5;    // scans, status and traces come at 10 Hz
constexpr int kAskEvery = 50;    // a second
constexpr int kTracksAfter = 2;  // cycles from the scans to their tracks
constexpr double kClockAtStartS = 100.0;
constexpr const char* kContact = "CONTACT";
constexpr const char* kGoalMissed = "goal missed";

double cpu_us() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return 1e6 * static_cast<double>(t.tv_sec) + 1e-3 * static_cast<double>(t.tv_nsec);
}

double length_m(const std::vector<Point2>& way) {
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) length += geometry::distance(way[i - 1], way[i]);
  return length;
}

struct Agv {
  std::string id;
  fake_vehicle::Parameters parameters;
  fake_vehicle::SimulatedVehicle body;
  local_planner::LocalPlanner core;
  std::vector<Pose2> goals_in_map;  // of all missions, in order
  std::vector<bool> heading_matters;
  std::size_t goal{0};
  int replans{0};
  local_planner::Inputs inputs;
  Output output;
  local_planner::Peer announced;  // as its last status said
  double last_turn{0.0};
  double last_mps{0.0};
  double last_mps2{0.0};
  double done_s{0.0};
  bool moved{false};  // before this cycle; a vehicle that touches something stands at once
  bool is_done() const { return goal >= goals_in_map.size(); }
};

class Run {
 public:
  Run(const Setup& setup, const Watch& watch)
      : setup_(setup),
        watch_(watch),
        grid_(setup.grid),
        clearance_(setup.grid, 5.0),
        world_(setup.scenario, setup.people, setup.seed, nullptr),
        random_(setup.seed),
        fleet_({}, global_planner::find_variant(setup.planner)->make()) {
    if (setup.perception == Perception::kTruth) {
      perceiver_ = std::make_unique<TruthPerceiver>(setup.vehicle.lidar.range_max_m, setup.seed);
    } else {
      const Told told = setup.perception == Perception::kScansHeldStill ? Told::kHeldStill : Told::kAsTracked;
      perceiver_ = std::make_unique<ScanPerceiver>(setup.vehicle.lidar, setup.only_scans_of, setup.seed, told);
    }
    for (const scenario::Vehicle& vehicle : setup.scenario.vehicles) add(vehicle);
  }

  Result all(const std::function<bool(double t_s)>& goes_on) {
    fleet_.set_map("lockstep", revision_, grid_, {0, 0}, {grid_.geometry().width - 1, grid_.geometry().height - 1});
    const int steps = static_cast<int>(setup_.scenario.duration_s / kDt);
    for (tick_ = 0; tick_ < steps; ++tick_) {
      t_ = tick_ * kDt;
      if (goes_on && tick_ % kAskEvery == 0 && !goes_on(t_)) break;
      step();
      if (std::all_of(agvs_.begin(), agvs_.end(), [](const Agv& a) { return a.is_done(); })) break;
    }
    result_.time_s = t_;
    for (const Agv& agv : agvs_) {
      result_.reached.push_back(static_cast<int>(agv.goal));
      result_.replanned.push_back(agv.replans);
      result_.replans += agv.replans;
    }
    for (const Agv& agv : agvs_) result_.done_s.push_back(agv.is_done() ? agv.done_s : -1.0);
    for (const Agv& agv : agvs_)
      if (!agv.is_done())
        note(agv, std::string(kGoalMissed) + ": " + name(agv.output.phase) + ", " + name(agv.output.reason) + " " +
                      agv.output.detail);
    result_.step_us_mean = cycles_ > 0 ? total_us_ / static_cast<double>(cycles_) : 0.0;
    return result_;
  }

 private:
  time::Stamp now() const { return time::from_seconds(kClockAtStartS + t_); }

  void note(const std::string& text) {
    char line[400];
    std::snprintf(line, sizeof line, "%7.2f %s", t_, text.c_str());
    result_.log.emplace_back(line);
  }
  void note(const Agv& agv, const std::string& text) {
    char line[400];
    const Pose2& base = agv.body.base_in_map();
    std::snprintf(line, sizeof line, "%s (%.2f, %.2f, %.2f) %s", agv.id.c_str(), base.x, base.y, base.yaw,
                  text.c_str());
    note(line);
  }

  void add(const scenario::Vehicle& vehicle) {
    fake_vehicle::Parameters parameters = setup_.vehicle;
    parameters.radius_m = vehicle.radius_m;
    parameters.length_m = vehicle.length_m;
    parameters.width_m = vehicle.width_m;
    parameters.ahead_m = vehicle.ahead_m;
    parameters.limits.max_speed_mps = vehicle.max_speed_mps;
    parameters.limits.model = vehicle.kinematic_model();
    parameters.limits.axle = vehicle.axle;
    const local_planner::Variant& variant =
        setup_.own_variant ? *setup_.own_variant : *local_planner::find_variant(setup_.local);
    local_planner::Settings settings = setup_.settings;
    if (setup_.paper_limits) {
      const local_planner::PaperLimits& paper = variant.paper;
      parameters.limits = {paper.max_speed_mps,         0.0,
                           paper.max_turn_radps,        paper.max_acceleration_mps2,
                           paper.max_deceleration_mps2, paper.max_turn_acceleration_radps2,
                           vehicle.kinematic_model(),   vehicle.axle};
      settings.dwa.horizon_s = paper.horizon_s;
      settings.comfort_mps2 = std::min(settings.comfort_mps2, paper.max_deceleration_mps2);
    }
    const Pose2 start = scenario::varied_start(vehicle, setup_.scenario.start_jitter_m, setup_.seed);
    Agv agv{vehicle.id,
            parameters,
            fake_vehicle::SimulatedVehicle(parameters, start),
            local_planner::LocalPlanner(settings, variant),
            {},
            {},
            0,
            0,
            {},
            {},
            {}};
    for (const scenario::Mission& mission : setup_.scenario.missions)
      for (int loop = 0; mission.vehicle == vehicle.id && loop < mission.loops; ++loop)
        for (const Pose2& goal : mission.goals_in_map) {
          agv.goals_in_map.push_back(goal);
          agv.heading_matters.push_back(mission.heading_matters);
        }
    const geometry::Footprint footprint = parameters.footprint();
    const double reach_m = geometry::reach_m(footprint);
    const auto rectangle = footprint.is_disc() ? std::nullopt : std::optional(footprint);
    agv.inputs.vehicle = fleet::Vehicle{vehicle.id, footprint, parameters.limits, parameters.lidar.range_max_m,
                                        parameters.command_timeout_s};
    agv.announced.id = vehicle.id;
    agv.announced.radius_m = reach_m;
    agv.announced.rectangle = rectangle;
    agv.announced.limits = parameters.limits;
    result_.goals_assigned += static_cast<int>(agv.goals_in_map.size());
    fleet_.set_vehicle(vehicle.id, global_planner::shape_of(footprint, parameters.limits));
    agvs_.push_back(std::move(agv));
    if (!agvs_.back().is_done()) give_goal(agvs_.back());
  }

  /// The goal that the dispatcher would give now.
  void give_goal(const Agv& agv) {
    fleet::Goal goal;
    goal.agv_id = agv.id;
    goal.id = agv.id + "-" + std::to_string(agv.goal + 1);
    goal.pose_in_map = agv.goals_in_map[agv.goal];
    goal.position_tolerance_m = 0.15;
    goal.yaw_tolerance_rad = agv.heading_matters[agv.goal] ? 0.1 : 0.0;
    fleet_.set_goal(goal);
  }

  void step() {
    std::vector<Body> vehicles;
    for (const Agv& a : agvs_) vehicles.push_back(body_of(a));
    world_.advance_to(t_, vehicles);
    edit_map();
    sense(vehicles);
    if (tick_ % kSlowEvery == 0) look();
    if (tick_ % kSlowEvery == kTracksAfter) hand_out_tracks();
    if (tick_ % kSlowEvery == 0) plan();
    for (Agv& agv : agvs_) control(agv);
    judge();
    if (watch_ && tick_ % kSlowEvery == 0) show();
  }

  static Body body_of(const Agv& agv) { return geometry::body_of(agv.parameters.footprint(), agv.body.base_in_map()); }

  /// Vehicles move on and say where they are.
  void sense(const std::vector<Body>& vehicles) {
    for (std::size_t i = 0; i < agvs_.size(); ++i) {
      Agv& agv = agvs_[i];
      std::vector<Body> others;
      for (std::size_t k = 0; k < vehicles.size(); ++k)
        if (k != i) others.push_back(vehicles[k]);
      for (const fake_world::Thing& thing : world_.things()) others.push_back(thing.body);
      const Pose2 before = agv.body.base_in_map();
      agv.moved = is_moving(agv);
      agv.body.advance_to(now(), {grid_, others});
      result_.distance_m += geometry::distance(before.position(), agv.body.base_in_map().position());
      hash(agv.body.base_in_map());
      const double mps2 = (agv.body.twist().linear_mps - agv.last_mps) / kDt;
      const double jerk = (mps2 - agv.last_mps2) / kDt;
      result_.jerk_squared_sum += jerk * jerk;
      ++result_.jerk_samples;
      agv.last_mps = agv.body.twist().linear_mps;
      agv.last_mps2 = mps2;
      const double w = agv.body.twist().angular_radps;
      if (std::abs(w) > 0.05) {
        if (w * agv.last_turn < 0.0) ++result_.turn_sign_changes;
        agv.last_turn = w;
      }
      agv.inputs.state.set({fake_vehicle::with_noise(agv.body.base_in_map(), agv.parameters, random_), agv.body.twist(),
                            agv.body.steering_rad()},
                           now());
      agv.announced.state = *agv.inputs.state.any();
      agv.announced.state_arrived = now();
      agv.inputs.clearance = &clearance_;
      agv.inputs.map_revision = revision_;
    }
  }

  void look() {
    std::vector<Sensor> sensors;
    for (const Agv& a : agvs_)
      sensors.push_back(
          {a.id, a.body.base_in_map(), a.inputs.state.any()->base_in_map, a.body.twist(), a.parameters.footprint()});
    perceiver_->look(sensors, {grid_, clearance_, world_.things()}, now());
  }

  void hand_out_tracks() {
    for (const std::uint64_t id : static_ids_) fleet_.drop_track(id);
    static_ids_.clear();
    for (Agv& agv : agvs_) {
      agv.inputs.tracks = perceiver_->tracks();
      for (auto& seen : agv.inputs.tracks) seen.arrived += time::from_seconds(kTracksAfter * kDt);
      agv.inputs.tracker_alive = now();
    }
    for (const auto& seen : perceiver_->tracks()) {
      if (!seen.track.is_static) continue;
      static_ids_.push_back(seen.track.id);
      fleet_.set_static_track(seen.track.id, {seen.track.position_in_map, seen.track.radius_m});
    }
  }

  void edit_map() {
    for (const scenario::MapEdit& edit : setup_.scenario.map_edits) {
      if (t_ < edit.at_s || t_ >= edit.at_s + kDt) continue;
      const grid::Geometry& g = grid_.geometry();
      const grid::Cell low = g.cell_at(edit.low_in_map);
      const grid::Cell high = g.cell_at(edit.high_in_map);
      for (int y = low.y; y <= high.y; ++y)
        for (int x = low.x; x <= high.x; ++x)
          if (g.contains({x, y})) grid_.set({x, y}, edit.block ? grid::Occupancy::kOccupied : grid::Occupancy::kFree);
      clearance_.update(grid_, low, high);
      ++revision_;
      fleet_.set_map("lockstep", revision_, grid_, low, high);
    }
  }

  /// As aisle-global-planner does: hears the vehicles, publishes what is due.
  void plan() {
    for (const Agv& agv : agvs_) fleet_.set_pose(agv.id, agv.inputs.state.any()->base_in_map, now());
    while (const auto made = fleet_.step(now(), [] { return false; })) {
      const bool is_replan = made->trigger != fleet::PlanTrigger::kNewGoal;
      if (!is_replan) result_.planned_m += length_m(made->waypoints_in_map);
      for (Agv& agv : agvs_)
        if (agv.id == made->agv_id) agv.inputs.plan = *made, agv.replans += is_replan ? 1 : 0;
    }
    for (const std::string& event : fleet_.take_events()) note("global: " + event);
  }

  void control(Agv& agv) {
    agv.inputs.peers.clear();
    for (const Agv& other : agvs_)
      if (&other != &agv) agv.inputs.peers.push_back(other.announced);
    const double begin = cpu_us();
    agv.output = agv.core.step(agv.inputs, now());
    const double us = cpu_us() - begin;
    total_us_ += us;
    ++cycles_;
    result_.step_us_max = std::max(result_.step_us_max, us);
    agv.body.command(agv.output.twist, now());
    for (const auto& event : agv.output.events) note(agv, event.text);
    const bool changed = agv.output.phase != agv.announced.phase || agv.output.reason != agv.announced.reason;
    if (changed)
      note(agv, std::string(name(agv.output.phase)) + ", " + name(agv.output.reason) + " " + agv.output.detail);
    if (changed || tick_ % kSlowEvery == 0) announce(agv);
    if (agv.output.phase == Phase::kArrived && !agv.is_done() &&
        agv.inputs.plan->goal_id == agv.id + "-" + std::to_string(agv.goal + 1)) {
      ++result_.goals_reached;
      ++agv.goal;
      agv.done_s = t_;
      if (!agv.is_done()) give_goal(agv);
    }
  }

  /// What everybody hears as `navigation_status`.
  void announce(Agv& agv) {
    agv.announced.phase = agv.output.phase;
    agv.announced.reason = agv.output.reason;
    agv.announced.intent = agv.output.intent;
    agv.announced.intent_arrived = now();
    fleet::NavigationStatus status;
    status.agv_id = agv.id;
    status.goal_id = agv.inputs.plan ? agv.inputs.plan->goal_id : "";
    status.plan_id = agv.inputs.plan ? agv.inputs.plan->id : 0;
    status.phase = agv.output.phase;
    status.reason = agv.output.reason;
    status.blocked_at_in_map = agv.output.blocked_at_in_map;
    status.blocked_radius_m = agv.output.blocked_radius_m;
    fleet_.set_navigation(status, now());
  }

  /// Any point of it: a corner swings while a rectangle turns on the spot.
  static bool is_moving(const Agv& agv) {
    const geometry::Twist2& twist = agv.body.twist();
    const double swing_m = agv.parameters.footprint().is_disc() ? 0.0 : geometry::reach_m(agv.parameters.footprint());
    return std::max(std::hypot(twist.linear_mps, twist.sideways_mps), swing_m * std::abs(twist.angular_radps)) > 0.05;
  }

  void judge() {
    std::vector<Judge::JudgedVehicle> vehicles;
    for (const Agv& a : agvs_) vehicles.push_back({a.id, body_of(a), a.moved || is_moving(a)});
    std::vector<Judge::Thing> things;
    for (const fake_world::Thing& thing : world_.things()) things.push_back({thing.id, thing.body});
    for (Touch& touch : judge_.look(vehicles, things, grid_, clearance_, result_)) {
      touch.t_s = t_;
      note(kContact + (" " + touch.vehicle + " " + touch.other + (touch.is_moving ? " moving" : " standing")));
      result_.touches.push_back(std::move(touch));
    }
  }

  void show() {
    Snapshot snapshot;
    snapshot.t_s = t_;
    for (const Agv& a : agvs_) snapshot.vehicles.push_back(a.body.base_in_map()), snapshot.outputs.push_back(a.output);
    for (const fake_world::Thing& thing : world_.things()) snapshot.things.push_back(thing.body);
    for (const Agv& a : agvs_) snapshot.plans.push_back(a.inputs.plan ? &*a.inputs.plan : nullptr);
    snapshot.tracks = perceiver_->tracks();
    watch_(snapshot);
  }

  void hash(const Pose2& pose) {
    for (const double value : {pose.x, pose.y, pose.yaw}) {
      std::uint64_t bits;
      std::memcpy(&bits, &value, sizeof bits);
      result_.trace_hash = (result_.trace_hash ^ bits) * 1099511628211ULL;
    }
  }

  const Setup& setup_;
  const Watch& watch_;
  grid::OccupancyGrid grid_;
  grid::ClearanceField clearance_;
  fake_world::World world_;
  std::mt19937_64 random_;
  global_planner::FleetPlanner fleet_;
  std::unique_ptr<Perceiver> perceiver_;
  std::vector<std::uint64_t> static_ids_;
  std::vector<Agv> agvs_;
  Judge judge_;
  std::uint64_t revision_{1};
  int tick_{0};
  double t_{0.0};
  double total_us_{0.0};
  std::uint64_t cycles_{0};
  Result result_;
};

}  // namespace

bool is_verdict(const std::string& line) {
  return line.find(kContact) != std::string::npos || line.find(kGoalMissed) != std::string::npos;
}

Result run(const Setup& setup, const Watch& watch, const std::function<bool(double t_s)>& goes_on) {
  return Run(setup, watch).all(goes_on);
}

}  // namespace aisle::lockstep
