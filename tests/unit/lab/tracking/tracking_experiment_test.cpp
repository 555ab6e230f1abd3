// The section of docs/experiments.md on the tracker, on a few seconds of everything.
#include "tools/lab/tracking/tracking_experiment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <vector>

#include "common/config/reader.hpp"
#include "common/scenario/data_path.hpp"
#include "tests/support/places.hpp"
#include "tools/sim/scenarios/families.hpp"
#include "tools/sim/site.hpp"

namespace aisle::lab {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class TrackingSection : public ::testing::Test {
 protected:
  TrackingSection() {
    orders_.empty_place = test_support::source_folder() / "deploy/scenarios/crossing.yaml";
    orders_.pictures = fs::temp_directory_path() / ("aisle-tracking-" + std::to_string(::getpid()));
    orders_.pictures_from_page = "pictures";
    orders_.longest_s = 5.0;
    orders_.empty_s = 1.0;
    orders_.detour_seeds = 0;
    fs::create_directories(orders_.pictures);
  }
  ~TrackingSection() override { fs::remove_all(orders_.pictures); }
  TrackingExperiment orders_;
};

TEST_F(TrackingSection, SaysThatTheRecordingsAreNotThere) {
  orders_.people = orders_.pictures / "nowhere";
  EXPECT_THAT(tracking_section(orders_, [](const std::string&) {}).text, HasSubstr("the recordings are not there"));
}

TEST_F(TrackingSection, HasARowForEveryRecordingAndFleetAndNoise) {
  try {
    orders_.people = scenario::find_named_file("data:pedestrians/biwi_eth.txt", orders_.empty_place).parent_path();
  } catch (const config::BadInput&) {
    GTEST_SKIP() << "no reference data here";
  }
  const std::string section = tracking_section(orders_, [](const std::string&) {}).text;
  for (const char* row :
       {"| biwi_eth, standing | constant-velocity |", "| biwi_eth at 15 frames a second, driving | interacting-mix |",
        "| crowds_zara01, driving | nearest-neighbour |", "| biwi_hotel | 4 |", "| 5 cm, 1 degree |"}) {
    EXPECT_THAT(section, HasSubstr(row));
  }
  EXPECT_TRUE(fs::exists(orders_.pictures / "tracking-biwi_hotel.svg"));
  EXPECT_EQ(section, tracking_section(orders_, [](const std::string&) {}).text) << "the same orders, the same text";
}

TEST(DetourTable, ComparesThePredictedWithTheHeldStill) {
  std::vector<sim::Result> results;
  for (const sim::Perception perception : {sim::Perception::kScans, sim::Perception::kScansHeldStill}) {
    sim::Setup setup = sim::make_setup("person-crossing", 1);
    setup.perception = perception;
    bool anybody_moves = false;
    sim::Hooks hooks;
    hooks.watch = [&](const sim::Snapshot& now) {
      for (const fleet::Track& track : now.tracks)
        anybody_moves = anybody_moves || geometry::norm(track.velocity_in_map) > 0.2;
    };
    results.push_back(sim::drive(setup, {}, hooks).result);
    EXPECT_EQ(anybody_moves, perception == sim::Perception::kScans);
  }
  EXPECT_NE(results[0].trace_hash, results[1].trace_hash);
}

}  // namespace
}  // namespace aisle::lab
