#include "tools/lab/driving/printed_table.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "tests/support/places.hpp"

namespace aisle::lab {
namespace {

TEST(PrintedCases, AreStaticAndDynamicOnesOfEveryPaper) {
  std::set<std::string> still, moving;
  for (const PrintedCase& of : printed_cases()) {
    if (!of.surprises.any()) still.insert(of.paper);
    if (of.surprises.movers > 0) moving.insert(of.paper);
  }
  const std::set<std::string> papers{"li", "wu", "qu", "yu", "wang"};
  EXPECT_EQ(still, papers);
  EXPECT_EQ(moving, papers);
}

// How it ends is a finding: the table says whether it touches or never arrives.
TEST(PrintedCases, DriveTheSameTwiceWithoutAnotherPlan) {
  const PrintedCase of{"wang", "wang-map-1", {1, 1}};
  const auto maps = test_support::source_folder() / "deploy/experiments";
  const sim::Result once = drive_as_printed(of, maps);
  EXPECT_GT(once.distance_m, 1.0);
  EXPECT_EQ(once.replans, 0) << "an unknown box is no reason for a new global plan";
  EXPECT_EQ(drive_as_printed(of, maps).trace_hash, once.trace_hash);
  EXPECT_NE(drive_as_printed({"wang", "wang-map-1", {0, 0}}, maps).trace_hash, once.trace_hash);
}

}  // namespace
}  // namespace aisle::lab
