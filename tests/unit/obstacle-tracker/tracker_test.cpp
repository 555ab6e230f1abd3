#include "services/obstacle-tracker/core/tracker.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <set>
#include <string>

#include "common/kinematics/vehicle_model.hpp"
#include "tests/unit/obstacle-tracker/stage.hpp"

namespace aisle::obstacle_tracker::test {
namespace {

const auto kNobodyMoves = [](double) {};

Vehicle vehicle_at(const char* id, double x, double y, double yaw = 0.0) {
  return {id, {x, y, yaw}, {}, 0.35, 10.0, 360};
}

grid::OccupancyGrid room_with_racks() {
  grid::OccupancyGrid grid = room(20.0, 14.0);
  for (double y = 3.0; y < 12.0; y += 3.0) fill(grid, {4.0, y}, {14.0, y + 0.8});
  return grid;
}

TEST(Tracker, FollowsAWalkerWithOneTrackAndHisVelocity) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Stage stage(room(16.0, 12.0), {vehicle_at("a", 8.0, 2.0, 0.7)}, seed);
    double squares = 0.0;
    double position_squares = 0.0;
    int judged = 0;
    stage.run(
        6.0,
        [&](double t) {
          stage.world.discs = {{{4.0 + 1.3 * t, 6.0}, 0.25}};
        },
        [&](double t) {
          if (t < 1.2) return;
          const Track* track = stage.track_at({4.0 + 1.3 * t, 6.0});
          ASSERT_NE(track, nullptr) << "seed " << seed << " at " << t;
          squares += std::pow(geometry::norm(track->velocity_in_map - Point2{1.3, 0.0}), 2);
          position_squares += std::pow(geometry::distance(track->position_in_map, {4.0 + 1.3 * t, 6.0}), 2);
          ++judged;
        });
    EXPECT_EQ(stage.ids.size(), 1U) << "seed " << seed;
    EXPECT_LT(std::sqrt(squares / judged), 0.25) << "seed " << seed;
    EXPECT_LT(std::sqrt(position_squares / judged), 0.08) << "seed " << seed;
  }
}

TEST(Tracker, PublishesAWalkerAtTheSecondScan) {
  Stage stage(room(16.0, 12.0), {vehicle_at("a", 8.0, 2.0)}, 1);
  const auto walk = [&](double t) { stage.world.discs = {{{6.0 + 1.3 * t, 6.0}, 0.25}}; };
  stage.run(0.1, walk);
  EXPECT_TRUE(stage.tracks.empty());
  stage.run(0.2, walk);
  EXPECT_EQ(stage.tracks.size(), 1U);
}

TEST(Tracker, MakesOneTrackOfWhatTwoVehiclesSee) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Stage stage(room(16.0, 12.0), {vehicle_at("a", 3.0, 2.0, 0.7), vehicle_at("b", 13.0, 9.0, -2.0)}, seed);
    stage.run(
        6.0,
        [&](double t) {
          stage.world.discs = {{{5.0 + 1.0 * t, 4.0 + 0.3 * t}, 0.25}};
        },
        [&](double t) { ASSERT_LE(stage.tracks.size(), 1U) << "seed " << seed << " at " << t; });
    EXPECT_EQ(stage.ids.size(), 1U) << "seed " << seed;
  }
}

TEST(Tracker, TakesALateScanOfAnotherVehicleForWhatItShowed) {
  World world(room(16.0, 12.0));
  const std::vector<Vehicle> fleet{vehicle_at("a", 8.0, 2.0), vehicle_at("b", 8.0, 10.0)};
  Lidar lidar(1, {0.0, 0.0, 0.0});
  Tracker tracker;
  const auto at = [](double t) { return time::Stamp{std::chrono::seconds(100)} + time::from_seconds(t); };
  for (int k = 0; k < 30; ++k) {
    const double t = 0.1 * k;
    world.discs = {{{4.0 + 1.5 * t, 6.0}, 0.25}};
    const Scan of_a = lidar.scan(world, fleet[0], fleet, at(t));
    world.discs = {{{4.0 + 1.5 * (t - 0.08), 6.0}, 0.25}};
    const Scan of_b = lidar.scan(world, fleet[1], fleet, at(t - 0.08));  // measured before, taken after
    EXPECT_FALSE(tracker.take(of_a, lidar.known(fleet, at(t)), &world.clearance, at(t)).dropped);
    EXPECT_FALSE(tracker.take(of_b, lidar.known(fleet, at(t)), &world.clearance, at(t)).dropped);
  }
  const std::vector<Track> tracks = tracker.tracks(at(2.9));
  ASSERT_EQ(tracks.size(), 1U);
  EXPECT_NEAR(tracks[0].position_in_map.x, 4.0 + 1.5 * 2.9, 0.05);
  EXPECT_NEAR(tracks[0].velocity_in_map.x, 1.5, 0.1);
}

TEST(Tracker, SeesNoGhostsStanding) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Stage stage(room_with_racks(),
                {vehicle_at("a", 2.0, 2.0, 0.3), vehicle_at("b", 16.0, 7.0, 2.0), vehicle_at("c", 9.0, 5.0)}, seed);
    stage.run(60.0, kNobodyMoves);
    EXPECT_EQ(stage.ids.size(), 0U) << "seed " << seed;
  }
}

TEST(Tracker, SeesNoGhostsOfAVehicleThatSaysItIsLessSureOfItsPose) {
  const Noise lost{0.02, 0.05, geometry::kPi / 180.0};
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Stage stage(room_with_racks(),
                {vehicle_at("a", 2.0, 2.0, 0.3), vehicle_at("b", 16.0, 7.0, 2.0), vehicle_at("c", 9.0, 5.0)}, seed,
                lost);
    stage.run(60.0, kNobodyMoves);
    EXPECT_EQ(stage.ids.size(), 0U) << "seed " << seed;
  }
}

TEST(Tracker, SeesNoGhostsDriving) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Stage stage(room_with_racks(), {vehicle_at("a", 2.0, 1.5), vehicle_at("b", 16.0, 5.0, 1.5)}, seed);
    stage.fleet[0].twist = {1.0, 0.0, 0.0};
    stage.fleet[1].twist = {0.6, 0.5, 0.0};
    const std::vector<Vehicle> start = stage.fleet;
    stage.run(60.0, [&](double t) {
      const double forth = std::abs(std::remainder(t, 30.0));  // along the wall and back
      stage.fleet[0].base_in_map = {2.0 + forth, 1.5, 0.0};
      stage.fleet[0].twist.linear_mps = std::remainder(t, 30.0) > 0.0 ? 1.0 : -1.0;
      stage.fleet[1].base_in_map = kinematics::advance(start[1].base_in_map, start[1].twist, t);
    });
    EXPECT_EQ(stage.ids.size(), 0U) << "seed " << seed;
  }
}

TEST(Tracker, SeesNoGhostsWhileItTurnsDuringTheSweep) {
  World world(room_with_racks());
  Lidar lidar(1);
  Tracker tracker;
  Vehicle vehicle = vehicle_at("a", 9.0, 5.0);
  vehicle.twist = {0.8, 1.2, 0.0};
  const Vehicle start = vehicle;
  for (int k = 0; k < 300; ++k) {
    vehicle.base_in_map = kinematics::advance(start.base_in_map, start.twist, 0.1 * k);
    const time::Stamp stamp = std::chrono::seconds(100) + k * std::chrono::milliseconds(100);
    const time::Stamp end = stamp + std::chrono::milliseconds(90);
    ASSERT_FALSE(tracker
                     .take(lidar.scan(world, vehicle, {vehicle}, stamp, 0.09), lidar.known({vehicle}, stamp),
                           &world.clearance, end)
                     .dropped);
    ASSERT_TRUE(tracker.tracks(end).empty()) << "at scan " << k;
  }
}

TEST(Tracker, KeepsTheIdBehindAPillar) {
  grid::OccupancyGrid walls = room(16.0, 12.0);
  fill(walls, {7.6, 4.0}, {8.4, 4.3});
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Stage stage(walls, {vehicle_at("a", 8.0, 1.0)}, seed);
    bool was_hidden = false;
    stage.run(
        6.0,
        [&](double t) {
          stage.world.discs = {{{4.5 + 1.3 * t, 6.5}, 0.25}};
        },
        [&](double) {
          for (const Track& track : stage.tracks) was_hidden = was_hidden || track.unseen_s > 0.4;
        });
    EXPECT_TRUE(was_hidden);
    EXPECT_EQ(stage.ids.size(), 1U) << "seed " << seed;
    EXPECT_EQ(stage.tracks.size(), 1U) << "seed " << seed;
  }
}

TEST(Tracker, KeepsTheIdOfOneWhoTurnsRound) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Stage stage(room(16.0, 12.0), {vehicle_at("a", 8.0, 2.0)}, seed);
    stage.run(8.0, [&](double t) {
      stage.world.discs = {{{6.0 + 1.2 * std::abs(std::remainder(t - 2.0, 4.0)), 6.0}, 0.25}};
    });
    EXPECT_EQ(stage.ids.size(), 1U) << "seed " << seed;
  }
}

TEST(Tracker, KeepsTwoWhoPassEachOtherApart) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Stage stage(room(16.0, 12.0), {vehicle_at("a", 8.0, 2.0)}, seed);
    std::uint64_t first = 0;
    stage.run(
        5.0,
        [&](double t) {
          stage.world.discs = {{{5.0 + 1.2 * t, 5.0}, 0.25}, {{11.0 - 1.2 * t, 5.9}, 0.25}};
        },
        [&](double t) {
          if (std::abs(t - 1.0) < 0.01 && stage.track_at({6.2, 5.0}) != nullptr) first = stage.track_at({6.2, 5.0})->id;
        });
    EXPECT_EQ(stage.ids.size(), 2U) << "seed " << seed;
    const Track* last = stage.track_at({5.0 + 1.2 * 4.9, 5.0});
    ASSERT_NE(last, nullptr) << "seed " << seed;
    EXPECT_EQ(last->id, first) << "seed " << seed;
  }
}

TEST(Tracker, CallsAThingStaticAfterThreeSeconds) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Stage stage(room(16.0, 12.0), {vehicle_at("a", 8.0, 2.0)}, seed);
    stage.world.discs = {{{9.0, 6.0}, 0.25}};
    stage.run(2.8, kNobodyMoves);
    ASSERT_EQ(stage.tracks.size(), 1U);
    EXPECT_FALSE(stage.tracks[0].is_static);
    stage.run(4.0, kNobodyMoves);
    ASSERT_EQ(stage.tracks.size(), 1U);
    EXPECT_TRUE(stage.tracks[0].is_static) << "seed " << seed;
    EXPECT_EQ(geometry::norm(stage.tracks[0].velocity_in_map), 0.0);
  }
}

TEST(Tracker, NeverCallsASlowWalkerStatic) {
  Stage stage(room(16.0, 12.0), {vehicle_at("a", 8.0, 2.0)}, 1);
  stage.run(
      15.0,
      [&](double t) {
        stage.world.discs = {{{6.0 + 0.25 * t, 6.0}, 0.25}};
      },
      [&](double) {
        for (const Track& track : stage.tracks) EXPECT_FALSE(track.is_static);
      });
}

TEST(Tracker, NoticesWhenOneWhoStoodWalksOff) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Stage stage(room(16.0, 12.0), {vehicle_at("a", 8.0, 2.0)}, seed);
    stage.run(7.0, [&](double t) { stage.world.discs = {{{6.0 + 1.3 * std::max(0.0, t - 5.0), 6.0}, 0.25}}; });
    ASSERT_EQ(stage.tracks.size(), 1U);
    EXPECT_FALSE(stage.tracks[0].is_static);
    EXPECT_NEAR(stage.tracks[0].velocity_in_map.x, 1.3, 0.4);
    EXPECT_EQ(stage.ids.size(), 1U) << "seed " << seed;
  }
}

TEST(Tracker, LosesAThingOnceItsPlaceIsSeenFree) {
  Stage stage(room(16.0, 12.0), {vehicle_at("a", 8.0, 2.0)}, 1);
  stage.world.discs = {{{9.0, 6.0}, 0.25}};
  stage.run(5.0, kNobodyMoves);
  ASSERT_EQ(stage.tracks.size(), 1U);
  EXPECT_TRUE(stage.tracks[0].is_static);
  const std::uint64_t id = stage.tracks[0].id;
  stage.world.discs.clear();
  std::vector<std::uint64_t> lost;
  stage.run(5.5, kNobodyMoves,
            [&](double) { lost.insert(lost.end(), stage.newest.lost.begin(), stage.newest.lost.end()); });
  EXPECT_TRUE(stage.tracks.empty());
  EXPECT_EQ(lost, std::vector<std::uint64_t>{id});
}

TEST(Tracker, RemembersAStaticThingThatNobodyLooksAt) {
  Stage stage(room_with_racks(), {vehicle_at("a", 9.0, 1.5)}, 1);
  stage.world.discs = {{{11.0, 1.5}, 0.25}};
  stage.run(5.0, kNobodyMoves);
  ASSERT_EQ(stage.tracks.size(), 1U);
  stage.fleet[0].base_in_map = {9.0, 5.0, 0.0};  // behind a rack
  stage.run(15.0, kNobodyMoves);
  ASSERT_EQ(stage.tracks.size(), 1U);
  EXPECT_LT(geometry::distance(stage.tracks[0].position_in_map, {11.0, 1.5}), 0.15);
  EXPECT_GT(stage.tracks[0].unseen_s, 9.0);
}

TEST(Tracker, GivesUpAWalkerTwoSecondsAfterHeWasSeen) {
  Stage stage(room(16.0, 12.0), {vehicle_at("a", 8.0, 2.0)}, 1);
  stage.run(3.0, [&](double t) { stage.world.discs = {{{6.0 + 1.3 * t, 6.0}, 0.25}}; });
  ASSERT_EQ(stage.tracks.size(), 1U);
  const auto at = [&](double t) { return stage.start + time::from_seconds(t); };
  EXPECT_TRUE(stage.tracker.give_up_overdue(at(4.8)).empty());
  EXPECT_EQ(stage.tracker.give_up_overdue(at(5.0)).size(), 1U);
  EXPECT_TRUE(stage.tracker.tracks(at(5.0)).empty());
}

TEST(Tracker, DoesNotCarryOnWhatItHardlySaw) {
  Stage stage(room(16.0, 12.0), {vehicle_at("a", 8.0, 2.0)}, 1);
  stage.run(0.3, [&](double t) { stage.world.discs = {{{6.0 + 1.3 * t, 6.0}, 0.25}}; });
  ASSERT_EQ(stage.tracks.size(), 1U);
  EXPECT_EQ(stage.tracker.give_up_overdue(stage.start + time::from_seconds(0.8)).size(), 1U);
}

TEST(Tracker, FindsOneWhoWalksAlongAWall) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Stage stage(room(16.0, 12.0), {vehicle_at("a", 8.0, 7.0)}, seed);
    int seen = 0;
    int scans = 0;
    stage.run(
        5.0,
        [&](double t) {
          stage.world.discs = {{{5.0 + 1.2 * t, 11.95 - 0.4}, 0.25}};
        },
        [&](double t) {
          ++scans;
          const Track* track = stage.track_at({5.0 + 1.2 * t, 11.55}, 0.3);
          seen += track != nullptr ? 1 : 0;
        });
    EXPECT_GE(seen, scans * 9 / 10) << "seed " << seed;
    EXPECT_LE(stage.ids.size(), 1U) << "seed " << seed;
  }
}

/// Of all points of the boxes that a ray of the vehicle touches: how far the worst lies outside the tracks' discs.
double worst_uncovered_m(const Stage& stage, const Vehicle& vehicle) {
  const Point2 from = vehicle.base_in_map.position();
  double worst_m = -1e9;
  for (int ray = 0; ray < vehicle.rays; ++ray) {
    const double angle_rad = vehicle.base_in_map.yaw + 2.0 * geometry::kPi * ray / vehicle.rays;
    const double range_m = stage.world.ray_m(from, angle_rad, vehicle.range_m);
    if (range_m > grid::cast_ray(stage.world.grid, from, angle_rad, vehicle.range_m) - 0.01) continue;
    const Point2 touched{from.x + range_m * std::cos(angle_rad), from.y + range_m * std::sin(angle_rad)};
    double least_m = 1e9;
    for (const Track& track : stage.tracks) {
      least_m = std::min(least_m, geometry::distance(touched, track.position_in_map) - track.radius_m);
    }
    worst_m = std::max(worst_m, least_m);
  }
  return worst_m;
}

TEST(Tracker, CoversABoxFromAnySide) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    Stage stage(room(16.0, 12.0), {vehicle_at("a", 5.0, 4.0)}, seed);
    const Box box{{8.0, 6.0, 0.26 * seed}, 0.8, 0.8};
    stage.world.boxes = {box};
    stage.run(5.0, kNobodyMoves);
    EXPECT_LE(stage.tracks.size(), 2U) << "seed " << seed;
    for (const Track& track : stage.tracks) {
      EXPECT_TRUE(track.is_static) << "seed " << seed;
      EXPECT_LE(track.radius_m, 0.95) << "seed " << seed;
    }
    EXPECT_LT(worst_uncovered_m(stage, stage.fleet[0]), 0.05) << "seed " << seed;
  }
}

TEST(Tracker, CoversALongBlockWithSeveralDiscs) {
  for (unsigned seed = 1; seed <= 12; ++seed) {
    Stage stage(room(16.0, 12.0), {vehicle_at("a", 5.0, 4.0)}, seed);
    const Box box{{8.0, 6.0, 0.26 * seed}, 2.4, 0.5};
    stage.world.boxes = {box};
    stage.run(6.0, kNobodyMoves);
    for (const Track& track : stage.tracks) EXPECT_LE(track.radius_m, 0.95) << "seed " << seed;
    EXPECT_LT(worst_uncovered_m(stage, stage.fleet[0]), 0.05) << "seed " << seed;
  }
}

TEST(Tracker, KeepsABoxStaticWhileTheVehicleDrivesAroundIt) {
  Stage stage(room(16.0, 12.0), {vehicle_at("a", 5.0, 4.0)}, 3);
  const Box box{{8.0, 6.0, 0.4}, 0.8, 0.8};
  stage.world.boxes = {box};
  int not_static = 0;
  int uncovered = 0;
  stage.run(
      25.0,
      [&](double t) {
        stage.fleet[0].base_in_map = {8.0 + 3.0 * std::cos(0.25 * t), 6.0 + 3.0 * std::sin(0.25 * t),
                                      0.25 * t + geometry::kPi / 2};
        stage.fleet[0].twist = {0.75, 0.25, 0.0};
      },
      [&](double t) {
        if (t < 4.0) return;
        for (const Track& track : stage.tracks) not_static += track.is_static ? 0 : 1;
        const double worst_m = worst_uncovered_m(stage, stage.fleet[0]);
        EXPECT_LT(worst_m, 0.2);
        uncovered += worst_m > 0.05 ? 1 : 0;  // for a scan or two, when a new side comes into view
      });
  EXPECT_LE(stage.ids.size(), 2U);
  EXPECT_LT(not_static, 25);
  EXPECT_LE(uncovered, 10);
}

TEST(Tracker, DoesNotTakeTheFleetForObstacles) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    Stage stage(room(16.0, 12.0), {vehicle_at("a", 4.0, 4.0), vehicle_at("b", 8.0, 4.0)}, seed);
    stage.fleet[1].twist = {1.2, 0.4, 0.0};
    const Vehicle start = stage.fleet[1];
    stage.run(40.0,
              [&](double t) { stage.fleet[1].base_in_map = kinematics::advance(start.base_in_map, start.twist, t); });
    EXPECT_TRUE(stage.ids.empty()) << "seed " << seed;
  }
}

TEST(Tracker, TakesAVehicleWhoseStateIsOldForAnObstacle) {
  World world(room(16.0, 12.0));
  const std::vector<Vehicle> fleet{vehicle_at("a", 4.0, 4.0), vehicle_at("b", 8.0, 4.0)};
  Lidar lidar(1);
  Tracker tracker;
  const time::Stamp begin{std::chrono::seconds(100)};
  const std::vector<KnownVehicle> known = lidar.known(fleet, begin);  // b says nothing more
  std::size_t at_first = 0;
  for (int k = 0; k < 30; ++k) {
    const time::Stamp now = begin + k * std::chrono::milliseconds(100);
    EXPECT_FALSE(tracker.take(lidar.scan(world, fleet[0], fleet, now), known, &world.clearance, now).dropped);
    if (k == 9) at_first = tracker.tracks(now).size();
  }
  EXPECT_EQ(at_first, 0U);
  EXPECT_EQ(tracker.tracks(begin + std::chrono::seconds(3)).size(), 1U);
}

TEST(Tracker, LosesWhatAMapEditCovers) {
  Stage stage(room(16.0, 12.0), {vehicle_at("a", 8.0, 2.0)}, 1);
  stage.world.discs = {{{9.0, 6.0}, 0.25}};
  stage.run(5.0, kNobodyMoves);
  ASSERT_EQ(stage.tracks.size(), 1U);
  grid::OccupancyGrid edited = stage.world.grid;
  fill(edited, {8.0, 5.0}, {10.0, 7.0});
  stage.world.clearance = grid::ClearanceField(edited);  // in the map only: the rays still go through
  stage.run(6.0, kNobodyMoves);
  EXPECT_TRUE(stage.tracks.empty());
  stage.run(20.0, kNobodyMoves);
  EXPECT_EQ(stage.ids.size(), 1U);
}

/// Normalised estimation error squared of the published state, on average over runs: 4 when the covariance is honest.
TEST(Tracker, IsAsSureAsItMayBe) {
  double sum = 0.0;
  int count = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    Stage stage(room(16.0, 12.0), {vehicle_at("a", 8.0, 2.0, 0.1 * seed)}, seed);
    const double heading = 0.3 * seed;
    const auto truth = [&](double t) {
      return Point2{8.0 + 1.2 * (t - 2.0) * std::cos(heading), 6.5 + 1.2 * (t - 2.0) * std::sin(heading)};
    };
    stage.run(
        4.0,
        [&](double t) {
          stage.world.discs = {{truth(t), 0.25}};
        },
        [&](double t) {
          const Track* track = stage.track_at(truth(t));
          if (t < 1.5 || track == nullptr) return;
          const Point2 p = track->position_in_map - truth(t);
          const Eigen::Vector4d error(p.x, p.y, track->velocity_in_map.x - 1.2 * std::cos(heading),
                                      track->velocity_in_map.y - 1.2 * std::sin(heading));
          const Eigen::Matrix4d covariance = Eigen::Map<const Eigen::Matrix4d>(track->covariance.data());
          sum += error.dot(covariance.inverse() * error);
          ++count;
        });
  }
  const double nees = sum / count;
  RecordProperty("nees", std::to_string(nees));
  EXPECT_GT(nees, 1.5);
  EXPECT_LT(nees, 5.5);
}

TEST(Tracker, HoldsNoMoreThanTheFleetAndWhatIsThere) {
  World world(room(16.0, 12.0));
  Lidar lidar(1);
  Tracker tracker;
  std::size_t most = 0;
  for (int k = 0; k < 1200;
       ++k) {  // two minutes; every 5 s somebody else, and a vehicle of another name in the same place
    const std::string name = "agv-" + std::to_string(k / 50);
    const std::vector<Vehicle> fleet{vehicle_at(name.c_str(), 8.0, 2.0)};
    const double t = 0.1 * (k % 50);
    world.discs = {{{4.0 + 1.3 * t, 5.0 + 0.2 * (k / 50 % 5)}, 0.25}, {{11.0 - 1.3 * t, 9.0}, 0.25}};
    const time::Stamp now = std::chrono::seconds(100) + k * std::chrono::milliseconds(100);
    ASSERT_FALSE(
        tracker.take(lidar.scan(world, fleet[0], fleet, now), lidar.known(fleet, now), &world.clearance, now).dropped);
    most = std::max(most, tracker.tracks_held());
    ASSERT_EQ(tracker.vehicles_held(), 1U);
  }
  EXPECT_LE(most, 8U);
  static_cast<void>(tracker.give_up_overdue(std::chrono::seconds(300)));
  EXPECT_EQ(tracker.tracks_held(), 0U);
}

TEST(Tracker, DropsWhatItCannotUseAndCountsWhy) {
  World world(room(16.0, 12.0));
  const std::vector<Vehicle> fleet{vehicle_at("a", 8.0, 2.0)};
  Lidar lidar(1);
  Tracker tracker;
  const time::Stamp now{std::chrono::seconds(100)};
  const std::vector<KnownVehicle> known = lidar.known(fleet, now);
  const Scan good = lidar.scan(world, fleet[0], fleet, now);
  const auto reason_of = [&](const std::function<void(Scan&)>& spoil) {
    Scan scan = good;
    spoil(scan);
    return tracker.take(scan, known, &world.clearance, now).dropped;
  };
  EXPECT_EQ(reason_of([](Scan& s) { s.agv_id = "stranger"; }), DropReason::kUnknownVehicle);
  EXPECT_EQ(tracker.take(good, known, nullptr, now).dropped, DropReason::kNoMap);
  EXPECT_EQ(reason_of([](Scan& s) { s.base_in_map.x = std::nan(""); }), DropReason::kNotFinite);
  EXPECT_EQ(reason_of([](Scan& s) { s.ranges_m[7] = std::nanf(""); }), DropReason::kNotFinite);
  EXPECT_EQ(reason_of([](Scan& s) { s.ranges_m[7] = -0.5F; }), DropReason::kNegativeRange);
  EXPECT_EQ(reason_of([](Scan& s) { s.ranges_m.clear(); }), DropReason::kWrongCount);
  EXPECT_EQ(reason_of([](Scan& s) { s.ranges_m.resize(1000, 1.0F); }), DropReason::kWrongCount);
  EXPECT_EQ(reason_of([](Scan& s) { s.angle_step_rad = 0.0; }), DropReason::kBadGeometry);
  EXPECT_EQ(reason_of([](Scan& s) { s.position_sigma_m = std::nan(""); }), DropReason::kNotFinite);
  EXPECT_EQ(reason_of([](Scan& s) { s.position_sigma_m = 50.0; }), DropReason::kBadGeometry);
  EXPECT_EQ(reason_of([](Scan& s) { s.yaw_sigma_rad = -0.1; }), DropReason::kBadGeometry);
  EXPECT_EQ(reason_of([](Scan& s) { s.twist.angular_radps = std::nan(""); }), DropReason::kNotFinite);
  EXPECT_EQ(reason_of([](Scan& s) { s.base_in_map.y = 1e308; }), DropReason::kBadGeometry);
  EXPECT_EQ(reason_of([](Scan& s) { s.sweep_s = 3600.0; }), DropReason::kBadGeometry);
  EXPECT_EQ(reason_of([](Scan& s) { s.range_max_m = 0.01; }), DropReason::kBadGeometry);
  EXPECT_EQ(reason_of([](Scan& s) { s.ranges_m[7] = -std::numeric_limits<float>::infinity(); }),
            DropReason::kNegativeRange);
  EXPECT_EQ(reason_of([](Scan& s) { s.stamp += std::chrono::seconds(2); }), DropReason::kFuture);
  EXPECT_EQ(reason_of([](Scan& s) { s.stamp += std::chrono::hours(1); }), DropReason::kFuture);
  EXPECT_EQ(reason_of([](Scan& s) { s.stamp -= std::chrono::seconds(2); }), DropReason::kTooOld);
  EXPECT_EQ(reason_of([](Scan& s) { s.stamp -= std::chrono::minutes(60); }), DropReason::kTooOld);
  EXPECT_EQ(tracker.scans_used(), 0U);
  EXPECT_EQ(reason_of([](Scan& s) { s.ranges_m[7] = std::numeric_limits<float>::infinity(); }), std::nullopt)
      << "nothing was seen there";
  EXPECT_EQ(reason_of([](Scan&) {}), DropReason::kNotNewer);
  EXPECT_EQ(reason_of([](Scan& s) { s.stamp += std::chrono::milliseconds(10), s.ranges_m.resize(100); }),
            DropReason::kWrongCount);
  EXPECT_EQ(tracker.scans_used(), 1U);
  const std::map<DropReason, std::uint64_t> counted{
      {DropReason::kUnknownVehicle, 1}, {DropReason::kNoMap, 1},      {DropReason::kNotFinite, 4},
      {DropReason::kNegativeRange, 2},  {DropReason::kWrongCount, 3}, {DropReason::kBadGeometry, 6},
      {DropReason::kNotNewer, 1},       {DropReason::kFuture, 2},     {DropReason::kTooOld, 2}};
  std::set<std::string> names;
  for (const auto& [reason, times] : counted) {
    EXPECT_EQ(tracker.scans_dropped(reason), times) << name_of(reason);
    names.insert(name_of(reason));
  }
  EXPECT_EQ(names.size(), static_cast<std::size_t>(kDropReasons));
  EXPECT_EQ(tracker.scans_dropped(), 22U);
}

TEST(Tracker, IsNotMovedByABrokenScan) {
  Stage stage(room(16.0, 12.0), {vehicle_at("a", 8.0, 2.0)}, 1);
  stage.run(3.0, [&](double t) { stage.world.discs = {{{6.0 + t, 6.0}, 0.25}}; });
  ASSERT_EQ(stage.tracks.size(), 1U);
  const time::Stamp now = stage.start + time::from_seconds(3.0);
  Scan scan = stage.lidar.scan(stage.world, stage.fleet[0], stage.fleet, now);
  scan.ranges_m[7] = std::nanf("");
  EXPECT_EQ(stage.tracker.take(scan, stage.lidar.known(stage.fleet, now), &stage.world.clearance, now).dropped,
            DropReason::kNotFinite);
  const Track before = stage.tracks[0];
  const Track after = stage.tracker.tracks(stage.start + time::from_seconds(2.9)).at(0);
  EXPECT_EQ(after.position_in_map.x, before.position_in_map.x);
  EXPECT_EQ(after.covariance, before.covariance);
  scan =
      stage.lidar.scan(stage.world, stage.fleet[0], stage.fleet, now);  // the next good one of the same moment is taken
  EXPECT_FALSE(stage.tracker.take(scan, stage.lidar.known(stage.fleet, now), &stage.world.clearance, now).dropped);
}

}  // namespace
}  // namespace aisle::obstacle_tracker::test
