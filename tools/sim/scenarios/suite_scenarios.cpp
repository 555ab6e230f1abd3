#include "tools/sim/scenarios/suite_scenarios.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "common/scenario/data_path.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::sim {
namespace {

using geometry::Point2;
using geometry::Pose2;

constexpr double kCellM = 0.1;
constexpr double kRadiusM = 0.35;
constexpr double kSpareM = 0.15;  // beside the vehicle, on the way that there must be
constexpr double kMostS = 1000.0;

/// Metres from each vehicle's start to its goal; infinite where there is no way.
std::vector<double> ways_m(const Setup& setup, const grid::OccupancyGrid& grid, double spare_m) {
  const grid::ClearanceField clearance(grid, 3.0);
  const auto planner = global_planner::find_variant("theta")->make();
  std::vector<double> lengths;

  for (std::size_t i = 0; i < setup.scenario.vehicles.size(); ++i) {
    const scenario::Vehicle& vehicle = setup.scenario.vehicles[i];
    global_planner::Problem problem{clearance, vehicle.start_in_map.position(),
                                    setup.scenario.missions[i].goals_in_map.front().position()};

    problem.radius_m = vehicle.radius_m + spare_m;

    const global_planner::PlannedPath plan = planner->plan(problem, [] { return false; });
    lengths.push_back(plan.outcome == global_planner::Outcome::kFound ? plan.length_m
                                                                      : std::numeric_limits<double>::infinity());
  }

  return lengths;
}

/// Is there a way for everybody, around what the map does not show as well?
bool is_passable(const Setup& setup) {
  grid::OccupancyGrid all = setup.grid;
  for (const scenario::Block& b : setup.scenario.blocks)
    block(all, b.center_in_map.x - 0.5 * b.length_m, b.center_in_map.y - 0.5 * b.width_m,
          b.center_in_map.x + 0.5 * b.length_m, b.center_in_map.y + 0.5 * b.width_m);

  const std::vector<double> lengths = ways_m(setup, all, kSpareM);
  return std::all_of(lengths.begin(), lengths.end(), [](double m) { return std::isfinite(m); });
}

/// Boxes of 0.5 to 2 m, in the map.
void throw_boxes(grid::OccupancyGrid& grid, Dice& dice, int count, double x0, double x1, double y0, double y1) {
  for (int i = 0; i < count; ++i) {
    const double x = dice.between(x0, x1);
    const double y = dice.between(y0, y1);
    block(grid, x, y, x + dice.between(0.5, 2.0), y + dice.between(0.5, 2.0));
  }
}

/// Not in the map.
void hide_box(Setup& setup, Dice& dice, Point2 center, double least_m, double most_m) {
  scenario::Block box;
  box.id = "box-" + std::to_string(setup.scenario.blocks.size() + 1);
  box.center_in_map = {center.x, center.y, 0.0};
  box.length_m = dice.between(least_m, most_m);
  box.width_m = dice.between(least_m, most_m);
  setup.scenario.blocks.push_back(box);
}

/// Repeats `make` until there is a way for everybody.
template <class Make>
Setup passable(Make make) {
  for (;;) {
    Setup setup = make();
    if (is_passable(setup)) return setup;
  }
}

/// 24 m long.
Setup aisle_of(double width_m) {
  Setup setup;
  setup.grid = hall(24.0, width_m + 2.0 * kCellM, kCellM);
  return setup;
}

/// Two and two change sides among boxes.
Setup clutter(Dice& dice, int vehicles) {
  return passable([&] {
    Setup setup;
    setup.grid = hall(20.0, 14.0, kCellM);
    throw_boxes(setup.grid, dice, 6, 4.0, 14.0, 0.5, 12.0);

    for (int i = 0; i < vehicles; ++i) {
      const bool from_left = i % 2 == 0;
      const double lane = 14.0 / (0.5 * vehicles + 1.0) * (1 + i / 2);
      const Pose2 left{1.5, lane + dice.between(-1.0, 1.0), dice.between(-3.1, 3.1)};
      const Pose2 right{18.5, lane + dice.between(-1.0, 1.0), dice.between(-3.1, 3.1)};

      add_vehicle(setup, i + 1, from_left ? left : right,
                  {from_left ? Pose2{18.5, 13.0 - lane + 1.5, 0.0} : Pose2{1.5, 13.0 - lane, 0.0}});
    }

    return setup;
  });
}

/// Two to four vehicles come from different sides.
Setup crossing_of(Dice& dice, int vehicles) {
  Setup setup;
  setup.grid = hall(20.0, 20.0, kCellM);

  for (const double x : {0.0, 11.5})
    for (const double y : {0.0, 11.5}) block(setup.grid, x, y, x + 8.5, y + 8.5);

  const auto near = [&] { return 10.0 + dice.between(-0.7, 0.7); };
  const auto away = [&] { return dice.between(1.5, 4.0); };

  add_vehicle(setup, 1, {away(), near(), 0.0}, {{18.0, near(), 0.0}});
  add_vehicle(setup, 2, {near(), away(), 1.57}, {{near(), 18.0, 0.0}});
  if (vehicles > 2) add_vehicle(setup, 3, {20.0 - away(), near(), 3.14}, {{2.0, near(), 0.0}});
  if (vehicles > 3) add_vehicle(setup, 4, {near(), 20.0 - away(), -1.57}, {{near(), 2.0, 0.0}});

  return setup;
}

/// Two vehicles head-on in an aisle.
Setup meeting(Dice& dice) {
  Setup setup = aisle_of(dice.between(1.9, 2.6));
  const double middle = 0.5 * setup.grid.geometry().height * kCellM;
  const auto beside = [&] { return middle + dice.between(-0.3, 0.3); };

  add_vehicle(setup, 1, {dice.between(1.5, 4.0), beside(), 0.0}, {{22.0, middle, 0.0}});
  add_vehicle(setup, 2, {dice.between(18.0, 21.0), beside(), 3.14}, {{2.0, middle, 0.0}});

  return setup;
}

/// One vehicle turns into the side aisle, one comes out of it.
Setup junction(Dice& dice) {
  Setup setup;
  setup.grid = hall(20.0, 12.0, kCellM);

  const double half = dice.between(1.0, 1.5);
  block(setup.grid, 0.0, 0.0, 10.0 - half, 9.0 - half);
  block(setup.grid, 10.0 + half, 0.0, 20.0, 9.0 - half);
  block(setup.grid, 0.0, 9.0 + half, 20.0, 12.0);
  add_vehicle(setup, 1, {dice.between(1.5, 5.0), 9.0, 0.0}, {{10.0, 1.5, 0.0}});
  add_vehicle(setup, 2, {10.0, dice.between(3.0, 5.0), 1.57}, {{dice.below(2) == 0 ? 18.0 : 2.0, 9.0, 0.0}});

  return setup;
}

/// A person that is first seen in the middle of the hall has come from its edge, at the speed of its
/// first rows: people do not appear from nothing.
fake_world::RecordedPerson walking_in(const fake_world::RecordedPerson& person, const grid::Geometry& hall) {
  constexpr double kFromWallM = 0.3;
  std::vector<fake_world::RecordedPerson::Row> rows = person.rows();
  const auto& first = rows.front();
  const auto& later = rows[std::min<std::size_t>(2, rows.size() - 1)];
  if (later.t_s - first.t_s < 0.1) return person;

  const Point2 velocity = (1.0 / (later.t_s - first.t_s)) * (later.in_map - first.in_map);
  if (geometry::norm(velocity) < 0.3) return person;
  const auto since = [](double at_m, double mps, double length_m) {
    return mps > 0.0 ? (at_m - kFromWallM) / mps : mps < 0.0 ? (at_m - length_m + kFromWallM) / mps : 1e9;
  };

  const double walked_s = std::min(since(first.in_map.x, velocity.x, hall.width * hall.resolution_m),
                                   since(first.in_map.y, velocity.y, hall.height * hall.resolution_m));
  if (walked_s <= 0.0) return person;

  rows.insert(rows.begin(), {first.t_s - walked_s, first.in_map - walked_s * velocity});
  return {person.id(), std::move(rows)};
}

/// Four vehicles anywhere among racks.
Setup racks(Dice& dice) {
  Setup setup;
  setup.grid = hall(26.0, 14.0, kCellM);

  for (double y = 3.0; y < 11.0; y += 3.9)
    for (double x = 3.5; x < 20.0; x += 10.0) block(setup.grid, x, y, x + 7.5, y + 1.5);

  add_fleet(setup, dice, 4, 1, kRadiusM, 0.6, 2.0);
  return setup;
}

}  // namespace

/// 18 boxes between start and goal.
Setup static_clutter(Dice& dice) {
  return passable([&] {
    Setup setup;
    setup.grid = hall(20.0, 14.0, kCellM);
    throw_boxes(setup.grid, dice, 18, 3.0, 15.5, 0.2, 12.5);
    add_vehicle(setup, 1, {1.5, dice.between(1.5, 12.5), dice.between(-3.1, 3.1)},
                {{18.5, dice.between(1.5, 12.5), 0.0}});

    return setup;
  });
}

/// Five boxes in the map and five that are not.
Setup hidden_blocks(Dice& dice) {
  return passable([&] {
    Setup setup;
    setup.grid = hall(20.0, 10.0, kCellM);
    throw_boxes(setup.grid, dice, 5, 3.0, 15.0, 0.2, 8.5);
    for (int i = 0; i < 5; ++i) hide_box(setup, dice, {dice.between(4.0, 16.0), dice.between(1.0, 9.0)}, 0.4, 0.9);
    add_vehicle(setup, 1, {1.5, dice.between(1.5, 8.5), dice.between(-3.1, 3.1)},
                {{18.5, dice.between(1.5, 8.5), 0.0}});

    return setup;
  });
}

/// Five people, half of them courteous.
Setup person_crossing(Dice& dice) {
  Setup setup;
  setup.grid = hall(20.0, 10.0, kCellM);

  for (int i = 0; i < 5; ++i) {
    const bool courteous = dice.below(2) == 0;
    const bool up = dice.below(2) == 0;
    const double x = dice.between(4.0, 16.0);
    const double y0 = up ? 0.6 : 9.4;

    add_mover(setup, dice.between(0.7, 1.5), courteous ? 0.0 : dice.between(0.0, 14.0), courteous,
              {{x, y0}, {x + dice.between(-1.0, 1.0), 10.0 - y0}});
  }

  add_vehicle(setup, 1, {1.5, dice.between(3.0, 7.0), dice.between(-3.1, 3.1)}, {{18.5, dice.between(3.0, 7.0), 0.0}});
  return setup;
}

/// One or two people in an aisle of 2.6 to 3.6 m.
Setup person_oncoming(Dice& dice) {
  const double width = dice.between(2.6, 3.6);
  Setup setup = aisle_of(width);
  const int people = 1 + dice.below(2);

  for (int i = 0; i < people; ++i) {
    const auto side = [&] { return kCellM + dice.between(0.4, width - 0.4); };
    add_mover(setup, dice.between(0.7, 1.4), 6.0 * i + dice.between(0.0, 5.0), dice.below(2) == 0,
              {{23.2, side()}, {0.8, side()}});
  }

  const double middle = kCellM + 0.5 * width;
  add_vehicle(setup, 1, {1.6, middle + dice.between(-0.4, 0.4), dice.between(-0.5, 0.5)}, {{21.5, middle, 0.0}});

  return setup;
}

/// A slow person ahead in an aisle of 2.8 to 4 m.
Setup overtaking(Dice& dice) {
  const double width = dice.between(2.8, 4.0);
  Setup setup = aisle_of(width);
  const double middle = kCellM + 0.5 * width;
  const auto side = [&] { return middle + dice.between(-0.5, 0.5); };

  add_mover(setup, dice.between(0.3, 0.5), 0.0, false, {{dice.between(3.5, 6.0), side()}, {23.2, side()}});
  add_vehicle(setup, 1, {1.5, side(), dice.between(-0.5, 0.5)}, {{dice.between(17.0, 19.0), middle, 0.0}});

  return setup;
}

/// A door of 1.05 to 1.4 m, through which a courteous person walks.
Setup door(Dice& dice) {
  Setup setup;
  setup.grid = hall(16.0, 10.0, kCellM);

  const double y = dice.between(1.5, 7.5);
  const double wide = dice.between(1.05, 1.4);

  block(setup.grid, 8.0, 0.0, 8.3, 10.0);
  carve(setup.grid, 7.9, y, 8.4, y + wide);

  const double middle = y + 0.5 * wide;
  add_mover(setup, dice.between(0.7, 1.3), 0.0, true,
            {{dice.between(12.0, 15.0), dice.between(1.0, 9.0)},
             {9.3, middle},
             {7.0, middle},
             {dice.between(2.0, 5.0), dice.between(1.0, 9.0)}});

  add_vehicle(setup, 1, {1.5, dice.between(1.5, 8.5), dice.between(-3.1, 3.1)}, {{14.5, dice.between(1.5, 8.5), 0.0}});
  return setup;
}

/// 1.2 to 2.2 m wide; where it is wide enough, with a hidden box at its side.
Setup corridor(Dice& dice) {
  return passable([&] {
    Setup setup;
    setup.grid = hall(18.0, 10.0, kCellM);
    block(setup.grid, 0.0, 0.0, 18.0, 10.0);

    const double half = 0.5 * dice.between(1.2, 2.2);
    const double bend = dice.between(6.0, 12.0);
    const bool rises = dice.below(2) == 0;
    const double y0 = rises ? 2.0 : 8.0;
    const double y1 = 10.0 - y0;

    carve(setup.grid, 0.5, y0 - half, bend + half, y0 + half);
    carve(setup.grid, bend - half, 2.0 - half, bend + half, 8.0 + half);
    carve(setup.grid, bend - half, y1 - half, 17.5, y1 + half);

    if (half > 0.9)
      hide_box(setup, dice, {dice.between(4.0, bend - 2.0), y0 + (dice.below(2) == 0 ? half - 0.2 : 0.2 - half)}, 0.3,
               0.4);

    add_vehicle(setup, 1, {1.5, y0, dice.between(-3.1, 3.1)}, {{16.5, y1, 0.0}});
    return setup;
  });
}

/// 100 s of one of three recordings, beginning anywhere.
Setup crowd(Dice& dice) {
  struct Place {
    const char* file;
    Pose2
        frame_in_map;  // so that its people walk in the middle of the hall, and all of their ways are within its walls
    double frames_per_s;  // at which its people walk at their own pace
    double last_begin_s;
  };

  static const Place kPlaces[]{{"data:pedestrians/biwi_eth.txt", {8.6, 4.0, 0.0}, 15.0, 660.0},
                               {"data:pedestrians/biwi_hotel.txt", {9.0, 8.4, 0.5 * geometry::kPi}, 25.0, 650.0},
                               {"data:pedestrians/crowds_zara01.txt", {4.3, 3.0, 0.0}, 25.0, 290.0}};

  const Place& place = kPlaces[dice.below(3)];
  Setup setup;

  setup.grid = hall(24.0, 18.0, kCellM);

  scenario::Recording recording;
  recording.file = scenario::find_named_file(place.file, std::filesystem::current_path() / "any.yaml");
  recording.frame_in_map = place.frame_in_map;
  recording.frames_per_s = place.frames_per_s;
  recording.begin_s = dice.between(0.0, place.last_begin_s);
  recording.end_s = recording.begin_s + 100.0;
  setup.people.emplace_back();

  for (const fake_world::RecordedPerson& person : fake_world::read_recording(recording))
    setup.people.back().push_back(walking_in(person, setup.grid.geometry()));

  setup.scenario.recordings.push_back(recording);

  const bool upwards = dice.below(2) == 0;
  if (upwards)
    add_vehicle(setup, 1, {dice.between(7.0, 17.0), 3.2, 1.57}, {{dice.between(7.0, 17.0), 14.8, 0.0}});
  else
    add_vehicle(setup, 1, {4.2, dice.between(5.0, 13.0), 0.0}, {{19.8, dice.between(5.0, 13.0), 0.0}});

  return setup;
}

Setup two_vehicles(Dice& dice) {
  switch (dice.below(4)) {
    case 0:
      return meeting(dice);
    case 1:
      return crossing_of(dice, 2);
    case 2:
      return junction(dice);
    default:
      return clutter(dice, 2);
  }
}

Setup four_vehicles(Dice& dice) {
  switch (dice.below(3)) {
    case 0:
      return crossing_of(dice, 4);
    case 1:
      return racks(dice);
    default:
      return clutter(dice, 4);
  }
}

/// t = length / v + v / 2a + v / 2b + turn / w: the way at full speed, what speeding up and braking
/// add, and the first turn.
std::vector<double> free_run_s(const Setup& setup) {
  const kinematics::Limits& limits = setup.vehicle.limits;
  std::vector<double> seconds;
  const std::vector<double> lengths = ways_m(setup, setup.grid, 0.0);

  for (std::size_t i = 0; i < lengths.size(); ++i) {
    const double mps = setup.scenario.vehicles[i].max_speed_mps;
    const double speeding_s = 0.5 * mps / limits.max_acceleration_mps2 + 0.5 * mps / limits.max_deceleration_mps2;
    const Pose2 start = setup.scenario.vehicles[i].start_in_map;
    const double turn_rad = std::abs(geometry::wrap(
        geometry::bearing(start.position(), setup.scenario.missions[i].goals_in_map.front().position()) - start.yaw));

    seconds.push_back(lengths[i] / mps + speeding_s + turn_rad / limits.max_turn_radps);
  }

  return seconds;
}

}  // namespace aisle::sim
