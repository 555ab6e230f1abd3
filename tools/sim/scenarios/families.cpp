#include "tools/sim/scenarios/families.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstddef>
#include <functional>
#include <map>

#include "common/config/nearest_name.hpp"
#include "common/config/reader.hpp"
#include "common/geometry/separation.hpp"
#include "common/grid/formats/map_file.hpp"
#include "common/scenario/variation.hpp"
#include "tools/sim/scenarios/building.hpp"
#include "tools/sim/scenarios/gap_to_walls.hpp"
#include "tools/sim/scenarios/suite_scenarios.hpp"

namespace aisle::sim {
namespace {

using geometry::Point2;
using geometry::Pose2;

/// 40 x 25 m: racks of 10 x 1.6 m, aisles of 3 m between them, cross aisles of 3 m and more.
grid::OccupancyGrid rack_hall() {
  grid::OccupancyGrid grid = hall(40.0, 25.0, 0.05);
  for (double y = 3.4; y + 1.6 < 22.0; y += 4.6)
    for (double x = 4.0; x + 10.0 < 37.0; x += 11.5 + 1.5) block(grid, x, y, x + 10.0, y + 1.6);
  return grid;
}

/// Five vehicles, people, a pallet that the map does not show, and an edit of the map.
Setup warehouse(Dice& dice) {
  Setup setup;
  setup.grid = rack_hall();
  add_fleet(setup, dice, 5, 3, 0.35, 0.6, 1.6);

  for (int i = 0; i < 4; ++i) {
    const double speed = dice.between(0.8, 1.4);
    const double x = 2.0 + 13.0 * dice.below(3) + dice.between(-0.6, 0.6);

    if (i > 0)
      add_mover(setup, speed, 0.0, true, {{x, dice.between(1.0, 4.0)}, {x, dice.between(18.0, 24.0)}});
    else
      add_mover(setup, speed, 0.0, true,
                {{dice.between(1.0, 5.0), 6.5 + dice.between(-1.0, 1.0)},
                 {dice.between(30.0, 39.0), 6.5 + dice.between(-1.0, 1.0)}});
  }

  scenario::Block pallet;
  pallet.id = "pallet";
  pallet.center_in_map = {dice.between(5.0, 13.0), 6.5 + 4.6 * dice.below(3) + dice.between(-0.6, 0.6), 0.0};
  setup.scenario.blocks.push_back(pallet);

  const double ey = 5.0 + 4.6 * dice.below(3);
  const double ex = dice.between(17.0, 26.0);

  setup.scenario.map_edits.push_back({25.0, true, {ex, ey}, {ex + 1.0, ey + 3.0}});

  // Nobody is sent to where it is blocked, nor starts on the pallet.
  const auto clear = [&](Pose2& pose) {
    const bool in_edit = pose.x > ex - 0.8 && pose.x < ex + 1.8 && pose.y > ey - 0.8 && pose.y < ey + 3.8;
    if (in_edit || geometry::distance(pose.position(), pallet.center_in_map.position()) < 1.3)
      pose = {2.0, pose.y, 0.0};
  };

  for (scenario::Mission& mission : setup.scenario.missions)
    for (Pose2& goal : mission.goals_in_map) clear(goal);

  for (scenario::Vehicle& vehicle : setup.scenario.vehicles) clear(vehicle.start_in_map);
  setup.scenario.duration_s = 400.0;

  return setup;
}

/// Racks with aisles of 2 m everywhere, at 0.25 m a cell, as Moving AI's warehouse at 2 m a cell.
Setup narrow(Dice& dice) {
  Setup setup;
  setup.grid = hall(60.0, 34.0, 0.25);

  for (double y = 4.0; y + 4.0 < 31.0; y += 6.0)
    for (double x = 8.0; x + 14.0 < 55.0; x += 16.0) block(setup.grid, x, y, x + 14.0, y + 4.0);

  add_fleet(setup, dice, 4, 3, dice.between(0.3, 0.35), 0.5, 2.5);
  setup.scenario.duration_s = 400.0;

  return setup;
}

/// Two vehicles meet in a corridor of this width.
Setup head_on(Dice& dice, double corridor_m) {
  Setup setup;
  setup.grid = hall(30.0, 10.0, 0.05);

  const double half = 0.5 * corridor_m;
  block(setup.grid, 7.0, 0.0, 23.0, 5.0 - half);
  block(setup.grid, 7.0, 5.0 + half, 23.0, 10.0);

  const double y1 = dice.between(2.0, 8.0);
  const double y2 = dice.between(2.0, 8.0);

  add_vehicle(setup, 1, {dice.between(2.0, 5.0), y1, 0.0}, {{27.0, y2, 0.0}});
  add_vehicle(setup, 2, {dice.between(25.0, 28.0), y2, 3.14}, {{3.0, y1, 0.0}});
  setup.scenario.duration_s = 150.0;

  return setup;
}

/// Four vehicles meet at the crossing of two aisles.
Setup crossing(Dice& dice) {
  Setup setup;
  setup.grid = hall(24.0, 24.0, 0.05);

  for (const double x : {0.0, 13.5})
    for (const double y : {0.0, 13.5}) block(setup.grid, x, y, x + 10.5, y + 10.5);

  const double c = 12.0;
  const auto j = [&] { return dice.between(-0.8, 0.8); };

  add_vehicle(setup, 1, {2.0 + dice.between(0, 2), c + j(), 0.0}, {{22.0, c + j(), 0.0}});
  add_vehicle(setup, 2, {c + j(), 2.0 + dice.between(0, 2), 1.57}, {{c + j(), 22.0, 0.0}});
  add_vehicle(setup, 3, {22.0 - dice.between(0, 2), c + j(), 3.14}, {{2.0, c + j(), 0.0}});
  add_vehicle(setup, 4, {c + j(), 22.0 - dice.between(0, 2), -1.57}, {{c + j(), 2.0, 0.0}});
  setup.scenario.duration_s = 120.0;

  return setup;
}

/// Three vehicles, of which one comes out of the side aisle.
Setup t_junction(Dice& dice) {
  Setup setup;
  setup.grid = hall(24.0, 14.0, 0.05);

  const double half = dice.between(1.0, 1.5);
  block(setup.grid, 0.0, 0.0, 12.0 - half, 10.0 - half);
  block(setup.grid, 12.0 + half, 0.0, 24.0, 10.0 - half);
  block(setup.grid, 0.0, 10.0 + half, 24.0, 14.0);
  add_vehicle(setup, 1, {2.0, 10.0, 0.0}, {{12.0, 2.0, 0.0}});
  add_vehicle(setup, 2, {12.0, 3.5, 1.57}, {{dice.below(2) == 0 ? 22.0 : 2.0, 10.0, 0.0}});
  add_vehicle(setup, 3, {22.0, 10.0, 3.14}, {{3.8, 10.0, 0.0}});
  setup.scenario.duration_s = 150.0;

  return setup;
}

/// Two walls with a door of 1.1 m in each.
Setup doors(Dice& dice) {
  Setup setup;
  setup.grid = hall(24.0, 12.0, 0.05);
  block(setup.grid, 8.0, 0.0, 8.3, 12.0);
  block(setup.grid, 16.0, 0.0, 16.3, 12.0);

  for (const double x : {8.0, 16.0}) {
    const double y = dice.between(3.0, 8.0);
    auto& grid = setup.grid;
    const auto& g = grid.geometry();

    for (int cy = 0; cy < g.height; ++cy)
      for (int cx = 0; cx < g.width; ++cx) {
        const Point2 c = g.center_in_map({cx, cy});
        if (c.x > x - 0.1 && c.x < x + 0.4 && c.y > y && c.y < y + 1.1) grid.set({cx, cy}, grid::Occupancy::kFree);
      }
  }

  const auto y = [&] { return dice.between(1.5, 10.5); };
  add_vehicle(setup, 1, {3.0, y(), 0.0}, {{21.0, y(), 0.0}});
  add_vehicle(setup, 2, {21.0, 3.0, 3.14}, {{3.0, y(), 0.0}});
  add_vehicle(setup, 3, {12.0, 6.0, 0.0}, {{2.0, 2.0, 0.0}});
  add_vehicle(setup, 4, {21.0, 9.0, 3.14}, {{12.0, 3.0, 0.0}});
  setup.scenario.duration_s = 200.0;

  return setup;
}

/// A hall in which people walk straight on, whatever is before them.
Setup walkers(Dice& dice, bool courteous, int count) {
  Setup setup;
  setup.grid = hall(24.0, 16.0, 0.05);
  block(setup.grid, 9.0, 5.0, 11.0, 7.0);
  block(setup.grid, 15.0, 9.0, 17.0, 10.5);

  for (int i = 0; i < count; ++i) {
    const double speed = dice.between(0.9, 1.6);
    const double start = courteous ? dice.between(0.0, 20.0) : 4.0 * i + dice.between(0.0, 4.0);

    if (i % 2 == 0) {
      const double x = dice.between(2.0, 8.0) + 6.0 * dice.below(3);
      const bool blocked = (x > 8.5 && x < 11.5) || (x > 14.5 && x < 17.5);
      add_mover(setup, speed, start, courteous, {{blocked ? 13.0 : x, 0.5}, {blocked ? 13.0 : x, 15.5}});
    } else {
      const double y = dice.below(2) == 0 ? dice.between(1.0, 4.0) : dice.between(11.2, 15.0);
      add_mover(setup, speed, start, courteous, {{0.5, y}, {23.5, y + dice.between(-0.5, 0.5)}});
    }
  }

  add_fleet(setup, dice, 3, 2, 0.3, 0.8, 1.5);
  setup.scenario.duration_s = 240.0;

  return setup;
}

/// All families by name.
const std::map<std::string, std::function<Setup(Dice&)>>& makers() {
  static const std::map<std::string, std::function<Setup(Dice&)>> all{
      {"warehouse", warehouse},
      {"narrow", narrow},
      {"head-on-wide", [](Dice& d) { return head_on(d, 2.0); }},
      {"head-on-tight", [](Dice& d) { return head_on(d, 1.2); }},
      {"crossing", crossing},
      {"t-junction", t_junction},
      {"doors", doors},
      {"walkers", [](Dice& d) { return walkers(d, true, 6); }},
      {"oblivious", [](Dice& d) { return walkers(d, false, 16); }},
      {"static-clutter", static_clutter},
      {"hidden-blocks", hidden_blocks},
      {"person-crossing", person_crossing},
      {"person-oncoming", person_oncoming},
      {"overtaking", overtaking},
      {"door", door},
      {"corridor", corridor},
      {"crowd", crowd},
      {"two-vehicles", two_vehicles},
      {"four-vehicles", four_vehicles},
  };

  return all;
}

/// A vehicle that starts in a wall or in another vehicle cannot be got out by any planner. @throws
/// config::BadInput
void refuse_starts_that_touch(const Setup& setup, const std::filesystem::path& file) {
  const std::vector<scenario::Vehicle>& vehicles = setup.scenario.vehicles;
  std::vector<geometry::Body> bodies;

  for (const scenario::Vehicle& vehicle : vehicles) {
    const Pose2 start = scenario::varied_start(vehicle, setup.scenario.start_jitter_m, setup.seed);
    bodies.push_back(geometry::body_of(vehicle.footprint(), start));

    const std::string where =
        fmt::format("{}: {} starts at ({:.2f}, {:.2f})", file.string(), vehicle.id, start.x, start.y);
    if (!setup.grid.geometry().contains(setup.grid.geometry().cell_at(start.position())))
      throw config::BadInput(where + ", outside the map");
    if (gap_to_walls_m(setup.grid, bodies.back(), 0.1) <= 0.0)
      throw config::BadInput(where + ", where its outline is in a wall or leaves the map");

    for (std::size_t i = 0; i + 1 < bodies.size(); ++i)
      if (geometry::separation_m(bodies[i], bodies.back()) <= 0.0)
        throw config::BadInput(where + ", where its outline touches that of " + vehicles[i].id);
  }
}

}  // namespace

/// The map and the recordings are read here, so that a run reads no file.
Setup read_setup(const std::filesystem::path& scenario_file, std::uint64_t seed) {
  Setup setup;
  setup.scenario = scenario::read_scenario(scenario_file);
  setup.seed = seed;
  setup.grid = grid::read_map_file(setup.scenario.map_file, setup.scenario.map_options);

  for (const scenario::Recording& recording : setup.scenario.recordings)
    setup.people.push_back(fake_world::read_recording(recording));

  refuse_starts_that_touch(setup, scenario_file);
  return setup;
}

std::vector<std::string> families() {
  std::vector<std::string> names;
  for (const auto& [name, maker] : makers()) names.push_back(name);
  return names;
}

namespace {

/// For errors: the nearest name, and all of them.
std::string names_like(const std::string& family) {
  const std::string nearest = config::nearest_name(family, families());
  return fmt::format("{}there are {}", nearest.empty() ? "" : "did you mean '" + nearest + "'? ",
                     fmt::join(families(), ", "));
}

}  // namespace

Setup make_setup(const std::string& family, std::uint64_t seed) {
  const auto maker = makers().find(family);
  if (maker == makers().end())
    throw config::BadInput(fmt::format("no scenario family '{}'; {}", family, names_like(family)));

  Dice dice(seed);
  Setup setup = maker->second(dice);

  setup.scenario.name = family;
  setup.seed = seed;

  return setup;
}

/// A name with an ending or a folder is a file.
Setup named_setup(const std::string& name_or_file, std::uint64_t seed) {
  if (makers().count(name_or_file) > 0) return make_setup(name_or_file, seed);

  const std::filesystem::path file(name_or_file);
  if (file.has_extension() || file.has_parent_path() || std::filesystem::exists(file)) return read_setup(file, seed);

  throw config::BadInput(
      fmt::format("'{}' is neither a scenario file nor a family; {}", name_or_file, names_like(name_or_file)));
}

}  // namespace aisle::sim
