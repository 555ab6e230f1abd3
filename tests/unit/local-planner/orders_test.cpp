// Which plan is driven and how far, whatever order plans and grants come in.
#include "services/local-planner/core/orders.hpp"

#include <gtest/gtest.h>

namespace aisle::local_planner {
namespace {

fleet::Plan plan(std::uint64_t id, std::size_t steps = 3) {
  fleet::Plan plan;
  plan.id = id;
  plan.waypoints_in_map = {{0.0, 0.0}, {9.0, 0.0}};
  for (std::size_t i = 1; i <= steps; ++i)
    plan.step_ends_m.push_back(9.0 * static_cast<double>(i) / static_cast<double>(steps));
  return plan;
}

fleet::Grant grant(std::uint64_t number, std::uint64_t plan_id, std::uint64_t limit_step = 1) {
  fleet::Grant grant;
  grant.number = number;
  grant.plan_id = plan_id;
  grant.limit_step = limit_step;
  return grant;
}

class Given : public testing::Test {
 protected:
  Given() {
    orders.take(plan(1), {1, 7});
    orders.take(grant(1, 1), {1, 7});
  }

  std::uint64_t plan_id() const { return orders.plan()->id; }
  std::uint64_t number() const { return orders.grant()->number; }

  Orders orders;
};

TEST(Orders, TheFirstPlanIsTakenAndNothingIsGrantedOnIt) {
  Orders orders;
  EXPECT_FALSE(orders.plan());
  orders.take(plan(1), {1, 7});
  ASSERT_TRUE(orders.plan());
  EXPECT_FALSE(orders.grant());
  orders.take(grant(4, 1), {1, 7});
  ASSERT_TRUE(orders.grant());
  EXPECT_EQ(orders.grant()->number, 4U);
}

TEST(Orders, AGrantMayComeBeforeItsPlan) {
  Orders orders;
  orders.take(grant(4, 1), {1, 7});
  orders.take(plan(1), {1, 7});
  ASSERT_TRUE(orders.grant());
}

/// Two led in one epoch while the network was split. The one that started first is obeyed, and its grants count anew.
TEST_F(Given, OfTwoPlannersOfOneEpochTheOneThatStartedFirstIsObeyed) {
  EXPECT_FALSE(orders.take(plan(2), {1, 8}));
  EXPECT_FALSE(orders.take(grant(9, 2), {1, 8})) << "started later";
  EXPECT_EQ(plan_id(), 1U);

  EXPECT_TRUE(orders.take(plan(1), {1, 6}));
  EXPECT_EQ(orders.granted_by().boot_id, 7U) << "drives on with what the other one gave";
  EXPECT_TRUE(orders.take(grant(1, 1, 3), {1, 6})) << "numbers of one planner do not count for another";
  EXPECT_EQ(orders.grant()->limit_step, 3U);
  EXPECT_EQ(orders.granted_by().boot_id, 6U);
  EXPECT_FALSE(orders.take(grant(9, 1, 2), {1, 7}));
}

TEST_F(Given, ANewPlanWaitsForAGrantThatNamesIt) {
  orders.take(plan(2), {1, 7});
  EXPECT_EQ(plan_id(), 1U);
  orders.take(grant(2, 1, 2), {1, 7});
  EXPECT_EQ(plan_id(), 1U);
  EXPECT_EQ(number(), 2U) << "still of the plan that is driven";
  orders.take(grant(3, 2), {1, 7});
  EXPECT_EQ(plan_id(), 2U);
  EXPECT_EQ(number(), 3U);
}

TEST_F(Given, AGrantForAPlanThatIsNotThereYetChangesNothing) {
  orders.take(grant(2, 2), {1, 7});
  EXPECT_EQ(plan_id(), 1U);
  EXPECT_EQ(number(), 1U);
  orders.take(plan(2), {1, 7});
  EXPECT_EQ(plan_id(), 2U);
  EXPECT_EQ(number(), 2U);
}

TEST_F(Given, AnOlderGrantIsRefusedWhateverItsLimit) {
  EXPECT_TRUE(orders.take(grant(5, 1, 1), {1, 7}));
  EXPECT_FALSE(orders.take(grant(4, 1, 3), {1, 7}));
  EXPECT_FALSE(orders.take(grant(5, 1, 3), {1, 7})) << "doubled";
  EXPECT_EQ(orders.grant()->limit_step, 1U);
}

TEST_F(Given, OnlyTheNewestEpochGrants) {
  orders.take(grant(9, 1, 2), {1, 7});
  orders.take(plan(1), {2, 7});  // ids begin again with each planner
  EXPECT_EQ(orders.grant()->number, 9U) << "drives on with what the old leader gave";
  EXPECT_TRUE(orders.take(grant(1, 1, 3), {2, 7}));
  EXPECT_EQ(orders.grant()->limit_step, 3U);
  EXPECT_FALSE(orders.take(grant(99, 1, 1), {1, 7})) << "of a leader that was replaced";
  EXPECT_EQ(orders.grant()->limit_step, 3U);
}

TEST_F(Given, AGrantOfANewLeaderDoesNotNameAnOldPlanOfThatId) {
  orders.take(grant(1, 1, 3), {2, 7});
  EXPECT_EQ(orders.grant()->limit_step, 1U);
}

TEST_F(Given, ALeaderThatWasHeardIsTheOnlyOneThatGrants) {
  orders.hear({2, 7});
  EXPECT_EQ(orders.obeyed().epoch, 2U);
  EXPECT_FALSE(orders.take(grant(9, 1, 3), {1, 7}));
  EXPECT_EQ(orders.grant()->limit_step, 1U) << "what was granted stays";
}

TEST_F(Given, TheSamePlanForANewerMapIsTakenAtOnce) {
  fleet::Plan again = plan(1);
  again.map_revision = 7;
  orders.take(again, {1, 7});
  EXPECT_EQ(orders.plan()->map_revision, 7U);
  EXPECT_EQ(number(), 1U);
}

TEST_F(Given, APlanThatStopsIsTakenAtOnce) {
  fleet::Plan cancelled = plan(2, 0);
  cancelled.outcome = fleet::PlanOutcome::kCancelled;
  orders.take(cancelled, {1, 7});
  EXPECT_EQ(plan_id(), 2U);
  EXPECT_FALSE(orders.grant());
  orders.take(plan(3), {1, 7});
  EXPECT_EQ(plan_id(), 3U) << "it stands anyway";
}

TEST(Orders, APlanWithoutStepsNeedsNoGrant) {
  Orders orders;
  orders.take(plan(1, 0), {1, 7});
  orders.take(plan(2, 0), {1, 7});
  EXPECT_EQ(orders.plan()->id, 2U);
}

}  // namespace
}  // namespace aisle::local_planner
