// Closed loop, on the simulated site, of vehicles that are no differential discs.
#include <gtest/gtest.h>

#include <string>

#include "tests/support/places.hpp"
#include "tools/sim/scenarios/families.hpp"
#include "tools/sim/site.hpp"

namespace aisle::sim {
namespace {

void expect_good(const Setup& setup) {
  const Result result = drive(setup).result;
  std::string log;
  for (const std::string& line : result.log) log += line + "\n";
  EXPECT_GT(result.goals_assigned, 0);
  EXPECT_EQ(result.goals_reached, result.goals_assigned) << log;
  EXPECT_EQ(result.contacts, 0) << log;
  EXPECT_GT(result.least_clearance_m, 0.0);
}

Setup deployed(const std::string& name) {
  return read_setup(test_support::source_folder().string() + "/deploy/scenarios/" + name + ".yaml", 1);
}

TEST(Vehicles, AForkliftCompletesTheWarehouseWithoutContact) { expect_good(deployed("forklift-warehouse")); }

TEST(Vehicles, OmnidirectionalOnesCrossWithoutContact) {
  sim::Setup crossing = make_setup("crossing", 2);
  for (scenario::Vehicle& vehicle : crossing.scenario.vehicles) vehicle.model = "omnidirectional";
  expect_good(crossing);
}

}  // namespace
}  // namespace aisle::sim
