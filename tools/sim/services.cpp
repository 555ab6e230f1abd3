// What each service's main() does, with a scenario that was read already instead of flags and files.

#include "tools/sim/services.hpp"

#include <time.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "common/scenario/variation.hpp"
#include "services/dispatcher/dispatcher_service.hpp"
#include "services/fake-vehicle/fake_vehicle_service.hpp"
#include "services/fake-world/fake_world_service.hpp"
#include "services/global-planner/global_planner_service.hpp"
#include "services/local-planner/local_planner_service.hpp"
#include "services/map/map_service.hpp"
#include "services/obstacle-tracker/obstacle_tracker_service.hpp"
#include "tools/sim/truth_tracker.hpp"

namespace aisle::sim {
namespace {

constexpr const char* kStateFile = "state";
constexpr const char* kJournalFile = "map.sqlite";
constexpr const char* kMapId = "site";
constexpr double kPrintedArrivalM = 0.5;  // the papers say not when a goal is reached; half of their cell
constexpr int kFewestRays = 8;            // where nobody looks at scans

/// CPU time of this thread: what else the machine does is no matter.
double thread_cpu_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

/// Each function builds one service as its main() does, with the files on the process's simulated disk.
std::shared_ptr<void> make_map(const Setup& setup, service::Shell& shell) {
  map::SiteMap base(kMapId, setup.grid);
  auto journal = std::make_unique<map::Journal>(
      kJournalFile, kMapId, base.summary().hash,
      map::Journal::Options{map::Journal::Options{}.max_bytes, map::hash_of(setup.scenario.zones)});
  return std::make_shared<map::MapService>(
      shell, map::MapStore(std::move(base), std::move(journal), {}, setup.scenario.zones));
}

std::shared_ptr<void> make_global_planner(const Setup& setup, bool is_standby, service::Shell& shell) {
  global_planner::ServiceConfig config;
  config.standby = is_standby;
  config.planner = setup.planner;
  config.parameters = setup.planner_parameters;
  config.fleet = setup.fleet;
  if (setup.as_printed) {
    config.fleet.as_printed = true;
    config.fleet.margin_m = 0.0;
  }
  return std::make_shared<global_planner::GlobalPlannerService>(shell, config);
}

std::shared_ptr<void> make_tracker(const Setup& setup, service::Shell& shell) {
  if (setup.perception == Perception::kTruth)
    return std::make_shared<TruthTracker>(shell, setup.vehicle.lidar.range_max_m, setup.seed);

  obstacle_tracker::ServiceParams params;
  params.only_scans_of = setup.only_scans_of;

  auto tracker = std::make_shared<obstacle_tracker::ObstacleTrackerService>(shell, params);
  if (setup.perception == Perception::kScansHeldStill)
    tracker->tell_through([](fleet::Track& track) { track.velocity_in_map = {}; });

  return tracker;
}

std::shared_ptr<void> make_world(const Setup& setup, service::Shell& shell) {
  fake_world::ServiceConfig config;
  config.scenario = setup.scenario;
  config.people = setup.people;
  config.seed = setup.seed;
  config.state_file = kStateFile;

  return std::make_shared<fake_world::FakeWorldService>(shell, config);
}

/// The setup's own variant, else the one with its name.
const local_planner::Variant& variant_of(const Setup& setup) {
  return setup.own_variant ? *setup.own_variant : *local_planner::find_variant(setup.local);
}

/// The scenario's outline, speed and model; with the limits of the local planner's paper where the
/// setup asks for them.
fake_vehicle::Parameters parameters_of(const Setup& setup, const scenario::Vehicle& vehicle) {
  fake_vehicle::Parameters parameters = setup.vehicle;
  parameters.radius_m = vehicle.radius_m;
  parameters.length_m = vehicle.length_m;
  parameters.width_m = vehicle.width_m;
  parameters.ahead_m = vehicle.ahead_m;
  parameters.limits.max_speed_mps = vehicle.max_speed_mps;
  parameters.limits.model = vehicle.kinematic_model();
  parameters.limits.axle = vehicle.axle;
  if (setup.perception == Perception::kTruth) parameters.lidar.rays = kFewestRays;

  if (!setup.paper_limits) return parameters;

  const local_planner::PaperLimits& paper = variant_of(setup).paper;
  parameters.limits = {paper.max_speed_mps,         0.0,
                       paper.max_turn_radps,        paper.max_acceleration_mps2,
                       paper.max_deceleration_mps2, paper.max_turn_acceleration_radps2,
                       vehicle.kinematic_model(),   vehicle.axle};

  return parameters;
}

std::shared_ptr<void> make_vehicle(const Setup& setup, const scenario::Vehicle& vehicle,
                                   const fake_vehicle::Hindrance& hindrance, service::Shell& shell) {
  fake_vehicle::ServiceConfig config;
  config.vehicle = parameters_of(setup, vehicle);
  config.seed = setup.seed;
  config.run = setup.scenario.name + "/" + vehicle.id;
  config.start_in_map = scenario::varied_start(vehicle, setup.scenario.start_jitter_m, setup.seed);
  config.state_file = kStateFile;
  config.hindrance = &hindrance;

  return std::make_shared<fake_vehicle::FakeVehicleService>(shell, config);
}

std::shared_ptr<void> make_local_planner(const Setup& setup, const HearsCycle& hears_cycle, service::Shell& shell) {
  local_planner::ServiceConfig config;
  config.variant = variant_of(setup);
  config.settings = setup.settings;
  config.settings.as_printed = setup.as_printed;

  if (setup.paper_limits) {
    const local_planner::PaperLimits& paper = variant_of(setup).paper;
    config.settings.dwa.horizon_s = paper.horizon_s;
    config.settings.comfort_mps2 = std::min(config.settings.comfort_mps2, paper.max_deceleration_mps2);
  }

  auto planner = std::make_shared<local_planner::LocalPlannerService>(shell, config);
  if (hears_cycle) {
    const auto begun_us = std::make_shared<double>(0.0);
    planner->before_cycle([begun_us] { *begun_us = thread_cpu_us(); });
    planner->on_cycle([hears_cycle, begun_us, agv_id = shell.agv_id()](const local_planner::Output& output) {
      hears_cycle(agv_id, output, thread_cpu_us() - *begun_us);
    });
  }

  return planner;
}

std::shared_ptr<void> make_dispatcher(const Setup& setup, service::Shell& shell) {
  dispatcher::ServiceConfig config;
  config.scenario = setup.scenario;
  config.state_file = kStateFile;
  if (setup.as_printed) config.settings.position_tolerance_m = kPrintedArrivalM;
  return std::make_shared<dispatcher::DispatcherService>(shell, config);
}

}  // namespace

/// World and product are told apart: see Blueprint::is_world.
std::vector<Blueprint> blueprints_of(const Setup& setup, Hindrances& hindrances, const HearsCycle& hears_cycle) {
  constexpr bool kIsWorld = true;
  const auto with = [&setup](auto make) {
    return [&setup, make](service::Shell& shell) { return make(setup, shell); };
  };

  std::vector<Blueprint> all;
  all.push_back({"map", "", !kIsWorld, with(make_map)});
  all.push_back({"global-planner", "", !kIsWorld,
                 [&setup](service::Shell& shell) { return make_global_planner(setup, false, shell); }});
  all.push_back({"obstacle-tracker", "", !kIsWorld, with(make_tracker)});
  all.push_back({"fake-world", "", kIsWorld, with(make_world)});

  for (const scenario::Vehicle& vehicle : setup.scenario.vehicles) {
    const fake_vehicle::Hindrance& hindrance = hindrances[vehicle.id];
    all.push_back({"fake-vehicle", vehicle.id, kIsWorld, [&setup, &vehicle, &hindrance](service::Shell& shell) {
                     return make_vehicle(setup, vehicle, hindrance, shell);
                   }});
    all.push_back({"local-planner", vehicle.id, !kIsWorld, [&setup, hears_cycle](service::Shell& shell) {
                     return make_local_planner(setup, hears_cycle, shell);
                   }});
  }

  all.push_back({"dispatcher", "", !kIsWorld, with(make_dispatcher)});

  if (setup.has_standby_planner) {
    const auto make = [&setup](service::Shell& shell) { return make_global_planner(setup, true, shell); };
    all.push_back({"global-planner", "", !kIsWorld, make, "standby"});
  }

  return all;
}

}  // namespace aisle::sim
