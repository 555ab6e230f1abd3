// docs/new-service.md: its program runs, counts, says what it waits for, and takes its configuration.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <fstream>
#include <functional>
#include <iterator>
#include <string>

#include "common/bus/dds/dds_bus.hpp"
#include "common/service/shell.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/places.hpp"

namespace aisle {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr int kDomain = 145;

TEST(NewServicePage, ShowsAWholeServiceInSixtyLines) {
  std::ifstream in(test_support::source_folder() / "docs/new-service.md");
  const std::string page{std::istreambuf_iterator<char>(in), {}};
  const std::size_t begin = page.find("```cpp\n") + 7;
  const std::string program = page.substr(begin, page.find("\n```", begin) - begin);
  const auto lines = std::count(program.begin(), program.end(), '\n') + 1;
  EXPECT_LE(lines, 60);
}

TEST(NewServicePage, ItsServiceWorks) {
  bus::Settings settings;
  settings.domain = kDomain;
  settings.interfaces = {"127.0.0.1"};
  bus::DdsBus bus(settings);
  service::Shell shell(bus, {"test", "test", "", 1, "", 0});
  fleet::ServiceHealth heard;
  shell.inbox<topics::ServiceHealth>([&](const fleet::ServiceHealth& health) {
    if (health.service == "odometer") heard = health;
  });
  service::Outbox<topics::VehicleState> states = shell.outbox<topics::VehicleState>();
  const auto until = [&](const std::function<bool()>& done) {
    const auto end = std::chrono::steady_clock::now() + seconds(20);
    while (!done() && std::chrono::steady_clock::now() < end) bus.run_once(milliseconds(20));
    return done();
  };

  test_support::ChildProcess odometer({ODOMETER, "--domain", std::to_string(kDomain), "--interface", "127.0.0.1"});
  ASSERT_TRUE(until([&] { return heard.waits_for == "vehicle_state"; })) << odometer.err();
  EXPECT_EQ(heard.state, fleet::ServiceState::kWaiting);

  fleet::VehicleState state;
  state.agv_id = "agv-1";
  bool drives = true;
  shell.every(milliseconds(20), [&] {
    if (drives) state.motion.base_in_map.x += 0.1;
    states.write(state);
  });
  ASSERT_TRUE(until([&] { return heard.counters["driven_mm.agv-1"] > 1000; })) << odometer.err();
  EXPECT_EQ(heard.state, fleet::ServiceState::kReady);
  drives = false;
  state.motion.base_in_map.x += 500.0;
  ASSERT_TRUE(until([&] { return odometer.wait_for_output("agv-1 was carried, not driven", milliseconds(1)); }))
      << odometer.err();

  odometer.signal(SIGTERM);
  EXPECT_EQ(odometer.wait(seconds(5)), 0);
}

TEST(NewServicePage, ItsServiceNamesATypoInItsFile) {
  const std::string file = testing::TempDir() + "odometer.yaml";
  std::ofstream(file) << "longest_stp_m: 2\n";
  test_support::ChildProcess odometer({ODOMETER, "--config", file});
  EXPECT_EQ(odometer.wait(seconds(10)), 2);
  EXPECT_THAT(odometer.err(), testing::HasSubstr("did you mean 'longest_step_m'?"));
}

}  // namespace
}  // namespace aisle
