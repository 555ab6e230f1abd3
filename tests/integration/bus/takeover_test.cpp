// Who is heard on a topic with exclusive ownership, when writers fall silent, die and come back.
#include <gtest/gtest.h>

#include <csignal>
#include <string>
#include <vector>

#include "tests/integration/bus/two_buses.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/places.hpp"

namespace aisle::bus_test {
namespace {

using bus::SampleInfo;
using bus::SampleKind;
using Clock = std::chrono::steady_clock;

/// Listens to plans: who was heard last, and when anybody was.
class PlanListener {
 public:
  explicit PlanListener(int domain) : bus_(loopback(domain, "listener")) {
    bus_.on<topics::Plan>([this](const aisle::Plan& plan, const SampleInfo& info) {
      if (info.kind == SampleKind::kNoWriters) {
        orphaned_.push_back(plan.agv_id().to_string());
        return;
      }
      source_ = plan.by().source_id().to_string();
      heard_at_ = Clock::now();
      ++heard_;
    });
    bus_.on_incident([this](const bus::Incident& incident) { incidents_.push_back(incident); });
  }
  bool hears(const std::string& source, std::chrono::milliseconds limit = 10s) {
    return run_until(
        {&bus_}, [&] { return source_ == source; }, limit);
  }
  /// Since when nobody else was heard: at the last sample.
  Clock::time_point heard_at() const { return heard_at_; }
  const std::string& source() const { return source_; }
  const std::vector<std::string>& orphaned() const { return orphaned_; }
  std::vector<bus::Incident>& incidents() { return incidents_; }
  Bus& bus() { return bus_; }
  int heard() const { return heard_; }

 private:
  DdsBus bus_;
  std::string source_;
  Clock::time_point heard_at_;
  std::vector<std::string> orphaned_;
  std::vector<bus::Incident> incidents_;
  int heard_{0};
};

test_support::ChildProcess planner(int domain, const std::string& name, int strength) {
  return test_support::ChildProcess({test_support::test_program("bus_test_peer"), std::to_string(domain), "", name,
                                     "plan", std::to_string(strength)});
}

/// How long nobody was heard, from the last sample of `strong` to the first of `weak`.
std::chrono::milliseconds gap_of_takeover(PlanListener& listener, const std::function<void()>& silence) {
  EXPECT_TRUE(listener.hears("strong"));
  silence();
  Clock::time_point last;
  EXPECT_TRUE(run_until({&listener.bus()}, [&] {
    if (listener.source() == "strong") last = listener.heard_at();
    return listener.source() == "weak";
  }));
  return std::chrono::duration_cast<std::chrono::milliseconds>(listener.heard_at() - last);
}

TEST(Takeover, TheStrongerWriterIsHeard) {
  PlanListener listener(207);
  const auto weak = planner(207, "weak", 1);
  ASSERT_TRUE(listener.hears("weak"));
  auto strong = planner(207, "strong", 5);
  EXPECT_TRUE(listener.hears("strong"));
}

TEST(Takeover, AStandbyIsHeardSoonAfterAKill) {
  PlanListener listener(208);
  const auto weak = planner(208, "weak", 1);
  auto strong = planner(208, "strong", 5);
  EXPECT_LT(gap_of_takeover(listener, [&] { strong.signal(SIGKILL); }), 400ms);
}

TEST(Takeover, AStandbyIsHeardSoonAfterAHangAndTheStrongWriterWhenItIsBack) {
  PlanListener listener(209);
  const auto weak = planner(209, "weak", 1);
  auto strong = planner(209, "strong", 5);
  EXPECT_LT(gap_of_takeover(listener, [&] { strong.signal(SIGSTOP); }), 400ms);
  strong.signal(SIGCONT);
  EXPECT_TRUE(listener.hears("strong"));
}

TEST(Takeover, ARestartedWriterIsHeardThoughTheDeadOneWasStronger) {
  PlanListener listener(210);
  auto first = planner(210, "first", 5);
  ASSERT_TRUE(listener.hears("first"));
  first.signal(SIGKILL);
  const auto again = planner(210, "again", 1);
  EXPECT_TRUE(listener.hears("again", 3s));
}

TEST(Takeover, SilenceOfTheOnlyWriterIsToldWithTheKeyAndNamed) {
  PlanListener listener(211);
  auto only = planner(211, "only", 1);
  ASSERT_TRUE(listener.hears("only"));
  const auto killed = Clock::now();
  only.signal(SIGKILL);
  ASSERT_TRUE(run_until({&listener.bus()}, [&] { return !listener.orphaned().empty(); }));
  EXPECT_LT(Clock::now() - killed, 500ms);
  EXPECT_EQ(listener.orphaned(), std::vector<std::string>{"agv-1"});
  ASSERT_TRUE(run_until({&listener.bus()}, [&] { return !listener.incidents().empty(); }));
  EXPECT_EQ(listener.incidents()[0].kind, bus::Incident::Kind::kLivelinessLost);
  EXPECT_NE(listener.incidents()[0].text.find("only"), std::string::npos) << listener.incidents()[0].text;
}

}  // namespace
}  // namespace aisle::bus_test
