#include "services/fake-vehicle/core/command_authority.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace aisle::fake_vehicle {
namespace {

Command from(const std::string& source, std::uint64_t boot, std::uint32_t epoch, std::uint64_t sequence) {
  Command command;
  command.agv_id = "agv-1";
  command.source_id = source;
  command.boot_id = boot;
  command.epoch = epoch;
  command.sequence_number = sequence;
  return command;
}

TEST(CommandAuthority, TakesWhoComesFirstAndThenOnlyThem) {
  CommandAuthority authority("agv-1", 0);
  EXPECT_EQ(authority.judge(from("a", 1, 1, 1)), Verdict::kAccepted);
  EXPECT_EQ(authority.judge(from("a", 1, 1, 2)), Verdict::kAccepted);
  EXPECT_EQ(authority.judge(from("b", 1, 1, 9)), Verdict::kForeignSource);
  EXPECT_EQ(authority.judge(from("a", 2, 1, 9)), Verdict::kForeignSource);
  EXPECT_EQ(authority.refused(), 2u);
}

TEST(CommandAuthority, AHigherEpochTakesOverAndTheOldOneIsOut) {
  CommandAuthority authority("agv-1", 0);
  EXPECT_EQ(authority.judge(from("a", 1, 1, 500)), Verdict::kAccepted);
  EXPECT_EQ(authority.judge(from("b", 7, 2, 1)), Verdict::kAccepted);
  EXPECT_EQ(authority.accepted_epoch(), 2u);
  EXPECT_EQ(authority.judge(from("a", 1, 1, 501)), Verdict::kOldEpoch);
}

TEST(CommandAuthority, ASequenceNumberIsUsedOnce) {
  CommandAuthority authority("agv-1", 0);
  EXPECT_EQ(authority.judge(from("a", 1, 1, 5)), Verdict::kAccepted);
  EXPECT_EQ(authority.judge(from("a", 1, 1, 5)), Verdict::kOldSequence);
  EXPECT_EQ(authority.judge(from("a", 1, 1, 4)), Verdict::kOldSequence);
  EXPECT_EQ(authority.judge(from("a", 1, 1, 6)), Verdict::kAccepted);
}

TEST(CommandAuthority, RefusesCommandsForOthersAndWhatIsNoNumber) {
  CommandAuthority authority("agv-1", 0);
  Command foreign = from("a", 1, 1, 1);
  foreign.agv_id = "agv-2";
  EXPECT_EQ(authority.judge(foreign), Verdict::kForeignVehicle);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e308}) {
    Command command = from("a", 1, 1, 1);
    command.twist.angular_radps = bad;
    EXPECT_EQ(authority.judge(command), Verdict::kMalformed);
  }
}

TEST(CommandAuthority, ARefusedCommandChangesNothing) {
  CommandAuthority authority("agv-1", 0);
  EXPECT_EQ(authority.judge(from("a", 1, 1, 1)), Verdict::kAccepted);
  Command malformed = from("b", 1, 9, 1);
  malformed.twist.linear_mps = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(authority.judge(malformed), Verdict::kMalformed);
  EXPECT_EQ(authority.judge(from("a", 1, 1, 2)), Verdict::kAccepted);
}

TEST(CommandAuthority, RemembersTheEpochOverARestart) {
  CommandAuthority authority("agv-1", 4);
  EXPECT_EQ(authority.judge(from("a", 1, 3, 1)), Verdict::kOldEpoch);
  EXPECT_EQ(authority.judge(from("a", 1, 4, 90)), Verdict::kAccepted);
}

}  // namespace
}  // namespace aisle::fake_vehicle
