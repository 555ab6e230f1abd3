// What deploy/scenarios/zones promise, on the simulated site: with its zones each run has no breach and reaches all
// goals; without them the breach happens, as the referee's watch sees in the trace.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/places.hpp"
#include "tools/referee/core/zone_watch.hpp"
#include "tools/sim/scenarios/families.hpp"
#include "tools/sim/site.hpp"

namespace aisle::sim {
namespace {

Setup setup_of(const std::string& name) {
  return read_setup(test_support::source_folder() / "deploy/scenarios/zones" / (name + ".yaml"), 1);
}

/// What a watch of these zones sees in the traces of a run.
std::vector<referee::AuthorityViolation> breaches(const referee::RunReport& report,
                                                  const std::vector<fleet::Zone>& zones) {
  std::vector<referee::BodySample> samples;
  for (const auto& [agv_id, row] : report.vehicles)
    for (const referee::DrivePoint& point : row.drive.trace())
      samples.push_back({agv_id, referee::BodyKind::kVehicle, row.shape, point.base_in_map, point.speed_mps, point.t_s,
                         1, row.ahead_m});
  std::stable_sort(samples.begin(), samples.end(),
                   [](const referee::BodySample& a, const referee::BodySample& b) { return a.t_s < b.t_s; });

  referee::ZoneWatch watch;
  watch.zones_seen(zones);
  for (const referee::BodySample& sample : samples) watch.body_seen(sample);
  return watch.violations();
}

/// Where the vehicle was at the end.
geometry::Point2 end_of(const Outcome& outcome, const std::string& agv_id) {
  return outcome.report.vehicles.at(agv_id).drive.base_in_map().position();
}

void expect_all_goals(const Outcome& outcome) {
  EXPECT_EQ(outcome.result.goals_reached, outcome.result.goals_assigned);
  EXPECT_EQ(outcome.result.contacts, 0);
}

class ZoneIsObeyed : public ::testing::TestWithParam<std::string> {};

TEST_P(ZoneIsObeyed, AndWithoutItTheBreachHappens) {
  sim::Setup setup = setup_of(GetParam());
  const std::vector<fleet::Zone> zones = setup.scenario.zones;
  ASSERT_EQ(zones.size(), 1u);
  ASSERT_EQ(fleet::name(zones.front().kind), GetParam());

  const Outcome with = drive(setup);
  expect_all_goals(with);
  EXPECT_TRUE(with.report.passed());
  for (const auto& violation : with.report.violations) ADD_FAILURE() << violation.agv_id << " " << violation.text;

  setup.scenario.zones.clear();
  const Outcome without = drive(setup);
  expect_all_goals(without);
  EXPECT_TRUE(without.report.violations.empty());
  EXPECT_FALSE(breaches(without.report, zones).empty()) << "the scenario does not need its zone";
}

INSTANTIATE_TEST_SUITE_P(OfEachKind, ZoneIsObeyed,
                         ::testing::Values("keep-out", "speed", "one-way", "no-stopping", "one-vehicle"),
                         [](const auto& kind) {
                           std::string name = kind.param;
                           name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
                           return name;
                         });

TEST(Parking, AVehicleThatMakesWayRestsThereFirst) {
  sim::Setup setup = setup_of("parking");
  const fleet::Zone zone = setup.scenario.zones.front();
  const Outcome with = drive(setup);
  expect_all_goals(with);
  EXPECT_TRUE(fleet::contains(zone, end_of(with, "agv-2")));

  setup.scenario.zones.clear();
  const Outcome without = drive(setup);
  expect_all_goals(without);
  EXPECT_FALSE(fleet::contains(zone, end_of(without, "agv-2"))) << "the scenario does not need its zone";
}

}  // namespace
}  // namespace aisle::sim
