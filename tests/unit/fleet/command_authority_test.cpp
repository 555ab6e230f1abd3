#include "common/fleet/command_authority.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace aisle::fleet {
namespace {

VelocityCommand for_vehicle(const std::string& agv_id) {
  VelocityCommand command;
  command.agv_id = agv_id;
  return command;
}
const VelocityCommand kCommand = for_vehicle("agv-1");

Origin from(const std::string& source, std::uint64_t boot, std::uint32_t epoch, std::uint64_t sequence) {
  return {source, boot, epoch, sequence, 0};
}

TEST(CommandAuthority, TakesTheFirstSourceAndThenOnlyThat) {
  CommandAuthority authority("agv-1", 0);
  EXPECT_EQ(authority.judge(kCommand, from("a", 1, 1, 1)), CommandVerdict::kAccepted);
  EXPECT_EQ(authority.judge(kCommand, from("a", 1, 1, 2)), CommandVerdict::kAccepted);
  EXPECT_EQ(authority.judge(kCommand, from("b", 1, 1, 9)), CommandVerdict::kForeignSource);
  EXPECT_EQ(authority.judge(kCommand, from("a", 2, 1, 9)), CommandVerdict::kForeignSource);
  EXPECT_EQ(authority.refused(), 2u);
}

TEST(CommandAuthority, AHigherEpochTakesOverAndTheOldOneIsOut) {
  CommandAuthority authority("agv-1", 0);
  EXPECT_EQ(authority.judge(kCommand, from("a", 1, 1, 500)), CommandVerdict::kAccepted);
  EXPECT_EQ(authority.judge(kCommand, from("b", 7, 2, 1)), CommandVerdict::kAccepted);
  EXPECT_EQ(authority.accepted_epoch(), 2u);
  EXPECT_EQ(authority.judge(kCommand, from("a", 1, 1, 501)), CommandVerdict::kOldEpoch);
}

TEST(CommandAuthority, ASequenceNumberIsUsedOnce) {
  CommandAuthority authority("agv-1", 0);
  EXPECT_EQ(authority.judge(kCommand, from("a", 1, 1, 5)), CommandVerdict::kAccepted);
  EXPECT_EQ(authority.judge(kCommand, from("a", 1, 1, 5)), CommandVerdict::kOldSequence);
  EXPECT_EQ(authority.judge(kCommand, from("a", 1, 1, 4)), CommandVerdict::kOldSequence);
  EXPECT_EQ(authority.judge(kCommand, from("a", 1, 1, 6)), CommandVerdict::kAccepted);
}

TEST(CommandAuthority, RefusesCommandsForOthersAndNumbersThatAreNone) {
  CommandAuthority authority("agv-1", 0);
  EXPECT_EQ(authority.judge(for_vehicle("agv-2"), from("a", 1, 1, 1)), CommandVerdict::kForeignVehicle);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e308}) {
    VelocityCommand command = kCommand;
    command.twist.angular_radps = bad;
    EXPECT_EQ(authority.judge(command, from("a", 1, 1, 1)), CommandVerdict::kMalformed);
  }
}

TEST(CommandAuthority, RefusesACommandOfWhichTheSourceIsUnknown) {
  CommandAuthority authority("agv-1", 0);
  EXPECT_EQ(authority.judge(kCommand, Origin{}), CommandVerdict::kMalformed);
  EXPECT_EQ(authority.judge(kCommand, from("", 1, 1, 1)), CommandVerdict::kMalformed);
  EXPECT_EQ(authority.judge(kCommand, from("a", 1, 1, 0)), CommandVerdict::kMalformed);
  EXPECT_EQ(authority.accepted_epoch(), 0u);
  EXPECT_EQ(authority.judge(kCommand, from("a", 1, 1, 1)), CommandVerdict::kAccepted);
}

TEST(CommandAuthority, ACommandThatCouldNotBeReadCountsAsRefused) {
  CommandAuthority authority("agv-1", 0);
  EXPECT_EQ(authority.refuse_unread(), CommandVerdict::kMalformed);
  EXPECT_EQ(authority.refused(), 1u);
}

TEST(CommandAuthority, ARefusedCommandChangesNothing) {
  CommandAuthority authority("agv-1", 0);
  EXPECT_EQ(authority.judge(kCommand, from("a", 1, 1, 1)), CommandVerdict::kAccepted);
  VelocityCommand malformed = kCommand;
  malformed.twist.linear_mps = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(authority.judge(malformed, from("b", 1, 9, 1)), CommandVerdict::kMalformed);
  EXPECT_EQ(authority.judge(kCommand, from("a", 1, 1, 2)), CommandVerdict::kAccepted);
}

TEST(CommandAuthority, RemembersTheEpochOverARestart) {
  CommandAuthority authority("agv-1", 4);
  EXPECT_EQ(authority.judge(kCommand, from("a", 1, 3, 1)), CommandVerdict::kOldEpoch);
  EXPECT_EQ(authority.judge(kCommand, from("a", 1, 4, 90)), CommandVerdict::kAccepted);
}

}  // namespace
}  // namespace aisle::fleet
