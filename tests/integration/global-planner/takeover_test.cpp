// Two planners as processes: what a kill and a hang of the leading one do.
#include <gtest/gtest.h>

#include <csignal>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "tests/integration/global-planner/site.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/places.hpp"

namespace aisle::global_planner {
namespace {

using test_support::ChildProcess;

std::unique_ptr<ChildProcess> start(int domain, const std::string& name, bool standby) {
  std::vector<std::string> command{test_support::program("aisle-global-planner"),
                                   "--domain",
                                   std::to_string(domain),
                                   "--interface",
                                   "127.0.0.1",
                                   "--partition",
                                   partition(),
                                   "--instance",
                                   name};
  if (standby) command.push_back("--standby");
  return std::make_unique<ChildProcess>(command);
}

class Takeover : public testing::Test {
 protected:
  void begin(int domain) {
    site_ = std::make_unique<Site>(domain);
    site_->publish_map();
    site_->add_vehicle("agv-1", {1.0, 5.0, 0.0});
    site_->send_goal("agv-1", "goal-1", 19.0, 5.0);
    primary_ = start(domain, "primary", false);
    ASSERT_TRUE(wait([&] { return !site_->plans.empty(); })) << primary_->err();
    standby_ = start(domain, "standby", true);
    ASSERT_TRUE(standby_->wait_for_output("follows primary, epoch 1", 10s)) << standby_->err();
    first_ = site_->plans.back();
    ASSERT_EQ(first_.by().source_id().to_string(), "primary");
  }
  bool wait(const std::function<bool()>& done) { return bus_test::run_until({&site_->bus}, done); }
  bool wait_for_standby() {
    const auto begun = std::chrono::steady_clock::now();
    const bool came = wait([&] { return site_->plans.back().by().source_id().to_string() == "standby"; });
    RecordProperty("takeover_ms", static_cast<int>((std::chrono::steady_clock::now() - begun) / 1ms));
    return came;
  }

  std::unique_ptr<Site> site_;
  std::unique_ptr<ChildProcess> primary_, standby_;
  aisle::Plan first_;
};

TEST_F(Takeover, FollowsAKillWithTheNextEpoch) {
  begin(145);
  primary_->signal(SIGKILL);
  ASSERT_TRUE(wait_for_standby()) << standby_->err();
  EXPECT_EQ(site_->plans.back().by().epoch(), first_.by().epoch() + 1);
  EXPECT_EQ(site_->plans.back().trigger(), aisle::PlanTrigger::TRIGGER_TAKEOVER);
  EXPECT_EQ(site_->plans.back().waypoints_in_map(), first_.waypoints_in_map());

  const auto restarted = start(145, "primary", false);  // giving the lead back is a person's decision
  ASSERT_TRUE(restarted->wait_for_output("stands by", 10s)) << restarted->err();
  site_->send_goal("agv-1", "goal-2", 15.0, 5.0);
  ASSERT_TRUE(wait([&] { return site_->plans.back().goal_id().to_string() == "goal-2"; }));
  EXPECT_EQ(site_->plans.back().by().source_id().to_string(), "standby");
}

TEST_F(Takeover, FollowsAHangAndRefusesTheLeaderThatComesBack) {
  begin(146);
  primary_->signal(SIGSTOP);
  ASSERT_TRUE(wait_for_standby()) << standby_->err();
  EXPECT_EQ(site_->plans.back().by().epoch(), first_.by().epoch() + 1);
  primary_->signal(SIGCONT);
  ASSERT_TRUE(primary_->wait_for_output("another planner leads with a higher epoch", 10s)) << primary_->err();
  site_->send_goal("agv-1", "goal-2", 15.0, 5.0);
  ASSERT_TRUE(wait([&] { return site_->plans.back().goal_id().to_string() == "goal-2"; }));
  EXPECT_EQ(site_->plans.back().by().source_id().to_string(), "standby");
}

}  // namespace
}  // namespace aisle::global_planner
