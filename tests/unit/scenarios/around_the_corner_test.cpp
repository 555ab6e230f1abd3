// What deploy/scenarios/around-the-corner.yaml promises, on the simulated site; tests/e2e proves it over DDS.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>

#include "common/geometry/body.hpp"
#include "tests/support/places.hpp"
#include "tools/sim/scenarios/families.hpp"
#include "tools/sim/site.hpp"

namespace aisle::sim {
namespace {

struct Pass {
  Result result;
  double person_clearance_m{1e9};  // the least between agv-1 and the person
};

/// `later_s`: how much later than the scenario says agv-1 comes to the corner, seen from the person.
Pass pass_the_corner(const std::string& only_scans_of, double later_s, double& asked_m) {
  Setup setup = read_setup(test_support::source_folder() / "deploy/scenarios/around-the-corner.yaml", 1);
  setup.only_scans_of = only_scans_of;
  setup.scenario.movers.front().start_s -= later_s;
  asked_m = setup.scenario.person_clearance_m;
  Pass pass;
  Hooks hooks;
  hooks.watch = [&](const Snapshot& now) {
    for (const geometry::Body& person : now.things) {
      const double gap_m = geometry::distance_m(person, now.vehicles_in_map.front().position()) -
                           setup.scenario.vehicles.front().radius_m;
      pass.person_clearance_m = std::min(pass.person_clearance_m, gap_m);
    }
  };
  pass.result = drive(setup, {}, hooks).result;
  return pass;
}

class AroundTheCorner : public ::testing::TestWithParam<double> {};

TEST_P(AroundTheCorner, IsDrivenClearOfThePersonWithWhatBothVehiclesSee) {
  double asked_m = 0.0;
  const Pass pass = pass_the_corner("", GetParam(), asked_m);
  EXPECT_EQ(pass.result.goals_reached, pass.result.goals_assigned);
  EXPECT_EQ(pass.result.contacts, 0);
  ASSERT_GT(asked_m, 0.0);
  EXPECT_GT(pass.person_clearance_m, asked_m);
}

TEST_P(AroundTheCorner, MeetsThePersonTooLateWithWhatOneVehicleSees) {
  double asked_m = 0.0;
  const Pass pass = pass_the_corner("agv-1", GetParam(), asked_m);
  EXPECT_LT(pass.person_clearance_m, asked_m) << "the scenario does not need what agv-2 sees";
}

// Over DDS a vehicle starts some tenths of a second earlier or later than another time.
INSTANTIATE_TEST_SUITE_P(HoweverLate, AroundTheCorner, ::testing::Values(-0.3, 0.0, 0.3, 0.6));

}  // namespace
}  // namespace aisle::sim
