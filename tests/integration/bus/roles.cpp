#include "tests/integration/bus/roles.hpp"

#include <chrono>
#include <cstdint>
#include <memory>
#include <set>
#include <string>

namespace aisle::bus_test {
namespace {

using namespace std::chrono_literals;

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

void write_a_track(bus::Bus& bus) {
  Track track;
  track.track_id(7);
  bus.every(50ms, [track, tracks = bus.writer<topics::Track>()]() mutable { tracks.write(track); });
}

/// Says how many maps were heard of: the id of its track.
void count_maps(bus::Bus& bus) {
  const auto maps = std::make_shared<std::set<std::string>>();
  bus.on<topics::MapInfo>(
      [maps](const MapInfo& info, const bus::SampleInfo&) { maps->insert(info.map_id().to_string()); });
  bus.every(50ms, [maps, tracks = bus.writer<topics::Track>()]() mutable {
    Track track;
    track.track_id(maps->size());
    tracks.write(track);
  });
}

}  // namespace

bool play_role(bus::Bus& bus, const std::string& role, const std::string& name, int strength) {
  if (role == "plan" || role == "site") write_plans(bus, name, strength);
  if (role == "site" || role == "member") take_part(bus, name);
  if (role == "site") be_a_site(bus, name);
  if (role == "track") write_a_track(bus);
  if (role == "map-counter") count_maps(bus);
  if (role == "edit-reader") bus.on<topics::MapEdit>([](const MapEdit&, const bus::SampleInfo&) {});
  return role == "plan" || role == "site" || role == "member" || role == "track" || role == "map-counter" ||
         role == "edit-reader";
}

}  // namespace aisle::bus_test
