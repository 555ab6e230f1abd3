#include "services/obstacle-tracker/core/scan_clock.hpp"

#include <gtest/gtest.h>

#include <random>

namespace aisle::obstacle_tracker::test {
namespace {

using namespace std::chrono_literals;
constexpr std::int64_t kWallNs = 1'790'000'000'000'000'000;  // the sender's clock when ours says 0

std::int64_t wall(time::Stamp mine) { return kWallNs + mine.count(); }

TEST(ScanClock, TakesOutTheJitterOfTheWay) {
  ScanClock clock;
  std::mt19937 random(1);
  std::exponential_distribution<double> delay_s(1.0 / 0.010);
  for (int k = 0; k < 200; ++k) {
    const time::Stamp measured = 100s + k * 100ms;
    const auto placed = clock.place(wall(measured), measured + 300us + time::from_seconds(delay_s(random)));
    ASSERT_TRUE(std::holds_alternative<time::Stamp>(placed));
    if (k > 50) {
      EXPECT_LT(std::chrono::abs(std::get<time::Stamp>(placed) - measured), 5ms) << k;
    }
  }
}

TEST(ScanClock, RefusesStampsThatDoNotRise) {
  ScanClock clock;
  EXPECT_TRUE(std::holds_alternative<time::Stamp>(clock.place(wall(1s), 1s)));
  EXPECT_EQ(std::get<DropReason>(clock.place(wall(1s), 1100ms)), DropReason::kNotNewer);
  EXPECT_EQ(std::get<DropReason>(clock.place(wall(900ms), 1200ms)), DropReason::kNotNewer);
}

TEST(ScanClock, RefusesAStampFromTheFutureOrThePastAndGoesOn) {
  ScanClock clock;
  EXPECT_TRUE(std::holds_alternative<time::Stamp>(clock.place(wall(1s), 1s)));
  EXPECT_EQ(std::get<DropReason>(clock.place(wall(1h), 1100ms)), DropReason::kFuture);
  EXPECT_EQ(std::get<DropReason>(clock.place(wall(-1h), 1200ms)), DropReason::kTooOld);
  EXPECT_EQ(std::get<time::Stamp>(clock.place(wall(1300ms), 1300ms)), 1300ms);
}

TEST(ScanClock, FollowsAClockThatWasSetAfterThreeScans) {
  for (const time::Stamp jump : {time::Stamp{1h}, time::Stamp{-1h}}) {
    ScanClock clock;
    int refused = 0;
    for (int k = 0; k < 20; ++k) {
      const time::Stamp now = 1s + k * 100ms;
      const auto placed = clock.place(wall(now) + (k >= 10 ? jump.count() : 0), now);
      refused += std::holds_alternative<DropReason>(placed) ? 1 : 0;
      if (k == 19) {
        EXPECT_EQ(std::get<time::Stamp>(placed), now);
      }
    }
    EXPECT_EQ(refused, 2);
  }
}

TEST(ScanClock, NeverSaysLaterThanTheArrival) {
  ScanClock clock;
  EXPECT_EQ(std::get<time::Stamp>(clock.place(wall(1s), 1s + 5ms)), 1s + 5ms);
  EXPECT_EQ(std::get<time::Stamp>(clock.place(wall(1100ms), 1100ms)), 1100ms);  // a faster way: the line moves
  EXPECT_EQ(std::get<time::Stamp>(clock.place(wall(1200ms), 1205ms)), 1200ms);
}

}  // namespace
}  // namespace aisle::obstacle_tracker::test
