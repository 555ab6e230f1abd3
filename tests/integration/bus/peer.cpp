// bus_test_peer DOMAIN PARTITION NAME ROLE [STRENGTH]: a process on loopback that tests start, and kill.
//   plan      writes a plan for agv-1 with STRENGTH every 50 ms, source NAME
//   member    writes vehicle_state of NAME at 10 Hz, and reads everybody's
//   site      writes map_info, map_tile, vehicle_info, vehicle_state, plan and coverage at 10 Hz
#include <sys/prctl.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <string>

#include "common/bus/dds/dds_bus.hpp"

namespace {

using namespace aisle;
using namespace std::chrono_literals;

std::atomic<bool> stop{false};

Plan plan_of(const std::string& name) {
  static std::uint64_t count = 0;
  Plan plan;
  plan.agv_id("agv-1");
  plan.by().source_id(name);
  plan.plan_id(++count);
  plan.goal_id("goal-1");
  plan.map_id("site");
  plan.map_revision(7);
  plan.waypoints_in_map().resize(2);
  plan.waypoints_in_map()[1].x_m(2.5);
  return plan;
}

void write_plans(bus::Bus& bus, const std::string& name, int strength) {
  bus.every(50ms, [name, plans = bus.writer<topics::Plan>(strength)]() mutable { plans.write(plan_of(name)); });
}

void take_part(bus::Bus& bus, const std::string& name) {
  VehicleState state;
  state.agv_id(name);
  state.base_in_map().x_m(1.25);
  state.twist().sideways_mps(0.25);
  state.steering_rad(-0.5);
  bus.every(100ms, [state, states = bus.writer<topics::VehicleState>()]() mutable { states.write(state); });
  bus.on<topics::VehicleState>([](const VehicleState&, const bus::SampleInfo&) {});
}

VehicleInfo forklift(const std::string& name) {
  VehicleInfo vehicle;
  vehicle.agv_id(name);
  vehicle.model(KinematicModel::MODEL_TRICYCLE);
  vehicle.footprint(FootprintKind::FOOTPRINT_RECTANGLE);
  vehicle.length_m(2.4);
  vehicle.ahead_m(0.4);
  vehicle.steers_behind(true);
  vehicle.wheelbase_m(1.5);
  vehicle.max_steering_rate_radps(0.8);
  return vehicle;
}

Coverage coverage_of(const std::string& name) {
  Coverage coverage;
  coverage.source_id(name);
  coverage.tile_x(1);
  coverage.tile_y(2);
  coverage.cell_m(0.25);
  coverage.width_cells(4);
  coverage.height_cells(3);
  coverage.ages().resize(12, 255);
  return coverage;
}

void be_a_site(bus::Bus& bus, const std::string& name) {
  MapInfo info;
  info.map_id("site");
  info.revision(7);
  info.width_cells(64);
  info.height_cells(64);
  info.resolution_m(0.05);
  info.tile_size_cells(64);
  info.tile_hashes({42});
  MapTile tile;
  tile.map_id("site");
  tile.tile_x(0);
  tile.revision(7);
  tile.hash(42);
  tile.cells().resize(64 * 64, 1);
  bus.every(100ms,
            [=, infos = bus.writer<topics::MapInfo>(), tiles = bus.writer<topics::MapTile>(),
             vehicles = bus.writer<topics::VehicleInfo>(), coverages = bus.writer<topics::Coverage>()]() mutable {
              infos.write(info);
              tiles.write(tile);
              vehicles.write(forklift(name));
              coverages.write(coverage_of(name));
            });
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 5) return 2;
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // no orphan when the test dies first
  std::signal(SIGTERM, [](int) { stop = true; });
  const std::string name = argv[3];
  const std::string role = argv[4];
  bus::Settings settings;
  settings.domain = std::atoi(argv[1]);
  settings.partition = argv[2];
  settings.interfaces = {"127.0.0.1"};
  settings.participant_name = name;
  bus::DdsBus bus(settings);
  if (role == "plan" || role == "site") write_plans(bus, name, argc > 5 ? std::atoi(argv[5]) : 0);
  if (role == "site" || role == "member") take_part(bus, name);
  if (role == "site") be_a_site(bus, name);
  bus.run_until(stop);
}
