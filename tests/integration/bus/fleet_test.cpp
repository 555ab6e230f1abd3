// As many processes as a site has.
#include <gtest/gtest.h>

#include <fstream>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "common/config/reader.hpp"
#include "tests/integration/bus/two_buses.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/places.hpp"
#include "tests/support/sanitized.hpp"

namespace aisle::bus_test {
namespace {

double resident_mb(pid_t pid) {
  std::ifstream status("/proc/" + std::to_string(pid) + "/status");
  for (std::string word; status >> word;) {
    double kilobytes = 0;
    if (word == "VmRSS:" && status >> kilobytes) return kilobytes / 1024.0;
  }
  return 0.0;
}

TEST(Fleet, ThirtyParticipantsMeetAndStaySmall) {
  constexpr int kMembers = 30;
  DdsBus listener(loopback(212, "listener"));
  std::set<std::string> heard;
  listener.on<topics::VehicleState>(
      [&](const aisle::VehicleState& state, const bus::SampleInfo&) { heard.insert(state.agv_id().to_string()); });
  std::vector<std::unique_ptr<test_support::ChildProcess>> members;
  for (int i = 0; i < kMembers; ++i) {
    members.push_back(std::make_unique<test_support::ChildProcess>(std::vector<std::string>{
        test_support::test_program("bus_test_peer"), "212", "", "member-" + std::to_string(i), "member"}));
  }
  EXPECT_TRUE(run_until(
      {&listener}, [&] { return heard.size() == kMembers; }, test_support::kSanitized ? 240s : 60s))
      << heard.size();
  EXPECT_EQ(listener.participants().size(), static_cast<std::size_t>(kMembers));
  for (const auto& member : members) EXPECT_LT(resident_mb(member->pid()), test_support::kSanitized ? 100.0 : 25.0);
}

TEST(Fleet, PartitionsKeepSitesApart) {
  bus::Settings here = loopback(213, "here");
  here.partition = "site-a";
  DdsBus listener(here);
  std::set<std::string> heard;
  listener.on<topics::VehicleState>(
      [&](const aisle::VehicleState& state, const bus::SampleInfo&) { heard.insert(state.agv_id().to_string()); });
  const test_support::ChildProcess other(
      {test_support::test_program("bus_test_peer"), "213", "site-b", "other", "member"});
  const test_support::ChildProcess ours(
      {test_support::test_program("bus_test_peer"), "213", "site-a", "ours", "member"});
  ASSERT_TRUE(run_until({&listener}, [&] { return listener.participants().size() == 2 && heard.count("ours") > 0; }));
  run_until(
      {&listener}, [] { return false; }, 500ms);
  EXPECT_EQ(heard, std::set<std::string>{"ours"});
}

TEST(Fleet, PeersMeetWithoutMulticast) {
  bus::Settings settings = loopback(214, "by-peer");
  settings.peers = {"127.0.0.1"};
  DdsBus sender(settings), receiver(settings);
  auto states = sender.writer<topics::VehicleState>();
  int heard = 0;
  receiver.on<topics::VehicleState>([&](const aisle::VehicleState&, const bus::SampleInfo&) { ++heard; });
  sender.every(20ms, [&] { states.write(aisle::VehicleState()); });
  EXPECT_TRUE(run_until({&sender, &receiver}, [&] { return heard > 0; }));
}

TEST(Fleet, RefusesWhatThisHostDoesNotHave) {
  bus::Settings settings = loopback(215);
  settings.interfaces = {"192.0.2.77"};
  EXPECT_THROW(DdsBus{settings}, config::BadEnvironment);
  settings.interfaces = {"eth0"};
  EXPECT_THROW(DdsBus{settings}, config::BadInput);
  settings = loopback(231);
  EXPECT_THROW(DdsBus{settings}, config::BadInput);
  settings = loopback(215);
  settings.discovery_server = "127.0.0.1:99999";
  EXPECT_THROW(DdsBus{settings}, config::BadInput);
}

}  // namespace
}  // namespace aisle::bus_test
