// Where every speed is refused: slower, a finer look, a turn, a step back; each told in the status, and in this order.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/unit/local-planner/drive.hpp"
#include "tests/unit/local-planner/hall.hpp"

namespace aisle::local_planner {
namespace {

/// Details in the order in which they first came.
std::vector<std::string> details_of(Drive& drive, double seconds, const SeenTrack& in_the_way) {
  std::vector<std::string> details;
  drive.until(seconds, [&] {
    drive.inputs.tracks = {in_the_way};
    drive.inputs.tracks.front().arrived = drive.now;
    if (std::find(details.begin(), details.end(), drive.output.detail) == details.end())
      details.push_back(drive.output.detail);
    return false;
  });
  return details;
}

std::ptrdiff_t place_of(const std::vector<std::string>& details, const std::string& detail) {
  const auto found = std::find(details.begin(), details.end(), detail);
  return found == details.end() ? -1 : std::distance(details.begin(), found);
}

TEST(Recovery, TellsEachGradeInItsOrder) {
  Drive drive(aisle(1.4));
  drive.give_plan({{3.0, 5.0}, {17.0, 5.0}});
  ASSERT_TRUE(drive.until(5.0, [&] { return drive.base.x > 6.0; }));
  // Somebody who treads on the spot: no thing that stands, so there is no detour, and no way past.
  const std::vector<std::string> details =
      details_of(drive, 20.0, drive.track({drive.base.x + 1.6, 5.0}, {-0.3, 0.0}, false));
  std::string all;
  for (const std::string& detail : details) all += "'" + detail + "' ";
  const std::ptrdiff_t slower = place_of(details, "recovers: slower");
  const std::ptrdiff_t turns = place_of(details, "recovers: turns to where there is room");
  const std::ptrdiff_t back = place_of(details, "recovers: backs off");
  EXPECT_GE(slower, 0) << all;
  EXPECT_GT(turns, slower) << all;
  EXPECT_GT(back, turns) << all;
  EXPECT_EQ(place_of(details, "recovers: looks finer"), -1) << "before people it waits";
}

/// One after the other, each across the way and on.
TEST(Recovery, LetsPeoplePassInsteadOfBackingOff) {
  Drive drive(hall(20.0, 10.0));
  drive.give_plan({{3.0, 5.0}, {17.0, 5.0}});
  ASSERT_TRUE(drive.until(5.0, [&] { return drive.base.x > 6.0; }));
  const double x_m = drive.base.x + 1.3;
  double t_s = 0.0;
  double refused_s = 0.0;
  EXPECT_FALSE(drive.until(9.5, [&] {
    t_s += 0.02;
    drive.inputs.tracks.clear();
    for (int i = 0; i < 60; ++i) {
      const double y_m = 5.0 + t_s - 0.6 * i + 1.0;
      if (std::abs(y_m - 5.0) < 2.0)
        drive.inputs.tracks.push_back(drive.track({x_m, y_m}, {0.0, 1.0}, false)),
            drive.inputs.tracks.back().track.id = static_cast<std::uint64_t>(i + 1);
    }
    refused_s += drive.output.detail.find("recovers") != std::string::npos ? 0.02 : 0.0;
    return drive.output.detail == "recovers: backs off";
  })) << t_s;
  EXPECT_GT(refused_s, 6.5) << "they were not in the way";
}

TEST(Recovery, LooksFinerBetweenWallsWhereFewArcsLeadIn) {
  Settings coarse;
  coarse.dwa.linear_samples = 2;
  coarse.dwa.angular_samples = 3;
  for (const double yaw_rad : {0.2, 0.3, 0.4, 0.5}) {
    Drive drive(aisle(0.95), {3.0, 5.0, yaw_rad});
    drive.planner = make_planner(coarse, wang());
    drive.give_plan({{3.0, 5.0}, {17.0, 5.0}});
    bool finer = false;
    const bool arrived = drive.until(40.0, [&] {
      finer |= drive.output.detail == "recovers: looks finer";
      EXPECT_NE(drive.output.detail, "recovers: turns to where there is room") << yaw_rad;
      return drive.output.phase == Phase::kArrived;
    });
    EXPECT_TRUE(arrived && finer) << yaw_rad;
  }
}

TEST(Recovery, IsNotToldWhileTheWayIsFree) {
  Drive drive(aisle(2.0));
  drive.give_plan({{3.0, 5.0}, {17.0, 5.0}});
  EXPECT_FALSE(drive.until(40.0, [&] { return drive.output.detail.find("recovers") != std::string::npos; }));
  EXPECT_EQ(drive.output.phase, Phase::kArrived);
}

TEST(Recovery, SaysWhatIsAvoided) {
  Drive drive(hall(20.0, 10.0));
  drive.give_plan({{3.0, 5.0}, {17.0, 5.0}});
  ASSERT_TRUE(drive.until(5.0, [&] { return drive.base.x > 5.0; }));
  const geometry::Point2 ahead{drive.base.x + 3.0, drive.base.y};
  const bool told = drive.until(6.0, [&] {
    drive.inputs.tracks = {drive.track(ahead, {}, true)};
    return drive.output.detail == "avoids what is standing";
  });
  EXPECT_TRUE(told);
}

TEST(Recovery, ASubTargetInsideAThingIsTakenElsewhere) {
  Drive drive(aisle(4.0));
  drive.give_plan({{3.0, 5.0}, {17.0, 5.0}});
  drive.inputs.tracks = {drive.track({8.0, 4.3}, {}, true),
                         drive.track({8.0, 4.8}, {}, true)};  // on the lane, and where it would be looked at
  const bool arrived = drive.until(40.0, [&] {
    for (SeenTrack& seen : drive.inputs.tracks) {
      seen.arrived = drive.now;
      EXPECT_GT(geometry::distance(seen.track.position_in_map, drive.base.position()), 0.35 + 0.25);
    }
    return drive.output.phase == Phase::kArrived;
  });
  EXPECT_TRUE(arrived);
}

/// Aisles of 1 m that meet at a corner, at (7, 5): in from below at x = 6.5, out to the right at y = 5.5.
grid::OccupancyGrid corner() {
  grid::OccupancyGrid grid = hall(14.0, 10.0);
  block(grid, 0.0, 0.0, 6.0, 10.0);
  block(grid, 6.0, 6.0, 14.0, 10.0);
  block(grid, 7.0, 0.0, 14.0, 5.0);
  return grid;
}

TEST(Recovery, GetsAwayFromACornerThatItCutTooNearly) {
  for (const double yaw : {0.5, 0.7, 0.3}) {
    Drive drive(corner(), {6.70, 5.24, yaw});  // 0.03 m from the corner, less than the margin; straight on leads nearer
    drive.give_plan({{6.5, 2.0}, {6.5, 5.3}, {6.7, 5.5}, {12.0, 5.5}});
    EXPECT_TRUE(drive.until(15.0, Phase::kArrived))
        << "heading " << yaw << ": stands at " << drive.base.x << ", " << drive.base.y;
  }
}

}  // namespace
}  // namespace aisle::local_planner
