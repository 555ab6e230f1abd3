#include "common/bus/timers.hpp"

#include <gmock/gmock.h>

#include <chrono>
#include <vector>

namespace aisle::bus {
namespace {

using namespace std::chrono_literals;
using testing::ElementsAre;

/// The instants at which a loop would wake for these timers until `end`.
std::vector<time::Stamp> wake_ups(Timers& timers, time::Stamp end) {
  std::vector<time::Stamp> instants;

  while (timers.next() && *timers.next() <= end) {
    instants.push_back(*timers.next());
    timers.handle(*timers.next());
  }

  return instants;
}

TEST(Timers, ALateLoopSkipsTicksAndKeepsTheGrid) {
  Timers timers;
  int ticks = 0;
  timers.add(20ms, 0ms, [&ticks] { ++ticks; });

  EXPECT_FALSE(timers.handle(19ms));
  EXPECT_TRUE(timers.handle(75ms));
  EXPECT_EQ(ticks, 1);
  EXPECT_EQ(timers.next(), 80ms);
}

TEST(Timers, OfOnePeriodTickTogether) {
  Timers timers;
  int first = 0, second = 0, third = 0;
  timers.add(20ms, 0ms, [&first] { ++first; });
  timers.add(20ms, 3ms, [&second] { ++second; });
  wake_ups(timers, 60ms);
  timers.add(20ms, 67ms, [&third] { ++third; });

  EXPECT_THAT(wake_ups(timers, 140ms), ElementsAre(80ms, 100ms, 120ms, 140ms));
  EXPECT_EQ(first, 7);
  EXPECT_EQ(second, 6);
  EXPECT_EQ(third, 3) << "never sooner than a period after it was added";
}

TEST(Timers, OfOtherPeriodsKeepTheirOwnGrid) {
  Timers timers;
  timers.add(20ms, 0ms, [] {});
  timers.add(30ms, 5ms, [] {});

  EXPECT_THAT(wake_ups(timers, 65ms), ElementsAre(20ms, 35ms, 40ms, 60ms, 65ms));
}

}  // namespace
}  // namespace aisle::bus
