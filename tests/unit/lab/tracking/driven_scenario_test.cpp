// A scenario file as a scene for trackers: vehicles as the simulated site drives them.
#include <gtest/gtest.h>

#include "tests/support/places.hpp"
#include "tools/lab/tracking/scene.hpp"
#include "tools/sim/scenarios/families.hpp"

namespace aisle::tracking {
namespace {

const std::filesystem::path kFile = test_support::source_folder() / "deploy/scenarios/around-the-corner.yaml";

TEST(DrivenScenario, VehiclesLeaveTheirStartsAndReachTheirGoals) {
  const sim::Setup setup = sim::read_setup(kFile, 1);
  const std::unique_ptr<Scene> scene = driven_scenario(kFile, 1, 1);
  EXPECT_EQ(scene->vehicles(), 1u) << "as many as have eyes";
  ASSERT_GT(scene->duration_s(), 5.0);

  const Moment begin = scene->at(0.0);
  ASSERT_EQ(begin.vehicles.size(), setup.scenario.vehicles.size());
  EXPECT_LT(geometry::distance(begin.vehicles.front().base_in_map.position(),
                               setup.scenario.vehicles.front().start_in_map.position()),
            0.5);
  const Moment end = scene->at(scene->duration_s());
  EXPECT_LT(geometry::distance(end.vehicles.front().base_in_map.position(),
                               setup.scenario.missions.front().goals_in_map.back().position()),
            0.4);
  EXPECT_FALSE(end.people.empty());
}

TEST(DrivenScenario, MayBeDrivenWithoutItsPeople) {
  const std::unique_ptr<Scene> scene = driven_scenario(kFile, 0, 1, Cast::kVehiclesOnly);
  EXPECT_EQ(scene->vehicles(), sim::read_setup(kFile, 1).scenario.vehicles.size());
  EXPECT_TRUE(scene->at(5.0).people.empty());
}

}  // namespace
}  // namespace aisle::tracking
