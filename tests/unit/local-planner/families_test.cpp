// Closed loop, on the simulated site: the services' own cores from simulated scans to wheels. No moving vehicle touches
// anything, every goal is reached.
#include "tools/sim/scenarios/families.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "common/config/reader.hpp"
#include "tools/sim/site.hpp"

namespace aisle::sim {
namespace {

class Family : public ::testing::TestWithParam<const char*> {};

TEST_P(Family, ReachesEveryGoalAndTouchesNothing) {
  for (std::uint64_t seed = 1; seed <= 2; ++seed) {
    const Result result = drive(make_setup(GetParam(), seed)).result;
    std::string log;
    for (const std::string& line : result.log) log += line + "\n";
    EXPECT_GT(result.goals_assigned, 0);
    EXPECT_EQ(result.goals_reached, result.goals_assigned) << "seed " << seed << "\n" << log;
    EXPECT_EQ(result.contacts_moving_vehicle, 0) << "seed " << seed << "\n" << log;
    EXPECT_GT(result.least_clearance_m, 0.0) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(All, Family, ::testing::Values("crossing", "head-on-wide", "t-junction", "walkers"),
                         [](const auto& family) {
                           std::string name = family.param;
                           for (char& c : name) c = c == '-' ? '_' : c;
                           return name;
                         });

TEST(Families, TheSameSeedGivesTheSameTrace) {
  const Result once = drive(make_setup("crossing", 3)).result;
  const Result again = drive(make_setup("crossing", 3)).result;
  const Result other = drive(make_setup("crossing", 4)).result;
  EXPECT_EQ(once.trace_hash, again.trace_hash);
  EXPECT_NE(once.trace_hash, other.trace_hash);
}

TEST(Families, SaysWhichFamiliesThereAre) {
  for (const auto setup_of : {&make_setup, &named_setup}) try {
      setup_of("crosing", 1);
      FAIL() << "a family that is not there";
    } catch (const config::BadInput& error) {
      for (const char* part : {"crosing", "did you mean 'crossing'", "t-junction"})
        EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
}

}  // namespace
}  // namespace aisle::sim
