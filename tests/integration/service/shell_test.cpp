#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/bus/dds/dds_bus.hpp"
#include "common/service/health_file.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/places.hpp"
#include "tests/support/sanitized.hpp"

namespace aisle {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using test_support::ChildProcess;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr int kDomain = 151;

std::vector<std::string> command(const std::vector<std::string>& more) {
  std::vector<std::string> all{test_support::test_program("aisle-idle")};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

std::vector<std::string> on_site(std::vector<std::string> more, int domain = kDomain) {
  more.insert(more.end(), {"--domain", std::to_string(domain), "--interface", "127.0.0.1"});
  return command(more);
}

struct Observer {
  explicit Observer(int domain)
      : bus([domain] {
          bus::Settings settings;
          settings.domain = domain;
          settings.interfaces = {"127.0.0.1"};
          settings.participant_name = "observer";
          return settings;
        }()) {
    bus.on<topics::ServiceHealth>([this](const ServiceHealth& sample, const bus::SampleInfo& info) {
      if (info.kind == bus::SampleKind::kData) {
        heard.push_back(sample);
      } else {
        lost = true;
      }
    });
  }
  bool until(const std::function<bool()>& done, seconds limit = seconds(10)) {
    const auto end = std::chrono::steady_clock::now() + limit;
    while (!done() && std::chrono::steady_clock::now() < end) bus.run_once(milliseconds(50));
    return done();
  }
  bool heard_state(ServiceState state) {
    return until([&] { return !heard.empty() && heard.back().state() == state; });
  }
  bus::DdsBus bus;
  std::vector<ServiceHealth> heard;
  bool lost{false};
};

TEST(Shell, SaysItsHealthAndStopsCleanlyOnSigterm) {
  Observer observer(kDomain);
  ChildProcess service(on_site({"--instance", "idle-1", "--radius", "0.7", "--hold"}));
  ASSERT_TRUE(observer.heard_state(ServiceState::SERVICE_WAITING)) << service.err();
  const ServiceHealth first = observer.heard.back();
  EXPECT_EQ(first.instance_id().to_string(), "idle-1");
  EXPECT_EQ(first.service().to_string(), "idle");
  EXPECT_EQ(first.process_id(), static_cast<unsigned>(service.pid()));
  EXPECT_EQ(first.waits_for().to_string(), "radius 0.700000");
  service.signal(SIGUSR1);
  ASSERT_TRUE(observer.heard_state(ServiceState::SERVICE_READY));
  EXPECT_GT(observer.heard.back().by().sequence_number(), first.by().sequence_number());
  EXPECT_EQ(observer.heard.back().waits_for().to_string(), "");
  EXPECT_TRUE(observer.until([&] { return observer.heard.size() >= 4; }));  // goes on at 1 Hz
  EXPECT_GT(observer.heard.back().resident_mb(), 1.0);
  EXPECT_LT(observer.heard.back().resident_mb(), test_support::kSanitized ? 100.0 : 25.0);
  ASSERT_EQ(observer.heard.back().counters().size(), 1u);
  EXPECT_EQ(observer.heard.back().counters()[0].name().to_string(), "radius_mm");

  service.signal(SIGTERM);
  EXPECT_EQ(service.wait(seconds(2)), 0);
  EXPECT_TRUE(observer.heard_state(ServiceState::SERVICE_STOPPING));
  EXPECT_THAT(service.err(), HasSubstr("level=info instance=idle-1 text=\"aisle-idle"));
}

TEST(Shell, KeepsItsLastWordForAHealthcheck) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("aisle_health_" + std::to_string(getpid()) + ".json");
  const auto kept_state = [&] {
    const auto note = service::recall_health(file);
    return note ? std::optional(note->state) : std::nullopt;
  };
  Observer observer(kDomain + 4);
  ChildProcess service(on_site({"--hold", "--health-file", file.string()}, kDomain + 4));
  EXPECT_TRUE(observer.until([&] { return kept_state() == fleet::ServiceState::kWaiting; })) << service.err();
  EXPECT_EQ(service::recall_health(file)->instance_id, "idle");
  EXPECT_EQ(service::recall_health(file)->waits_for, "radius 0.500000");
  service.signal(SIGUSR1);
  EXPECT_TRUE(observer.until([&] { return kept_state() == fleet::ServiceState::kReady; }));
  service.signal(SIGTERM);
  EXPECT_EQ(service.wait(seconds(5)), 0);
  EXPECT_EQ(kept_state(), fleet::ServiceState::kStopping);
  std::filesystem::remove(file);
}

TEST(Shell, AHangShowsWithinTheLease) {
  Observer observer(kDomain + 1);
  ChildProcess service(on_site({}, kDomain + 1));
  ASSERT_TRUE(observer.heard_state(ServiceState::SERVICE_READY)) << service.err();
  observer.lost = false;
  service.signal(SIGSTOP);
  const auto stopped = std::chrono::steady_clock::now();
  EXPECT_TRUE(observer.until([&] { return observer.lost; }));
  EXPECT_LT(std::chrono::steady_clock::now() - stopped, milliseconds(3000));
  service.signal(SIGCONT);
}

TEST(Shell, NamesASecondProcessWithItsInstanceId) {
  Observer observer(kDomain + 2);
  ChildProcess first(on_site({}, kDomain + 2));
  ASSERT_TRUE(observer.heard_state(ServiceState::SERVICE_READY));
  ChildProcess second(on_site({}, kDomain + 2));
  EXPECT_TRUE(first.wait_for_output("instance id 'idle' is used twice: also by process " + std::to_string(second.pid()),
                                    seconds(5)))
      << first.err();
  EXPECT_TRUE(second.wait_for_output("instance id 'idle' is used twice: also by process " + std::to_string(first.pid()),
                                     seconds(5)));
  EXPECT_TRUE(observer.until([&] {
    return !observer.heard.empty() &&
           observer.heard.back().last_error().to_string().find("used twice") != std::string::npos;
  }));
}

std::uint64_t radius_mm(const ServiceHealth& health) { return health.counters().at(0).value(); }

class ShellConfig : public ::testing::Test {
 protected:
  void SetUp() override {
    file_ = std::filesystem::temp_directory_path() / ("aisle_shell_" + std::to_string(getpid()) + ".yaml");
  }
  void TearDown() override { std::filesystem::remove(file_); }
  std::string path() const { return file_.string(); }
  std::filesystem::path file_;
};

TEST_F(ShellConfig, FlagsWinOverTheEnvironmentAndThatOverTheFile) {
  std::ofstream(file_) << "instance: from-file\nradius_m: 0.25\nsite: {domain: 9, interfaces: [127.0.0.1]}\n";
  Observer observer(kDomain + 3);
  ChildProcess service(command({"--config", path()}), {{"AISLE_DOMAIN", std::to_string(kDomain + 3)}});
  ASSERT_TRUE(observer.heard_state(ServiceState::SERVICE_READY)) << service.err();
  EXPECT_EQ(observer.heard.back().instance_id().to_string(), "from-file");
  EXPECT_EQ(radius_mm(observer.heard.back()), 250u);
  service.signal(SIGTERM);
  EXPECT_EQ(service.wait(seconds(2)), 0);
  ASSERT_TRUE(observer.heard_state(ServiceState::SERVICE_STOPPING));

  observer.heard.clear();
  ChildProcess flagged(on_site({"--config=" + path(), "--radius", "2", "--instance", "from-flag"}, kDomain + 3),
                       {{"AISLE_DOMAIN", "8"}});
  ASSERT_TRUE(observer.heard_state(ServiceState::SERVICE_READY)) << flagged.err();
  EXPECT_EQ(observer.heard.back().instance_id().to_string(), "from-flag");
  EXPECT_EQ(radius_mm(observer.heard.back()), 2000u);
}

struct Refusal {
  std::vector<std::string> arguments;
  int code;
  std::string line;
};

TEST_F(ShellConfig, WhatDoesNotFitEndsTheStartWithOneLine) {
  std::ofstream(file_) << "radius: 1\n";
  const std::string environment_file = path() + ".2";
  std::ofstream(environment_file) << "fail: environment\n";
  const std::vector<Refusal> refusals{
      {{"--instanc", "x"}, 2, "aisle-idle: unknown flag '--instanc'; did you mean '--instance'?\n"},
      {{"--instance", "a b"},
       2,
       "aisle-idle: --instance: 'a b' is not an id; use 1 to 64 letters, digits, '-', '_' and '.'\n"},
      {{"--log-level", "loud"}, 2, "aisle-idle: --log-level: 'loud' is none of debug, info, warning, error, off\n"},
      {{"--config", path()}, 2, "aisle-idle: " + path() + ":1: unknown key 'radius'; did you mean 'radius_m'?\n"},
      {{"--config", "/nonexistent.yaml"},
       2,
       "aisle-idle: /nonexistent.yaml: cannot be read; check the path and its permissions\n"},
      {{"--agv", ""}, 2, "aisle-idle: --agv is missing: the id of the vehicle, e.g. agv-1 (or AISLE_AGV)\n"},
      {{"--interface", "127.0.0.1", "--domain", "150", "--log-level", "off", "--config", environment_file},
       3,
       "aisle-idle: no disk\n"},
  };
  for (const Refusal& refusal : refusals) {
    ChildProcess service(command(refusal.arguments));
    EXPECT_EQ(service.wait(seconds(10)), refusal.code);
    EXPECT_EQ(service.err(), refusal.line);
    EXPECT_EQ(service.out(), "");
  }
  std::filesystem::remove(environment_file);
}

TEST(ShellHelp, AndVersionGoToStdout) {
  ChildProcess help(command({"--help"}));
  EXPECT_EQ(help.wait(seconds(10)), 0);
  for (const char* flag : {"Does nothing.", "--domain", "--partition", "--interface", "--peer", "--discovery-server",
                           "--shared-memory", "--config", "--instance", "--log-level", "--version", "--radius"}) {
    EXPECT_THAT(help.out(), HasSubstr(flag));
  }
  ChildProcess version(command({"--version"}));
  EXPECT_EQ(version.wait(seconds(10)), 0);
  EXPECT_THAT(version.out(), StartsWith("aisle-idle 0."));
}

}  // namespace
}  // namespace aisle
