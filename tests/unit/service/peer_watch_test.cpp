#include "common/service/peer_watch.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <vector>

namespace aisle::service {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::int64_t kWallNs = 1'800'000'000'000'000'000;

PeerHealth peer(const std::string& instance, std::uint64_t boot, std::int64_t wall_clock_ns = kWallNs) {
  return {instance, "host-b", 42, boot, 1, "0.1.0", wall_clock_ns, false};
}

TEST(PeerWatch, IgnoresItselfAndNamesAnotherProcessWithItsIdOnce) {
  PeerWatch watch("map", 100, 1);
  EXPECT_THAT(watch.take(peer("map", 100), seconds(1), kWallNs), IsEmpty());
  const std::vector<Finding> findings = watch.take(peer("map", 200), seconds(2), kWallNs);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].kind, Finding::Kind::kDuplicateInstance);
  EXPECT_EQ(findings[0].text,
            "instance id 'map' is used twice: also by process 42 on host host-b; give one of them another --instance");
  EXPECT_THAT(watch.take(peer("map", 200), seconds(3), kWallNs), IsEmpty());
}

TEST(PeerWatch, NamesAnotherProcessForItsVehicleOnce) {
  PeerWatch watch("driver-a", 100, 1, "fake-vehicle", "agv-1");
  PeerHealth other = peer("driver-b", 200);
  other.service = "fake-vehicle";
  other.agv_id = "agv-2";
  EXPECT_THAT(watch.take(other, seconds(1), kWallNs), IsEmpty());
  other = peer("driver-c", 201);
  other.service = "local-planner";
  other.agv_id = "agv-1";
  EXPECT_THAT(watch.take(other, seconds(1), kWallNs), IsEmpty());
  other = peer("driver-d", 202);
  other.service = "fake-vehicle";
  other.agv_id = "agv-1";
  const std::vector<Finding> findings = watch.take(other, seconds(1), kWallNs);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].kind, Finding::Kind::kDuplicateVehicle);
  EXPECT_EQ(
      findings[0].text,
      "'agv-1' has two processes of the service fake-vehicle: 'driver-d' (process 42 on host host-b) beside this one; "
      "stop one of them, or give it another vehicle's id");
  EXPECT_THAT(watch.take(other, seconds(2), kWallNs), IsEmpty());
}

TEST(PeerWatch, TheGoodbyeOfAProcessThatWasReplacedIsNoDuplicate) {
  PeerWatch watch("map", 100, 1);
  PeerHealth goodbye = peer("map", 50);
  goodbye.is_stopping = true;
  EXPECT_THAT(watch.take(goodbye, seconds(1), kWallNs), IsEmpty());
}

TEST(PeerWatch, AnObserverTellsARestartFromTwoAtOnce) {
  PeerWatch watch("", 0, 1);
  EXPECT_THAT(watch.take(peer("map", 100), seconds(1), kWallNs), IsEmpty());
  EXPECT_THAT(watch.take(peer("map", 200), seconds(2), kWallNs), IsEmpty());
  EXPECT_THAT(watch.take(peer("map", 100), seconds(2) + milliseconds(100), kWallNs), IsEmpty());  // was on its way
  const std::vector<Finding> findings = watch.take(peer("map", 100), seconds(3), kWallNs);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].kind, Finding::Kind::kDuplicateInstance);
}

TEST(PeerWatch, NamesAnotherIdlVersionOnceForEachStart) {
  PeerWatch watch("map", 100, 2);
  EXPECT_THAT(watch.take(peer("dispatcher", 7), seconds(1), kWallNs), SizeIs(1));
  EXPECT_THAT(watch.take(peer("dispatcher", 7), seconds(2), kWallNs), IsEmpty());
  const std::vector<Finding> findings = watch.take(peer("dispatcher", 8), seconds(3), kWallNs);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_THAT(findings[0].text, HasSubstr("speaks IDL version 1 (software 0.1.0), this process 2"));
}

TEST(PeerWatch, NamesClocksThatDifferButNotAnOldSample) {
  PeerWatch watch("map", 100, 1);
  const auto skewed = [](int i) { return peer("dispatcher", 7, kWallNs + i * 1'000'000'000LL - 3'000'000'000LL); };
  EXPECT_THAT(watch.take(skewed(0), seconds(0), kWallNs), IsEmpty());
  EXPECT_THAT(watch.take(skewed(1), seconds(1), kWallNs + 1'000'000'000LL), IsEmpty());
  const std::vector<Finding> findings = watch.take(skewed(2), seconds(2), kWallNs + 2'000'000'000LL);
  ASSERT_THAT(findings, SizeIs(1));
  EXPECT_EQ(findings[0].text,
            "the clock of host host-b (dispatcher) is 3.0 s behind ours; synchronise both, e.g. with chrony");
  EXPECT_THAT(watch.take(skewed(3), seconds(3), kWallNs + 3'000'000'000LL), IsEmpty());

  PeerWatch late("map", 100, 1);
  EXPECT_THAT(late.take(skewed(0), seconds(0), kWallNs), IsEmpty());
  EXPECT_THAT(late.take(peer("dispatcher", 7, kWallNs), seconds(0), kWallNs), IsEmpty());
  EXPECT_THAT(late.take(peer("dispatcher", 7, kWallNs), seconds(0), kWallNs), IsEmpty());
}

}  // namespace
}  // namespace aisle::service
