#include "services/global-planner/core/traffic/roadmap.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "tests/unit/global-planner/traffic/floors.hpp"
#include "tests/unit/global-planner/traffic/roadmap_checks.hpp"

namespace aisle::global_planner::traffic {
namespace {

using geometry::Point2;
using grid::Cell;

class OnEveryFloor : public ::testing::TestWithParam<std::size_t> {
 protected:
  static const std::vector<FloorMap>& floors() {
    static const std::vector<FloorMap> all = all_floors();
    return all;
  }
  const FloorMap& floor() const { return floors()[GetParam()]; }
};

TEST_P(OnEveryFloor, PlacesAndMotionsAreSound) {
  auto made = made_for(floor());
  ASSERT_FALSE(lattice(made.roadmap).empty());
  expect_sound(floor(), made.roadmap, kNeedM, 1.0);
}

TEST_P(OnEveryFloor, WhatTheFloorConnectsIsJoined) {
  auto made = made_for(floor());
  expect_joined_as_the_floor(floor(), made.roadmap, kNeedM);
}

TEST_P(OnEveryFloor, EveryFreeSpotReachesAPlace) {
  auto made = made_for(floor());
  std::mt19937 random(5);
  const grid::Geometry& g = floor().grid.geometry();
  int tried = 0;
  int straight = 0;

  while (tried < 400) {
    const Cell cell{static_cast<int>(random() % static_cast<unsigned>(g.width)),
                    static_cast<int>(random() % static_cast<unsigned>(g.height))};
    if (!floor().clearance.is_traversable(cell, kNeedM)) continue;

    ++tried;
    const Point2 at = g.center_in_map(cell);
    const PlaceId id = made.roadmap.temporary_place(made.kind, {at.x, at.y, 0.0});
    ASSERT_NE(id, kNoId) << at.x << " " << at.y;
    ASSERT_FALSE(made.roadmap.place(id).leaving.empty());
    ASSERT_FALSE(made.roadmap.place(id).entering.empty());
    straight += made.roadmap.nearest(made.kind, {at.x, at.y, 0.0}) != kNoId ? 1 : 0;
    made.roadmap.sweep({}, {});
    ASSERT_TRUE(made.roadmap.place(id).is_temporary == false || made.roadmap.place(id).standing.empty());
  }

  EXPECT_GE(straight, tried * 99 / 100);
}

TEST_P(OnEveryFloor, DetoursAreShort) {
  auto made = made_for(floor());
  const auto places = lattice(made.roadmap);
  const grid::Geometry& g = floor().grid.geometry();
  std::mt19937 random(9);
  double sum = 0.0;
  int count = 0;

  for (int i = 0; i < 4; ++i) {
    const PlaceId goal = places[random() % places.size()];
    const auto metres = grid_distances_m(floor(), g.cell_at(made.roadmap.place(goal).base_in_map.position()), kNeedM);
    const auto& table = made.roadmap.seconds_to(goal);
    for (const PlaceId from : places) {
      const double direct_m = metres[g.index(g.cell_at(made.roadmap.place(from).base_in_map.position()))];
      if (!std::isfinite(direct_m) || direct_m < 3.0) continue;
      sum += table[from] * 0.9 * cart().limits.max_speed_mps / direct_m;
      ++count;
    }
  }

  ASSERT_GT(count, 10);
  EXPECT_LE(sum / count, 1.25) << floor().name;
}

INSTANTIATE_TEST_SUITE_P(Roadmap, OnEveryFloor, ::testing::Range<std::size_t>(0, all_floors().size()));

TEST(Roadmap, EqualKindsShareOne) {
  const FloorMap floor = room();
  auto made = made_for(floor);
  const std::size_t before = made.roadmap.places();
  EXPECT_EQ(made.roadmap.kind(cart()), made.kind);
  EXPECT_EQ(made.roadmap.places(), before);

  Kind slow = cart();
  slow.limits.max_speed_mps = 0.5;
  EXPECT_NE(made.roadmap.kind(slow), made.kind);
  EXPECT_EQ(made.roadmap.places(), 2 * before);
}

TEST(Roadmap, TheSameMapGivesTheSame) {
  const FloorMap floor = lane_with_bay();
  const auto a = made_for(floor);
  const auto b = made_for(floor);
  ASSERT_EQ(a.roadmap.motions(), b.roadmap.motions());
  for (MotionId id = 0; id < a.roadmap.motions(); ++id)
    ASSERT_EQ(a.roadmap.motion(id).path_in_map, b.roadmap.motion(id).path_in_map);
}

TEST(Corridors, ALaneIsOneAndTheRoomsAreNone) {
  const FloorMap floor = lane_with_bay();
  const auto made = made_for(floor);
  std::set<std::uint32_t> numbers;

  for (const PlaceId id : lattice(made.roadmap)) {
    const Place& place = made.roadmap.place(id);
    const double x = place.base_in_map.x;
    const bool is_in_room = x < 4.0 || x > 17.0;
    const bool is_in_lane = (x > 5.0 && x < 9.0) || (x > 12.0 && x < 16.0);
    if (is_in_room) {
      EXPECT_EQ(place.corridor, kNoId);
    }
    if (is_in_lane) {
      EXPECT_NE(place.corridor, kNoId);
      EXPECT_FALSE(place.may_rest);
      numbers.insert(place.corridor);
    }
  }

  EXPECT_EQ(numbers.size(), 1U);
  const Place& bay = made.roadmap.place(made.roadmap.nearest(made.kind, {10.5, 3.8, 0.0}));
  EXPECT_GT(bay.base_in_map.y, 3.0);
  EXPECT_EQ(bay.corridor, kNoId);
  EXPECT_TRUE(bay.may_rest);
}

TEST(TemporaryPlace, IsJoinedBothWaysAndEndsWhenItIsNotInUse) {
  const FloorMap floor = room();
  auto made = made_for(floor);
  const std::size_t motions = made.roadmap.motions();
  const PlaceId id = made.roadmap.temporary_place(made.kind, {5.2, 4.3, 0.0});
  ASSERT_NE(id, kNoId);
  EXPECT_GE(made.roadmap.place(id).leaving.size(), 3U);
  EXPECT_EQ(made.roadmap.place(id).leaving.size(), made.roadmap.place(id).entering.size());
  EXPECT_EQ(made.roadmap.temporary_place(made.kind, {5.205, 4.3, 1.0}), id);

  const MotionId leaving = made.roadmap.place(id).leaving.front();
  made.roadmap.sweep({id}, {});
  EXPECT_FALSE(made.roadmap.place(id).leaving.empty());
  made.roadmap.sweep({}, {leaving});
  EXPECT_FALSE(made.roadmap.place(id).is_closed);

  const Roadmap::Ended ended = made.roadmap.sweep({}, {});
  EXPECT_THAT(ended.places, ::testing::ElementsAre(id));
  EXPECT_THAT(ended.motions, ::testing::Contains(leaving));
  EXPECT_TRUE(made.roadmap.place(id).is_closed);
  EXPECT_TRUE(made.roadmap.motion(leaving).is_closed);
  EXPECT_NE(made.roadmap.temporary_place(made.kind, {5.2, 4.3, 0.0}), id);
  for (MotionId m = 0; m < motions; ++m) EXPECT_FALSE(made.roadmap.motion(m).is_closed);
}

TEST(TemporaryPlace, OnAPlaceIsThatPlace) {
  const FloorMap floor = room();
  auto made = made_for(floor);
  const PlaceId any = lattice(made.roadmap)[7];
  EXPECT_EQ(made.roadmap.temporary_place(made.kind, made.roadmap.place(any).base_in_map), any);
}

TEST(TemporaryPlace, NearAWallIsJoinedAsWell) {
  const FloorMap floor = room();
  auto made = made_for(floor);
  EXPECT_NE(made.roadmap.temporary_place(made.kind, {0.9, 4.3, 0.0}), kNoId);  // 0.4 m from the wall
  EXPECT_EQ(made.roadmap.temporary_place(made.kind, {0.2, 4.3, 0.0}), kNoId);  // in the wall
}

TEST(TemporaryMotion, HasAMotionBackAndJoinsWhatIsLeftAlone) {
  const FloorMap floor = room();
  auto made = made_for(floor);
  Roadmap& roadmap = made.roadmap;
  const PlaceId a = roadmap.temporary_place(made.kind, {5.2, 4.3, 0.0});
  const PlaceId b = roadmap.temporary_place(made.kind, {6.3, 4.8, 0.0}, false);
  EXPECT_TRUE(roadmap.place(b).leaving.empty());

  const MotionId id = roadmap.temporary_motion(a, b, {{5.2, 4.3}, {5.8, 4.4}, {6.3, 4.8}});
  ASSERT_EQ(roadmap.place(b).leaving.size(), 1U);
  const Motion& back = roadmap.motion(roadmap.place(b).leaving.front());
  EXPECT_EQ(back.to, a);
  EXPECT_EQ(back.path_in_map.front(), (Point2{6.3, 4.8}));
  EXPECT_NEAR(roadmap.motion(id).length_m, std::hypot(0.6, 0.1) + std::hypot(0.5, 0.4), 1e-12);

  roadmap.sweep({b}, {});
  EXPECT_GE(roadmap.place(b).leaving.size(), 3U);
}

TEST(TemporaryMotion, OfAnEqualPathIsTheSame) {
  const FloorMap floor = room();
  auto made = made_for(floor);
  Roadmap& roadmap = made.roadmap;
  const PlaceId a = roadmap.temporary_place(made.kind, {5.2, 4.3, 0.0});
  const PlaceId b = roadmap.temporary_place(made.kind, {6.3, 4.8, 0.0});
  const MotionId id = roadmap.temporary_motion(a, b, {{5.2, 4.3}, {5.8, 4.4}, {6.3, 4.8}});
  const std::size_t motions = roadmap.motions();
  EXPECT_EQ(roadmap.temporary_motion(a, b, {{5.2, 4.3}, {5.805, 4.4}, {6.3, 4.8}}), id);
  EXPECT_EQ(roadmap.motions(), motions);
  EXPECT_NE(roadmap.temporary_motion(a, b, {{5.2, 4.3}, {5.9, 4.4}, {6.3, 4.8}}), id);
}

TEST(TemporaryMotion, EndsWhenNotInUseThoughItsPlacesStay) {
  const FloorMap floor = room();
  auto made = made_for(floor);
  Roadmap& roadmap = made.roadmap;
  const PlaceId a = roadmap.temporary_place(made.kind, {5.2, 4.3, 0.0});
  const PlaceId b = roadmap.temporary_place(made.kind, {6.3, 4.8, 0.0});
  const MotionId used = roadmap.temporary_motion(a, b, {{5.2, 4.3}, {6.3, 4.8}});
  const MotionId unused = roadmap.temporary_motion(a, b, {{5.2, 4.3}, {5.9, 4.4}, {6.3, 4.8}});

  roadmap.sweep({a, b}, {used});
  EXPECT_FALSE(roadmap.motion(used).path_in_map.empty());
  const auto& leaving = roadmap.place(b).leaving;
  EXPECT_TRUE(std::any_of(leaving.begin(), leaving.end(), [&](MotionId m) { return roadmap.motion(m).to == a; }));
  roadmap.sweep({a, b}, {});
  EXPECT_TRUE(roadmap.motion(used).path_in_map.empty());
  EXPECT_TRUE(roadmap.motion(unused).path_in_map.empty());
  EXPECT_FALSE(roadmap.place(a).leaving.empty());
}

TEST(TemporaryPlace, IdsAreUsedAgainTenSweepsLater) {
  const FloorMap floor = room();
  auto made = made_for(floor);
  Roadmap& roadmap = made.roadmap;
  std::mt19937 random(3);
  std::size_t most_places = 0;
  std::size_t most_motions = 0;

  for (int round = 0; round < 200; ++round) {
    const double x = 1.0 + 0.01 * static_cast<double>(random() % 1000);
    const PlaceId id = roadmap.temporary_place(made.kind, {x, 4.3, 0.0});
    ASSERT_NE(id, kNoId);
    ASSERT_NEAR(roadmap.place(id).base_in_map.x, x, 0.011);
    for (const MotionId motion : roadmap.place(id).leaving) ASSERT_EQ(roadmap.motion(motion).from, id);

    roadmap.close("box", Shape({{{x, 4.3}, {x, 4.3}, 0.2}}));
    if (round % 2 == 0) roadmap.open("box");
    const auto told = roadmap.sweep({}, {});
    for (const PlaceId ended : told.places) ASSERT_TRUE(roadmap.place(ended).standing.empty());
    if (round == 40) {
      most_places = roadmap.places();
      most_motions = roadmap.motions();
    }
  }

  EXPECT_LT(roadmap.places(), most_places + 100);
  EXPECT_LT(roadmap.motions(), most_motions + 1'000);
  roadmap.open("box");
  roadmap.sweep({}, {});
  for (const PlaceId id : lattice(roadmap)) ASSERT_FALSE(roadmap.place(id).is_closed);
  for (MotionId id = 0; id < roadmap.motions(); ++id)
    ASSERT_TRUE(!roadmap.motion(id).is_closed || roadmap.motion(id).path_in_map.empty());
}

TEST(Closures, CloseWhatMeetsThemUntilTheyEnd) {
  const FloorMap floor = lane_with_bay();
  auto made = made_for(floor);
  Roadmap& roadmap = made.roadmap;
  const PlaceId left = roadmap.nearest(made.kind, {1.5, 2.5, 0.0});
  const PlaceId right = roadmap.nearest(made.kind, {19.5, 2.5, 0.0});
  ASSERT_TRUE(std::isfinite(roadmap.seconds_to(left, right)));
  const std::uint64_t before = roadmap.revision();

  const Shape box({{{7.0, 2.6}, {7.0, 2.6}, 0.2}});
  roadmap.close("box", box);
  roadmap.close("other", box);
  EXPECT_GT(roadmap.revision(), before);
  EXPECT_FALSE(std::isfinite(roadmap.seconds_to(left, right)));
  for (const PlaceId id : lattice(roadmap))
    EXPECT_EQ(roadmap.place(id).is_closed, meet(roadmap.place(id).standing, box, 0.05));

  const PlaceId inside = roadmap.temporary_place(made.kind, {7.2, 2.5, 0.0});
  EXPECT_TRUE(roadmap.place(inside).is_closed);
  EXPECT_TRUE(std::isfinite(roadmap.seconds_to(inside, right)));  // the vehicle inside may leave

  roadmap.open("box");
  EXPECT_FALSE(std::isfinite(roadmap.seconds_to(left, right)));
  roadmap.open("other");
  EXPECT_TRUE(std::isfinite(roadmap.seconds_to(left, right)));
  for (const PlaceId id : lattice(roadmap)) EXPECT_FALSE(roadmap.place(id).is_closed);
}

TEST(Closures, HaveAWayRoundWhereThereIsRoom) {
  const FloorMap floor = room(40, 5);  // 20 m x 2.5 m
  auto made = made_for(floor);
  Roadmap& roadmap = made.roadmap;
  const PlaceId left = roadmap.nearest(made.kind, {1.5, 1.75, 0.0});
  const PlaceId right = roadmap.nearest(made.kind, {19.0, 1.75, 0.0});
  const auto before = lattice(roadmap);
  const double free_s = roadmap.seconds_to(left, right);

  const Shape box({{{10.0, 1.75}, {10.3, 1.75}, 0.12}});
  roadmap.close("box", box);
  EXPECT_LT(roadmap.seconds_to(left, right), free_s + 3.0);
  for (MotionId id = 0; id < roadmap.motions(); ++id) {
    const Motion& motion = roadmap.motion(id);
    const bool is_open = !motion.is_closed && !roadmap.place(motion.from).is_closed;
    ASSERT_FALSE(is_open && meet(motion.shape, box, 0.05));
  }
  ASSERT_GT(lattice(roadmap).size(), before.size());
  const PlaceId beside = lattice(roadmap).back();

  roadmap.open("box");
  EXPECT_EQ(lattice(roadmap), before);
  EXPECT_FALSE(roadmap.place(beside).is_closed);  // a vehicle may stand there still
  EXPECT_TRUE(std::isfinite(roadmap.seconds_to(beside, right)));
  roadmap.sweep({}, {});
  EXPECT_TRUE(roadmap.place(beside).standing.empty());
  EXPECT_NEAR(roadmap.seconds_to(left, right), free_s, 1e-9);
}

TEST(Closures, TheSameShapeAgainChangesNothing) {
  const FloorMap floor = room();
  auto made = made_for(floor);
  made.roadmap.close("box", Shape({{{4.0, 4.0}, {4.0, 4.0}, 0.2}}));
  const std::uint64_t revision = made.roadmap.revision();
  made.roadmap.close("box", Shape({{{4.001, 4.0}, {4.0, 4.0}, 0.2}}));
  EXPECT_EQ(made.roadmap.revision(), revision);
  made.roadmap.close("box", Shape({{{4.1, 4.0}, {4.0, 4.0}, 0.2}}));
  EXPECT_GT(made.roadmap.revision(), revision);
}

TEST(Distances, AreThoseOfTheShortestWayAndServeTemporaryPlaces) {
  const FloorMap floor = room();
  auto made = made_for(floor);
  Roadmap& roadmap = made.roadmap;
  const PlaceId from = roadmap.nearest(made.kind, {1.5, 1.5, 0.0});
  const PlaceId to = roadmap.nearest(made.kind, {9.5, 1.5, 0.0});
  const double metres = distance(roadmap.place(from).base_in_map.position(), roadmap.place(to).base_in_map.position());
  EXPECT_NEAR(roadmap.seconds_to(from, to), metres / (0.9 * 1.2), 1e-9);

  const PlaceId start = roadmap.temporary_place(made.kind, {2.2, 1.7, 0.0});
  const PlaceId goal = roadmap.temporary_place(made.kind, {8.8, 1.3, 0.0});
  EXPECT_GE(roadmap.seconds_to(start, goal), std::hypot(6.6, 0.4) / (0.9 * 1.2));
  EXPECT_LE(roadmap.seconds_to(start, goal), 1.3 * std::hypot(6.6, 0.4) / (0.9 * 1.2));
  EXPECT_EQ(roadmap.seconds_to(goal, goal), 0.0);
}

TEST(RunSeconds, CountLengthTurnsAndTheStart) {
  Motion motion;
  motion.path_in_map = {{0.0, 0.0}, {1.08, 0.0}};
  motion.length_m = 1.08;
  motion.speed_mps = 1.2;
  EXPECT_NEAR(run_s(cart(), motion, 0.0, false), 1.0, 1e-9);
  EXPECT_NEAR(run_s(cart(), motion, 0.0, true), 1.5, 1e-9);
  EXPECT_NEAR(run_s(cart(), motion, 0.5 * geometry::kPi, false), 2.0, 1e-9);
  EXPECT_NEAR(run_s(cart(), motion, -geometry::kPi, false), 3.0, 1e-9);
}

}  // namespace
}  // namespace aisle::global_planner::traffic
