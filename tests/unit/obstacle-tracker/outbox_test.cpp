#include "services/obstacle-tracker/core/outbox.hpp"

#include <gtest/gtest.h>

namespace aisle::obstacle_tracker::test {
namespace {

using namespace std::chrono_literals;

Track track(std::uint64_t id, bool is_static) {
  Track track;
  track.id = id;
  track.is_static = is_static;
  return track;
}

TEST(Outbox, SendsAMoverWithEachScanThatMeasuredIt) {
  Outbox outbox;
  EXPECT_EQ(outbox.due({track(1, false)}, {1}, 0ms).size(), 1U);
  EXPECT_EQ(outbox.due({track(1, false)}, {1}, 20ms).size(), 1U);
  EXPECT_EQ(outbox.due({track(1, false)}, {}, 40ms).size(), 0U);
  EXPECT_EQ(outbox.due({track(1, false)}, {}, 120ms).size(), 1U);
}

TEST(Outbox, RepeatsAStaticTrackTwiceASecond) {
  Outbox outbox;
  int sent = 0;
  for (int k = 0; k < 100; ++k) sent += static_cast<int>(outbox.due({track(1, true)}, {1}, k * 100ms).size());
  EXPECT_EQ(sent, 20);
}

TEST(Outbox, SendsAStaticTrackAtOnceWhenItChanges) {
  Outbox outbox;
  Track block = track(1, false);
  EXPECT_EQ(outbox.due({block}, {1}, 0ms).size(), 1U);
  block.is_static = true;
  EXPECT_EQ(outbox.due({block}, {}, 10ms).size(), 1U);
  block.radius_m += 0.2;
  EXPECT_EQ(outbox.due({block}, {}, 20ms).size(), 1U);
  block.position_in_map.x += 0.1;
  EXPECT_EQ(outbox.due({block}, {}, 30ms).size(), 1U);
  EXPECT_EQ(outbox.due({block}, {}, 40ms).size(), 0U);
  outbox.forget(1);
  EXPECT_EQ(outbox.due({block}, {}, 50ms).size(), 1U);
}

}  // namespace
}  // namespace aisle::obstacle_tracker::test
