#include "tools/cli/diagnosis.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "tools/cli/shared_memory_probe.hpp"

namespace aisle::cli {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

bus::Settings site() {
  bus::Settings settings;
  settings.domain = 3;
  return settings;
}

bus::Endpoint plan_writer() {
  const TopicRow plan = find_topic("plan");
  return {plan.name, plan.type, "global-planner", "host-b", true, plan.qos, {}};
}

TEST(Diagnosis, OfAnEmptyDomainNamesTheOnesThatAreNot) {
  EXPECT_THAT(judge_discovery(site(), 2, {}), IsEmpty());
  const std::vector<Problem> elsewhere = judge_discovery(site(), 0, {0, 7});
  ASSERT_THAT(elsewhere, SizeIs(1));
  EXPECT_EQ(elsewhere[0].text,
            "nobody seen in domain 3, all interfaces; but somebody is in domain 0, 7: use --domain or AISLE_DOMAIN");
  EXPECT_THAT(judge_discovery(site(), 0, {})[0].text, HasSubstr("--peer ADDRESS"));
  bus::Settings behind_server = site();
  behind_server.discovery_server = "10.0.0.1:11811";
  EXPECT_THAT(judge_discovery(behind_server, 0, {})[0].text, HasSubstr("discovery server runs at 10.0.0.1:11811"));
}

TEST(Diagnosis, OfTheNetworkWantsTheAddressAndMulticastUnlessPeersAreNamed) {
  const std::vector<NetworkInterface> interfaces{{"lo", "127.0.0.1", true, false}, {"eth0", "10.0.0.2", false, false}};
  const std::vector<Problem> all = judge_network(site(), interfaces);
  ASSERT_THAT(all, SizeIs(1));  // loopback is not used by default
  EXPECT_THAT(all[0].text, HasSubstr("multicast does not work on 10.0.0.2 (eth0)"));
  bus::Settings bound = site();
  bound.interfaces = {"10.0.0.9"};
  EXPECT_THAT(judge_network(bound, interfaces)[0].text,
              AllOf(HasSubstr("has the address 10.0.0.9"), HasSubstr("127.0.0.1 (lo), 10.0.0.2 (eth0)")));
  bus::Settings with_peers = site();
  with_peers.peers = {"10.0.0.3"};
  EXPECT_THAT(judge_network(with_peers, interfaces), IsEmpty());
}

TEST(Diagnosis, OfEndpointsNamesTypeQosAndPartition) {
  EXPECT_THAT(judge_endpoints(site(), {plan_writer()}), IsEmpty());
  bus::Endpoint other_type = plan_writer();
  other_type.type = "nav::Path";
  EXPECT_EQ(judge_endpoints(site(), {other_type})[0].text,
            "topic 'plan': the writer in 'global-planner' on host host-b uses the type nav::Path, Aisle aisle::Plan; "
            "it hears and says nothing here");
  bus::Endpoint other_qos = plan_writer();
  other_qos.qos.reliability = bus::Reliability::kBestEffort;
  EXPECT_THAT(judge_endpoints(site(), {other_qos})[0].text,
              HasSubstr("has other QoS: best effort, transient local, exclusive, lease 200 ms; Aisle has: reliable"));
  bus::Endpoint elsewhere = plan_writer();
  elsewhere.partitions = {"hall-2"};
  EXPECT_EQ(judge_endpoints(site(), {elsewhere})[0].text,
            "nobody uses partition ''; others use 'hall-2': set --partition or AISLE_PARTITION");
  EXPECT_THAT(judge_endpoints(site(), {elsewhere, plan_writer()}), IsEmpty());  // two sites in one domain are fine
  bus::Endpoint foreign = plan_writer();
  foreign.topic = "rt/chatter";
  EXPECT_THAT(judge_endpoints(site(), {foreign}), IsEmpty());
}

TEST(Diagnosis, OfServicesSaysWhatTheyWaitFor) {
  fleet::ServiceHealth ready;
  ready.state = fleet::ServiceState::kReady;
  fleet::ServiceHealth waiting;
  waiting.state = fleet::ServiceState::kWaiting;
  waiting.waits_for = "map_info";
  fleet::ServiceHealth ailing = ready;
  ailing.last_error = "disk full";
  EXPECT_THAT(judge_services({{"a", ready}}, {}), IsEmpty());
  const std::vector<Problem> problems =
      judge_services({{"a", ready}, {"b", waiting}, {"c", ailing}, {"d", ready}}, {"d"});
  ASSERT_THAT(problems, SizeIs(3));
  EXPECT_EQ(problems[0].text, "b is waiting, waits for map_info");
  EXPECT_FALSE(problems[0].is_past);
  EXPECT_EQ(problems[1].text, "c is ready, but had an error: disk full");
  EXPECT_TRUE(problems[1].is_past);
  EXPECT_THAT(problems[2].text, HasSubstr("d on host  has fallen silent"));
}

TEST(Diagnosis, OfVehiclesFindsTwoWithOneIdButNotARestart) {
  VehicleWatch watch;
  const auto take = [&](const char* agv_id, const char* source, std::uint64_t boot, fleet::Hold hold) {
    fleet::VehicleState state;
    state.agv_id = agv_id;
    state.hold = hold;
    watch.take(state, {source, boot, 0, 1, 0});
  };
  const fleet::Hold none = fleet::Hold::kNone;
  take("agv-1", "fake-vehicle-agv-1", 5, none);
  for (int i = 0; i < 3; ++i) take("agv-1", "fake-vehicle-agv-1", 6, none);
  EXPECT_THAT(watch.judge(), IsEmpty());
  for (int i = 0; i < 3; ++i) take("agv-1", "truck", 7, none);
  ASSERT_THAT(watch.judge(), SizeIs(1));
  EXPECT_EQ(
      watch.judge()[0].text,
      "two vehicles call themselves 'agv-1': fake-vehicle-agv-1 (boot 6) and truck (boot 7); give one another id");
  take("agv-2", "x", 1, fleet::Hold::kContact);
  EXPECT_THAT(watch.judge(), SizeIs(2));
}

TEST(Diagnosis, OfSharedMemoryAsksForRoomOnlyWhenItIsUsed) {
  SharedMemory memory{"/dev/shm", true, true, 64U << 20, 20U << 20, 0, 0};
  bus::Settings settings = site();
  EXPECT_THAT(judge_shared_memory(settings, memory), IsEmpty());
  settings.shared_memory = true;
  const auto small = judge_shared_memory(settings, memory);
  ASSERT_THAT(small, SizeIs(1));
  EXPECT_THAT(small[0].text, AllOf(HasSubstr("/dev/shm has 20 MB of 64 MB left; each process takes 16 MB"),
                                   HasSubstr("--shm-size 1g")));
  memory.available_bytes = memory.capacity_bytes = 1U << 30;
  EXPECT_THAT(judge_shared_memory(settings, memory), IsEmpty());
  memory.is_writable = false;
  EXPECT_THAT(judge_shared_memory(settings, memory)[0].text, HasSubstr("cannot be written"));
  memory.exists = false;
  EXPECT_THAT(judge_shared_memory(settings, memory)[0].text, HasSubstr("there is no /dev/shm"));
}

TEST(Diagnosis, OfSharedMemoryNamesWhatWasLeftBehind) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("aisle-doctor-" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  std::ofstream(folder / "fastrtps_0123456789abcdef") << std::string(3 << 20, 'x');
  std::ofstream(folder / "fastrtps_0123456789abcdef_el");
  std::ofstream(folder / "somebody-elses") << "x";
  const SharedMemory memory = probe_shared_memory(folder);
  std::filesystem::remove_all(folder);
  EXPECT_TRUE(memory.exists);
  EXPECT_GT(memory.capacity_bytes, 0U);
  EXPECT_EQ(memory.left_over_files, 1);
  EXPECT_EQ(memory.left_over_bytes, 3U << 20);
  bus::Settings settings = site();
  settings.shared_memory = true;
  const auto problems = judge_shared_memory(
      settings, {"/dev/shm", true, true, 1U << 30, 1U << 30, memory.left_over_files, memory.left_over_bytes});
  ASSERT_THAT(problems, SizeIs(1));
  EXPECT_THAT(problems[0].text, AllOf(HasSubstr("1 segments (3 MB)"), HasSubstr("fastdds shm clean")));
}

TEST(Diagnosis, OfSharedMemoryFindsAFolderThatIsNotThere) {
  EXPECT_FALSE(probe_shared_memory("/nonexistent/shm").exists);
}

}  // namespace
}  // namespace aisle::cli
