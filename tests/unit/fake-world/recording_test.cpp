#include "services/fake-world/core/recording.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "common/config/reader.hpp"

namespace aisle::fake_world {
namespace {

namespace fs = std::filesystem;

class ReadRecording : public ::testing::Test {
 protected:
  ~ReadRecording() override { fs::remove(recording_.file); }
  std::vector<RecordedPerson> read(const std::string& text) {
    recording_.file = fs::temp_directory_path() / ("walkers-" + std::to_string(getpid()) + ".txt");
    std::ofstream(recording_.file) << text;
    return read_recording(recording_);
  }
  scenario::Recording recording_;
};

TEST_F(ReadRecording, FramesAreTimedByTheFilm) {
  recording_.frames_per_s = 10.0;
  const std::vector<RecordedPerson> people = read("0 1 0 0\n10 1 1 0\n20 1 2 0\n");
  ASSERT_EQ(people.size(), 1u);
  const auto later = people[0].at(1.5);
  ASSERT_TRUE(later.has_value());
  EXPECT_NEAR(later->position_in_map.x, 1.5, 1e-9);
  EXPECT_NEAR(later->velocity_in_map.x, 1.0, 1e-9);
}

TEST_F(ReadRecording, APersonExistsFromFirstToLastRowAndWalksStraightBetween) {
  const std::vector<RecordedPerson> people = read("780\t1.0\t0.0\t0.0\n790 1.0 1.0 2.0\n800 1.0 1.0 2.0\n");
  ASSERT_EQ(people.size(), 1u);
  EXPECT_EQ(people[0].id(), recording_.file.stem().string() + "-1");
  const auto half = people[0].at(0.2);
  ASSERT_TRUE(half.has_value());
  EXPECT_NEAR(half->position_in_map.x, 0.5, 1e-9);
  EXPECT_NEAR(half->position_in_map.y, 1.0, 1e-9);
  EXPECT_NEAR(half->velocity_in_map.x, 2.5, 1e-9);
  EXPECT_TRUE(people[0].at(0.8).has_value());
  EXPECT_FALSE(people[0].at(-0.01).has_value());
  EXPECT_FALSE(people[0].at(0.81).has_value());
}

TEST_F(ReadRecording, StandsInTheMapByTheRecordingsPose) {
  recording_.frame_in_map = {10.0, 5.0, geometry::kPi / 2.0};
  const std::vector<RecordedPerson> people = read("0 1 2.0 1.0\n10 1 3.0 1.0\n");
  const auto motion = people.at(0).at(0.0);
  EXPECT_NEAR(motion->position_in_map.x, 9.0, 1e-9);
  EXPECT_NEAR(motion->position_in_map.y, 7.0, 1e-9);
  EXPECT_NEAR(motion->velocity_in_map.y, 2.5, 1e-9);
}

TEST_F(ReadRecording, LeavesOutWhoIsThereOnlyOutsideTheWindow) {
  recording_.begin_s = 1.0;
  recording_.end_s = 2.0;
  const std::vector<RecordedPerson> people = read("0 1 0 0\n10 1 0 0\n30 2 0 0\n40 2 0 0\n75 3 0 0\n85 3 0 0\n");
  ASSERT_EQ(people.size(), 1u);
  EXPECT_THAT(people[0].id(), ::testing::EndsWith("-2"));
}

TEST_F(ReadRecording, NamesTheLineThatIsNoRow) {
  try {
    read("0 1 0 0\n10 1 zero 0\n");
    FAIL();
  } catch (const config::BadInput& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr(".txt:2:"));
  }
  EXPECT_THROW(read(""), config::BadInput);
  EXPECT_THROW(read("0 1 1e400 0\n"), config::BadInput);
}

}  // namespace
}  // namespace aisle::fake_world
