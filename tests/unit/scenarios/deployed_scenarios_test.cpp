// What deploy/scenarios promises of its maps: whoever edits a scenario or a map finds here what does not fit.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <queue>
#include <string>
#include <vector>

#include "common/config/reader.hpp"
#include "common/geometry/body.hpp"
#include "common/grid/clearance.hpp"
#include "common/grid/formats/map_file.hpp"
#include "common/scenario/scenario.hpp"
#include "services/fake-world/core/recording.hpp"
#include "tests/support/places.hpp"

namespace aisle::scenario {
namespace {

namespace fs = std::filesystem;

constexpr double kMarginM = 0.1;   // beside the vehicle's radius, as the planner keeps
constexpr double kPassingM = 0.6;  // between two bodies that stand

std::vector<std::string> names() {
  std::vector<std::string> found;
  for (const auto& entry : fs::directory_iterator(test_support::source_folder() / "deploy/scenarios")) {
    if (entry.path().extension() == ".yaml") found.push_back(entry.path().stem().string());
  }
  std::sort(found.begin(), found.end());
  return found;
}

class Deployed : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const fs::path file = test_support::source_folder() / "deploy/scenarios" / (GetParam() + ".yaml");
    try {
      scenario_ = read_scenario(file);
    } catch (const config::BadInput& error) {
      const bool needs_data = std::string(error.what()).find("AISLE_DATA") != std::string::npos;
      if (!needs_data) throw;
      GTEST_SKIP() << error.what();
    }
    grid_ = grid::read_map_file(scenario_.map_file, scenario_.map_options);
    clearance_ = grid::ClearanceField(grid_, 3.0);
  }

  double room_m(geometry::Point2 in_map) const { return clearance_.clearance_m(in_map); }
  const Vehicle& vehicle(const std::string& id) const {
    return *std::find_if(scenario_.vehicles.begin(), scenario_.vehicles.end(),
                         [&](const Vehicle& v) { return v.id == id; });
  }

  /// May a vehicle of this radius drive from `from` to `to`, over free cells of the map that `blocked` does not hold?
  bool connected(geometry::Point2 from, geometry::Point2 to, double radius_m,
                 const std::vector<geometry::Body>& blocked) const {
    const grid::Geometry& g = grid_.geometry();
    const auto is_open = [&](grid::Cell c) {
      if (!g.contains(c) || !clearance_.is_traversable(c, radius_m)) return false;
      return std::all_of(blocked.begin(), blocked.end(), [&](const geometry::Body& body) {
        return geometry::distance_m(body, g.center_in_map(c)) >= radius_m;
      });
    };
    std::vector<char> seen(g.cells(), 0);
    std::queue<grid::Cell> open;
    open.push(g.cell_at(from));
    seen[g.index(g.cell_at(from))] = 1;
    const grid::Cell goal = g.cell_at(to);
    while (!open.empty()) {
      const grid::Cell c = open.front();
      open.pop();
      if (c == goal) return true;
      for (const grid::Cell next :
           {grid::Cell{c.x + 1, c.y}, grid::Cell{c.x - 1, c.y}, grid::Cell{c.x, c.y + 1}, grid::Cell{c.x, c.y - 1}}) {
        if (!is_open(next) || seen[g.index(next)] != 0) continue;
        seen[g.index(next)] = 1;
        open.push(next);
      }
    }
    return false;
  }

  static geometry::Body body_of(const Block& block) {
    return {geometry::Body::Shape::kRectangle, block.center_in_map, 0.0, block.length_m, block.width_m};
  }
  static geometry::Body body_of(const MapEdit& edit) {
    const geometry::Point2 middle = 0.5 * (edit.low_in_map + edit.high_in_map);
    return {geometry::Body::Shape::kRectangle,
            {middle.x, middle.y, 0.0},
            0.0,
            edit.high_in_map.x - edit.low_in_map.x,
            edit.high_in_map.y - edit.low_in_map.y};
  }

  Scenario scenario_;
  grid::OccupancyGrid grid_;
  grid::ClearanceField clearance_;
};

TEST_P(Deployed, VehiclesStartInTheFree) {
  for (const Vehicle& v : scenario_.vehicles) {
    EXPECT_GE(room_m(v.start_in_map.position()), v.radius_m + kMarginM + 1.5 * scenario_.start_jitter_m) << v.id;
    for (const Vehicle& other : scenario_.vehicles) {
      if (other.id <= v.id) continue;
      const double gap_m =
          geometry::distance(v.start_in_map.position(), other.start_in_map.position()) - v.radius_m - other.radius_m;
      EXPECT_GE(gap_m, kPassingM) << v.id << " and " << other.id;
    }
  }
}

TEST_P(Deployed, GoalsLieInTheFree) {
  for (const Mission& mission : scenario_.missions) {
    for (const geometry::Pose2& goal : mission.goals_in_map) {
      EXPECT_GE(room_m(goal.position()), vehicle(mission.vehicle).radius_m + kMarginM + 0.1)
          << mission.vehicle << " to " << goal.x << ", " << goal.y;
    }
  }
}

/// Any vehicle may be given a task.
TEST_P(Deployed, StopsOfTasksLieInTheFree) {
  for (const Task& task : scenario_.tasks) {
    for (const geometry::Pose2& stop : task.stops_in_map) {
      for (const Vehicle& v : scenario_.vehicles) {
        EXPECT_GE(room_m(stop.position()), v.radius_m + kMarginM + 0.1) << stop.x << ", " << stop.y;
        EXPECT_TRUE(connected(v.start_in_map.position(), stop.position(), v.radius_m + kMarginM, {}));
      }
    }
  }
}

/// A vehicle without a mission stands where it starts.
TEST_P(Deployed, VehiclesParkWhereNobodyElseGoes) {
  ASSERT_FALSE(scenario_.missions.empty() && scenario_.tasks.empty());
  std::map<std::string, geometry::Point2> parking;
  for (const Vehicle& v : scenario_.vehicles) parking[v.id] = v.start_in_map.position();
  for (const Mission& mission : scenario_.missions) parking[mission.vehicle] = mission.goals_in_map.back().position();
  for (const auto& [id, place] : parking) {
    for (const Mission& other : scenario_.missions) {
      if (other.vehicle == id) continue;
      for (const geometry::Pose2& goal : other.goals_in_map) {
        EXPECT_GE(geometry::distance(place, goal.position()),
                  vehicle(id).radius_m + vehicle(other.vehicle).radius_m + kPassingM)
            << id << " parks at a goal of " << other.vehicle;
      }
    }
  }
}

TEST_P(Deployed, EveryGoalStaysReachableWhateverIsBlocked) {
  std::vector<geometry::Body> blocked;
  for (const Block& block : scenario_.blocks) blocked.push_back(body_of(block));
  for (const MapEdit& edit : scenario_.map_edits) {
    if (edit.block) blocked.push_back(body_of(edit));
  }
  for (const Mission& mission : scenario_.missions) {
    const Vehicle& v = vehicle(mission.vehicle);
    geometry::Point2 from = v.start_in_map.position();
    for (const geometry::Pose2& goal : mission.goals_in_map) {
      EXPECT_TRUE(connected(from, goal.position(), v.radius_m + kMarginM, blocked))
          << v.id << " to " << goal.x << ", " << goal.y;
      from = goal.position();
    }
  }
}

TEST_P(Deployed, NothingBeginsOnTopOfAVehicle) {
  for (const Vehicle& v : scenario_.vehicles) {
    for (const Block& block : scenario_.blocks)
      EXPECT_GE(geometry::distance_m(body_of(block), v.start_in_map.position()), v.radius_m + 0.5) << block.id;
    for (const MapEdit& edit : scenario_.map_edits)
      EXPECT_GE(geometry::distance_m(body_of(edit), v.start_in_map.position()), v.radius_m + 0.5);
  }
}

TEST_P(Deployed, WalkersKeepClearOfWalls) {
  for (const Mover& mover : scenario_.movers) {
    for (std::size_t i = 1; i < mover.waypoints_in_map.size(); ++i) {
      const geometry::Point2 a = mover.waypoints_in_map[i - 1];
      const geometry::Point2 way = mover.waypoints_in_map[i] - a;
      for (double share = 0.0; share <= 1.0; share += 0.002)
        EXPECT_GE(room_m(a + share * way), mover.radius_m) << mover.id;
    }
  }
}

TEST_P(Deployed, RecordedPeopleHardlyEverWalkThroughWalls) {
  for (const Recording& recording : scenario_.recordings) {
    int rows = 0;
    int within = 0;
    for (const fake_world::RecordedPerson& person : fake_world::read_recording(recording)) {
      for (double t_s = recording.begin_s; t_s < std::min(recording.end_s, recording.begin_s + scenario_.duration_s);
           t_s += 0.2) {
        const auto motion = person.at(t_s);
        if (!motion) continue;
        ++rows;
        within += room_m(motion->position_in_map) <= 0.0 ? 1 : 0;
      }
    }
    EXPECT_GT(rows, 500) << "hardly anybody is there";
    EXPECT_LT(within, 0.03 * rows);
  }
}

INSTANTIATE_TEST_SUITE_P(Scenarios, Deployed, ::testing::ValuesIn(names()), [](const auto& test) {
  std::string name = test.param;
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace aisle::scenario
