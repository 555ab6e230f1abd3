#include "tools/lab/papers/drive_measurements.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace aisle::lab {
namespace {

void silent(const std::string&) {}

TEST(DriveMeasurements, AreTheSameForOneAndTwoThreads) {
  std::vector<std::string> told;
  DriveMeasurements alone({3, 1, 1}, silent);
  DriveMeasurements together({3, 1, 2}, [&](const std::string& line) { told.push_back(line); });
  const std::vector<DriveOutcome>& a = alone.of("wang-map-1", "improved");
  const std::vector<DriveOutcome>& b = together.of("wang-map-1", "improved");
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(a[i].arrived, b[i].arrived);
    EXPECT_EQ(a[i].met_what_is_there, b[i].met_what_is_there);
    EXPECT_EQ(a[i].figures, b[i].figures) << "map " << i;
  }
  ASSERT_EQ(told.size(), 3U);
  EXPECT_EQ(told.back(), "driving wang-map-1, improved: 3 of 3");
}

// QU, figures 6 and 7.
TEST(DriveMeasurements, ABlindDriveAlongThePathCollidesWithMovers) {
  DriveMeasurements measured({30, 1, 1}, silent);
  const std::vector<DriveOutcome>& blind = measured.of("qu-1-two", "improved-blind");
  ASSERT_EQ(blind.size(), 30U);
  const auto touched = std::count_if(blind.begin(), blind.end(), [](const auto& drive) { return drive.touched; });
  EXPECT_GT(touched, 0);
  for (const DriveOutcome& drive : blind) EXPECT_EQ(drive.figures.at(DriveFigure::kTouches), drive.touched ? 1.0 : 0.0);
}

}  // namespace
}  // namespace aisle::lab
