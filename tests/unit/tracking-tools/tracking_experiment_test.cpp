// The section of docs/experiments.md on the tracker, on a few seconds of everything.
#include "tools/aisle/tracking/tracking_experiment.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "common/config/reader.hpp"
#include "common/scenario/data_path.hpp"

namespace aisle::cli {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class TrackingSection : public ::testing::Test {
 protected:
  TrackingSection() {
    orders_.empty_place = fs::path(AISLE_SOURCE_DIR) / "deploy/scenarios/crossing.yaml";
    orders_.pictures = fs::temp_directory_path() / ("aisle-tracking-" + std::to_string(::getpid()));
    orders_.pictures_from_page = "pictures";
    orders_.longest_s = 5.0;
    orders_.empty_s = 1.0;
    fs::create_directories(orders_.pictures);
  }
  ~TrackingSection() override { fs::remove_all(orders_.pictures); }
  TrackingExperiment orders_;
};

TEST_F(TrackingSection, SaysThatTheRecordingsAreNotThere) {
  orders_.people = orders_.pictures / "nowhere";
  EXPECT_THAT(tracking_section(orders_, [](const std::string&) {}), HasSubstr("the recordings are not there"));
}

TEST_F(TrackingSection, HasARowForEveryRecordingAndFleetAndNoise) {
  try {
    orders_.people = scenario::find_named_file("data:pedestrians/biwi_eth.txt", orders_.empty_place).parent_path();
  } catch (const config::BadInput&) {
    GTEST_SKIP() << "no reference data here";
  }
  const std::string section = tracking_section(orders_, [](const std::string&) {});
  for (const char* row : {"| biwi_eth, standing | aisle |", "| crowds_zara01, driving | nearest-neighbour |", "| biwi_hotel | 4 |", "| 5 cm, 1 degree |"}) {
    EXPECT_THAT(section, HasSubstr(row));
  }
  EXPECT_TRUE(fs::exists(orders_.pictures / "tracking-biwi_hotel.svg"));
  EXPECT_EQ(section, tracking_section(orders_, [](const std::string&) {})) << "the same orders, the same text";
}

}  // namespace
}  // namespace aisle::cli
