#include "services/fake-world/core/world.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace aisle::fake_world {
namespace {

scenario::Scenario yard() {
  scenario::Scenario scenario;
  scenario::Mover mover;
  mover.id = "walker";
  mover.speed_mps = 1.0;
  mover.start_s = 2.0;
  mover.waypoints_in_map = {{0, 0}, {10, 0}};
  scenario.movers.push_back(mover);
  scenario::Block block;
  block.id = "box";
  block.center_in_map = {5, 5, 0};
  block.appear_s = 3.0;
  scenario.blocks.push_back(block);
  scenario.recordings.push_back({});
  scenario.recordings[0].begin_s = 10.0;
  scenario.recordings[0].end_s = 14.0;
  return scenario;
}

std::vector<std::vector<RecordedPerson>> one_person() {
  std::vector<std::vector<RecordedPerson>> people(1);
  people[0].emplace_back("person-1", std::vector<RecordedPerson::Row>{{11.0, {8, 8}}, {13.0, {8, 10}}});
  return people;
}

std::vector<std::string> ids(const World& world) {
  std::vector<std::string> ids;
  for (const Thing& thing : world.things()) ids.push_back(thing.id);
  return ids;
}

const Thing& find(const World& world, const std::string& id) {
  const auto found =
      std::find_if(world.things().begin(), world.things().end(), [&](const Thing& t) { return t.id == id; });
  EXPECT_NE(found, world.things().end()) << id;
  return *found;
}

geometry::Body vehicle_at(double x, double y) {
  geometry::Body body;
  body.base_in_map = {x, y, 0.0};
  body.radius_m = 0.35;
  return body;
}

using ::testing::ElementsAre;
using ::testing::UnorderedElementsAre;

TEST(World, ThingsComeAndGoAtTheirTimes) {
  World world(yard(), one_person(), 1, nullptr);
  world.advance_to(0.5, {});
  EXPECT_THAT(ids(world), UnorderedElementsAre("walker"));
  world.advance_to(1.5, {});
  EXPECT_THAT(ids(world), UnorderedElementsAre("walker", "person-1"));
  world.advance_to(3.1, {});
  EXPECT_THAT(ids(world), UnorderedElementsAre("walker", "box"));
  EXPECT_THAT(world.gone(), ElementsAre("person-1"));
  world.advance_to(3.2, {});
  EXPECT_TRUE(world.gone().empty());
}

TEST(World, NobodyShowsAfterTheRecordingsWindow) {
  scenario::Scenario scenario = yard();
  scenario.recordings[0].end_s = 12.0;
  World world(scenario, one_person(), 1, nullptr);
  world.advance_to(1.9, {});
  EXPECT_THAT(ids(world), ::testing::Contains("person-1"));
  world.advance_to(2.1, {});
  EXPECT_THAT(ids(world), ::testing::Not(::testing::Contains("person-1")));
}

TEST(World, WalkersStartAtTheirTime) {
  World world(yard(), one_person(), 1, nullptr);
  world.advance_to(0.1, {});
  const double start = find(world, "walker").body.base_in_map.x;
  world.advance_to(1.9, {});
  EXPECT_DOUBLE_EQ(find(world, "walker").body.base_in_map.x, start);
  world.advance_to(3.0, {});
  EXPECT_GT(find(world, "walker").body.base_in_map.x, start + 0.8);
}

TEST(World, NothingAppearsOnTopOfAVehicle) {
  World world(yard(), one_person(), 1, nullptr);
  world.advance_to(3.5, {vehicle_at(5.5, 5.0)});
  EXPECT_THAT(ids(world), UnorderedElementsAre("walker"));
  world.advance_to(3.6, {vehicle_at(7.5, 5.0)});
  EXPECT_THAT(ids(world), UnorderedElementsAre("walker", "box"));
  world.advance_to(3.7, {vehicle_at(5.5, 5.0)});
  EXPECT_THAT(ids(world), UnorderedElementsAre("walker", "box")) << "what is there stays";
}

/// Two walkers whose ways cross at (5, 0) at the same second, and the least distance between them in 20 s.
double least_distance_of_two_m(std::vector<geometry::Point2> first, std::vector<geometry::Point2> second) {
  scenario::Scenario scenario;
  for (std::vector<geometry::Point2>* way : {&first, &second}) {
    scenario::Mover mover;
    mover.id = "walker-" + std::to_string(scenario.movers.size() + 1);
    mover.speed_mps = 1.0;
    mover.loop = false;
    mover.courteous = false;
    mover.waypoints_in_map = *way;
    scenario.movers.push_back(mover);
  }

  World world(scenario, {}, 1, nullptr);
  double least_m = 100.0;
  for (double t_s = 0.1; t_s < 20.0; t_s += 0.1) {
    world.advance_to(t_s, {});
    least_m = std::min(least_m, geometry::distance(find(world, "walker-1").body.base_in_map.position(),
                                                   find(world, "walker-2").body.base_in_map.position()));
  }

  return least_m;
}

TEST(World, NoPersonWalksThroughAnother) {
  EXPECT_GE(least_distance_of_two_m({{0, 0}, {10, 0}}, {{5, -5}, {5, 5}}), 0.5) << "ways that cross";
  EXPECT_GE(least_distance_of_two_m({{0, 0}, {10, 0}}, {{10, 0}, {0, 0}}), 0.5) << "head on";
  EXPECT_GE(least_distance_of_two_m({{0, 0}, {5, 0}}, {{-5, 0}, {10, 0}}), 0.5) << "the first one stands at its end";
}

TEST(World, WalkersLetRecordedPeoplePass) {
  scenario::Scenario scenario = yard();
  scenario.movers[0].start_s = 0.0;
  scenario.movers[0].loop = false;
  std::vector<std::vector<RecordedPerson>> people(1);
  people[0].emplace_back("person-1", std::vector<RecordedPerson::Row>{{10.0, {2, -2}}, {14.0, {2, 2}}});

  World world(scenario, people, 1, nullptr);
  for (double t_s = 0.1; t_s < 3.9; t_s += 0.1) {
    world.advance_to(t_s, {});
    EXPECT_GE(geometry::distance(find(world, "walker").body.base_in_map.position(),
                                 find(world, "person-1").body.base_in_map.position()),
              0.5);
  }
}

TEST(World, TheSameSeedIsTheSameRun) {
  const auto place = [](std::uint64_t seed) {
    World world(yard(), one_person(), seed, nullptr);
    world.advance_to(7.0, {});
    return find(world, "walker").body.base_in_map.x;
  };
  EXPECT_DOUBLE_EQ(place(1), place(1));
  EXPECT_NE(place(1), place(2));
}

TEST(World, GoesOnWhereItWasAfterARestart) {
  World world(yard(), one_person(), 3, nullptr);
  world.advance_to(6.0, {});
  const Memory memory = world.memory();
  World again(yard(), one_person(), 3, &memory);
  world.advance_to(9.0, {vehicle_at(5.5, 5.0)});
  again.advance_to(9.0, {vehicle_at(5.5, 5.0)});
  EXPECT_THAT(ids(again), UnorderedElementsAre("walker", "box"));
  EXPECT_NEAR(find(world, "walker").body.base_in_map.x, find(again, "walker").body.base_in_map.x, 1e-9);
}

}  // namespace
}  // namespace aisle::fake_world
