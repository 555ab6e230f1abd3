// Plans and grants for a fleet, with invented times and vehicles that say what they should.
#include "services/global-planner/core/traffic_planner.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

using geometry::Point2;
using geometry::Pose2;
using time::from_seconds;

constexpr double kRadiusM = 0.3;

/// A hall of 20 x 10 m at 0.1 m a cell with two doors in a wall at x = 10: one at y = 5, one at y = 9.
class TrafficFleet : public testing::Test {
 protected:
  explicit TrafficFleet(const FleetSettings& settings = {})
      : grid_(grid::Geometry{200, 100, 0.1, {}}), planner_(settings, find_variant("direct")->make()) {
    block(10.0, 0.0, 10.2, 10.0);
    block(10.0, 4.0, 10.2, 6.0, grid::Occupancy::kFree);
    block(10.0, 8.0, 10.2, 9.8, grid::Occupancy::kFree);
    publish_map();
  }

  void block(double x0, double y0, double x1, double y1, grid::Occupancy fill = grid::Occupancy::kOccupied) {
    const grid::Cell low = grid_.geometry().cell_at({x0 + 1e-6, y0 + 1e-6});
    const grid::Cell high = grid_.geometry().cell_at({x1 - 1e-6, y1 - 1e-6});
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) grid_.set({x, y}, fill);
    }
  }
  void publish_map() { planner_.set_map("site", ++revision_, grid_, {0, 0}, {199, 99}); }

  /// A vehicle that is there and says that it stands, without a goal.
  void arrive(const std::string& id, const Pose2& pose) {
    fleet::Vehicle vehicle;
    vehicle.id = id;
    vehicle.footprint = geometry::disc(kRadiusM);
    planner_.set_vehicle(vehicle);
    poses_[id] = pose;
    says_[id].agv_id = id;
    run(0.1);
  }

  void send_goal(const std::string& id, const std::string& goal, const Pose2& pose, bool is_cancelled = false) {
    planner_.set_goal({id, goal, pose, 0.1, 0.0, is_cancelled});
  }

  /// Time goes on; vehicles speak ten times a second, and the planner works whenever it may.
  void run(double seconds) {
    for (double left_s = seconds; left_s > 1e-9; left_s -= 0.1) {
      now_ += from_seconds(0.1);
      for (auto& [id, status] : says_) {
        fleet::VehicleState state;
        state.agv_id = id;
        state.motion.base_in_map = poses_[id];
        planner_.set_state(state, now_);
        planner_.set_navigation(status, 1, now_);
      }
      do {
        const FleetOrders orders = planner_.step(now_, nullptr);
        for (const Plan& plan : orders.plans) plans_[plan.agv_id].push_back(plan);
        for (const fleet::Grant& grant : orders.grants) grants_[grant.agv_id] = grant;
      } while (planner_.is_busy());
    }
  }

  const Plan& newest_plan(const std::string& id) { return plans_.at(id).back(); }

  /// The vehicle is at the end of what it was granted, and says so.
  void drive_to_limit(const std::string& id) {
    const Plan& plan = newest_plan(id);
    const fleet::Grant& grant = grants_.at(id);
    fleet::NavigationStatus& status = says_[id];
    status.goal_id = plan.goal_id;
    status.plan_id = plan.id;
    status.step_done = status.limit_step = grant.limit_step;
    status.grant_number = grant.number;

    double left_m = grant.limit_m;
    for (std::size_t i = 1; i < plan.waypoints_in_map.size(); ++i) {
      const Point2 from = plan.waypoints_in_map[i - 1], to = plan.waypoints_in_map[i];
      const double leg_m = geometry::distance(from, to);
      const Point2 at = leg_m > 0.0 ? from + std::min(1.0, left_m / leg_m) * (to - from) : to;
      poses_[id] = {at.x, at.y, 0.0};
      left_m -= leg_m;
      if (left_m <= 1e-9) break;
    }
  }

  bool is_near_its_way(const std::string& id, Point2 place, double nearest_m) {
    const std::vector<Point2>& way = newest_plan(id).waypoints_in_map;
    for (std::size_t i = 1; i < way.size(); ++i)
      if (geometry::distance_to_segment(place, way[i - 1], way[i]) < nearest_m) return true;
    return false;
  }

  grid::OccupancyGrid grid_;
  TrafficPlanner planner_;
  std::uint64_t revision_{0};
  time::Stamp now_{from_seconds(100.0)};
  std::map<std::string, Pose2> poses_;
  std::map<std::string, fleet::NavigationStatus> says_;
  std::map<std::string, std::vector<Plan>> plans_;
  std::map<std::string, fleet::Grant> grants_;  // the newest
};

TEST_F(TrafficFleet, AStatusThatTellsOfMoreRoadThanThereCanBeIsNotBelieved) {
  arrive("agv-1", {1.0, 5.0, 0.0});
  arrive("agv-2", {1.0, 8.0, 0.0});
  run(0.5);

  fleet::NavigationStatus& bad = says_["agv-2"];
  const fleet::NavigationStatus good = bad;
  bad.held = {{{1.0, 8.0, 0.0}, 0}, {{2.0, 8.0, 0.0}, 1}};
  bad.limit_step = std::uint64_t{1} << 62;
  run(0.3);
  bad = good;
  bad.held = {{{1.0, 8.0, 0.0}, 0}, {{1e6, 8.0, 0.0}, 0}};
  run(0.3);
  bad = good;
  bad.grant_number = ~std::uint64_t{0};
  run(0.3);

  const std::vector<std::string> events = planner_.take_events();
  const auto is_told = [](const std::string& event) { return event.find("not believed") != std::string::npos; };
  EXPECT_EQ(std::count_if(events.begin(), events.end(), is_told), 1) << "once";
  bad = good;
  send_goal("agv-2", "goal-2", {5.0, 8.0, 0.0});
  run(1.0);
  EXPECT_TRUE(grants_.count("agv-2")) << "believed again, it drives";
}

TEST_F(TrafficFleet, AloneAVehicleIsGrantedItsOwnWayToTheEndAndAnyFloorBesideIt) {
  arrive("agv-1", {1.0, 5.0, 0.0});
  send_goal("agv-1", "goal-1", {19.0, 5.0, 0.0});
  run(0.2);

  const Plan& plan = newest_plan("agv-1");
  EXPECT_TRUE(plan.is_found());
  EXPECT_EQ(plan.trigger, PlanTrigger::kNewGoal);
  EXPECT_EQ(plan.goal_id, "goal-1");
  EXPECT_EQ(plan.goal_in_map.x, 19.0);
  EXPECT_EQ(plan.map_revision, 1U);
  EXPECT_NEAR(plan.length_m, 18.0, 0.01);
  EXPECT_EQ(plan.tube_m, 0.0);
  ASSERT_FALSE(plan.step_ends_m.empty());
  EXPECT_EQ(std::count(plan.own_steps.begin(), plan.own_steps.end(), 1),
            static_cast<std::ptrdiff_t>(plan.step_ends_m.size()));

  const fleet::Grant& grant = grants_.at("agv-1");
  EXPECT_EQ(grant.plan_id, plan.id);
  EXPECT_EQ(grant.limit_step, plan.first_step + plan.step_ends_m.size());
  EXPECT_NEAR(grant.limit_m, 18.0, 0.01);
}

TEST_F(TrafficFleet, NamesWhatIsWrongWithAGoalAndGrantsNothing) {
  arrive("agv-1", {1.0, 5.0, 0.0});
  send_goal("agv-1", "a", {10.1, 2.0, 0.0});
  run(0.2);
  EXPECT_EQ(newest_plan("agv-1").outcome, PlanOutcome::kGoalBlocked);
  EXPECT_NE(newest_plan("agv-1").detail.find("the goal (10.10, 2.00) has 0.00 m of clearance"), std::string::npos);
  EXPECT_TRUE(newest_plan("agv-1").step_ends_m.empty());
  const std::uint64_t refused = newest_plan("agv-1").id;

  send_goal("agv-1", "b", {30.0, 2.0, 0.0});
  run(0.2);
  EXPECT_EQ(newest_plan("agv-1").outcome, PlanOutcome::kOutOfMap);
  EXPECT_EQ(planner_.status(now_).with_goal, 0U);

  send_goal("agv-1", "c", {5.0, 5.0, 0.0});
  run(0.2);
  EXPECT_TRUE(newest_plan("agv-1").is_found());
  EXPECT_GT(newest_plan("agv-1").id, refused);
  EXPECT_EQ(grants_.at("agv-1").plan_id, newest_plan("agv-1").id);
}

TEST_F(TrafficFleet, SaysThatAGoalIsCancelledAndPlansForTheNext) {
  arrive("agv-1", {1.0, 5.0, 0.0});
  send_goal("agv-1", "goal-1", {19.0, 5.0, 0.0});
  run(0.2);
  send_goal("agv-1", "goal-1", {19.0, 5.0, 0.0}, true);
  run(0.2);
  EXPECT_EQ(newest_plan("agv-1").outcome, PlanOutcome::kCancelled);
  EXPECT_EQ(newest_plan("agv-1").goal_id, "goal-1");

  send_goal("agv-1", "goal-2", {19.0, 5.0, 0.0});
  run(1.5);
  EXPECT_TRUE(newest_plan("agv-1").is_found());
  EXPECT_EQ(newest_plan("agv-1").goal_id, "goal-2");
}

/// agv-2 becomes known 0.1 s after agv-1, and stands on its way.
TEST_F(TrafficFleet, AFleetThatBeginsTogetherIsKnownBeforeTheFirstRoadIsGranted) {
  send_goal("agv-1", "goal-1", {9.0, 5.0, 0.0});
  arrive("agv-1", {1.0, 5.0, 0.0});
  arrive("agv-2", {2.5, 5.0, 0.0});
  EXPECT_EQ(grants_.count("agv-1"), 0U);
  run(0.5);
  EXPECT_GT(grants_.at("agv-1").limit_m, 0.0);
  EXPECT_FALSE(grants_.at("agv-1").gives_back);
}

TEST_F(TrafficFleet, AmongOthersAVehicleKeepsToItsTube) {
  arrive("agv-1", {1.0, 5.0, 0.0});
  send_goal("agv-1", "goal-1", {9.0, 5.0, 0.0});
  run(0.2);
  const Plan plan = newest_plan("agv-1");
  EXPECT_EQ(plan.tube_m, 0.0);
  arrive("agv-2", {1.0, 1.0, 0.0});
  run(0.5);
  EXPECT_EQ(newest_plan("agv-1").waypoints_in_map, plan.waypoints_in_map);
  EXPECT_GT(newest_plan("agv-1").id, plan.id) << "its status is to say that it has the tube";
  EXPECT_EQ(newest_plan("agv-1").tube_m, 0.10);
}

TEST_F(TrafficFleet, AnEditElsewhereKeepsThePlanUnderTheNewRevision) {
  arrive("agv-1", {1.0, 5.0, 0.0});
  send_goal("agv-1", "goal-1", {19.0, 5.0, 0.0});
  run(0.2);
  const Plan before = newest_plan("agv-1");
  block(2.0, 1.0, 3.0, 2.0);
  publish_map();
  run(0.2);
  EXPECT_EQ(newest_plan("agv-1").id, before.id);
  EXPECT_EQ(newest_plan("agv-1").waypoints_in_map, before.waypoints_in_map);
  EXPECT_EQ(newest_plan("agv-1").map_revision, 2U);
}

TEST_F(TrafficFleet, SaysThatAnEditLeavesNoWay) {
  arrive("agv-1", {1.0, 5.0, 0.0});
  send_goal("agv-1", "goal-1", {19.0, 5.0, 0.0});
  run(0.2);
  block(10.0, 0.0, 10.2, 10.0);
  publish_map();
  run(0.5);
  EXPECT_EQ(newest_plan("agv-1").outcome, PlanOutcome::kNoPath);
  EXPECT_NE(newest_plan("agv-1").detail.find("no way from"), std::string::npos);
}

TEST_F(TrafficFleet, GoesAroundAStaticTrackUntilTheSpotWasSeenFree) {
  const Disc box{{6.0, 5.0}, 0.4};
  arrive("agv-1", {1.0, 5.0, 0.0});
  planner_.set_static_track(7, box, now_);
  send_goal("agv-1", "goal-1", {9.0, 5.0, 0.0});
  run(0.5);
  EXPECT_FALSE(is_near_its_way("agv-1", box.center_in_map, box.radius_m + kRadiusM));

  // Forgotten is not gone.
  planner_.drop_track(7, now_);
  run(2.0);
  const auto plan_to = [&](const std::string& goal, const Pose2& pose) {
    send_goal("agv-1", goal, pose);
    run(1.5);
    drive_to_limit("agv-1");
    says_["agv-1"].phase = Phase::kArrived;
    run(0.3);
  };
  plan_to("goal-2", {9.0, 5.0, 0.0});
  EXPECT_FALSE(is_near_its_way("agv-1", box.center_in_map, box.radius_m + kRadiusM));

  fleet::CoverageTile tile;
  tile.cell_m = 1.0;
  tile.width_cells = tile.height_cells = 20;
  tile.ages.assign(400, 0);
  run(1.0);
  planner_.set_coverage(tile, now_);
  run(0.2);
  plan_to("goal-3", {1.0, 5.0, 0.0});
  EXPECT_TRUE(is_near_its_way("agv-1", box.center_in_map, 0.1));
}

/// The search keeps margin_m from what stands, and the shapes of a way are wider than that.
TEST_F(TrafficFleet, AVehiclesOwnWayLeadsAroundAStaticTrack) {
  arrive("agv-1", {2.0, 5.0, 0.0});
  planner_.set_static_track(7, {{5.0, 5.0}, 0.4}, now_);
  send_goal("agv-1", "goal-1", {8.0, 5.0, 0.0});
  run(1.0);

  const Plan& plan = newest_plan("agv-1");
  ASSERT_TRUE(plan.is_found());
  EXPECT_EQ(std::count(plan.own_steps.begin(), plan.own_steps.end(), 0), 0);
  EXPECT_LT(plan.length_m, 6.4) << "straight it is 6 m";
}

TEST_F(TrafficFleet, AnIdleVehicleInTheWayIsMovedWithoutAGoal) {
  block(0.0, 6.0, 10.0, 6.2);
  block(0.0, 3.8, 10.0, 4.0);
  publish_map();
  arrive("agv-1", {1.0, 5.0, 0.0});
  arrive("agv-2", {10.1, 5.0, 0.0});  // in the door
  send_goal("agv-1", "goal-1", {15.0, 5.0, 0.0});
  run(3.0);
  ASSERT_EQ(plans_.count("agv-2"), 1U);
  EXPECT_EQ(newest_plan("agv-2").goal_id, "");
  EXPECT_TRUE(newest_plan("agv-2").is_found());
  EXPECT_EQ(newest_plan("agv-2").goal_in_map.position(), newest_plan("agv-2").waypoints_in_map.back());
}

TEST_F(TrafficFleet, AReachedGoalThatIsGivenAgainIsDrivenToAgainOnceTheVehicleWasMovedAway) {
  block(0.0, 6.0, 10.0, 6.2);
  block(0.0, 3.8, 10.0, 4.0);
  publish_map();
  const Pose2 door{10.1, 5.0, 0.0};
  arrive("agv-1", {7.0, 5.0, 0.0});
  send_goal("agv-1", "goal-1", door);
  run(1.0);
  drive_to_limit("agv-1");
  says_["agv-1"].phase = fleet::Phase::kArrived;
  run(1.0);

  // Its word that it is there may not have come yet.
  const std::size_t plans = plans_["agv-1"].size();
  send_goal("agv-1", "goal-1", door);
  run(1.0);
  ASSERT_EQ(plans_["agv-1"].size(), plans);

  arrive("agv-2", {1.0, 5.0, 0.0});
  send_goal("agv-2", "goal-2", {15.0, 5.0, 0.0});
  run(3.0);
  ASSERT_EQ(newest_plan("agv-1").goal_id, "");
  drive_to_limit("agv-1");
  run(1.0);

  send_goal("agv-1", "goal-1", door);
  run(1.0);
  EXPECT_EQ(newest_plan("agv-1").goal_id, "goal-1");
}

/// Two vehicles, of which agv-2 falls silent with road ahead; then another planner leads.
class TakenOver : public TrafficFleet {
 protected:
  TakenOver() {
    arrive("agv-1", {1.0, 5.0, 0.0});
    arrive("agv-2", {1.0, 1.0, 0.0});
    send_goal("agv-1", "goal-1", {5.0, 5.0, 0.0});
    send_goal("agv-2", "goal-2", {5.0, 1.0, 0.0});
    run(0.5);
    grants_.clear();
    says_.erase("agv-2");
    lead_with(2);
  }

  /// The new leader and its epoch are heard by all who speak.
  void lead_with(std::uint32_t epoch) {
    planner_.take_over(now_, {epoch, kBoot});
    for (auto& [id, status] : says_) {
      status.traffic_epoch = epoch;
      status.traffic_boot_id = kBoot;
    }

    epoch_ = epoch;
  }

  void speak_again(const std::string& id) {
    says_[id].agv_id = id;
    says_[id].traffic_epoch = epoch_;
    says_[id].traffic_boot_id = kBoot;
  }

  static constexpr std::uint64_t kBoot = 50;
  std::uint32_t epoch_{0};

  bool has_road(const std::string& id) const {
    const auto grant = grants_.find(id);
    return grant != grants_.end() && grant->second.limit_m > 0.0;
  }

  std::vector<std::string> silent() const {
    std::vector<std::string> ids;
    for (const fleet::SilentVehicle& vehicle : planner_.status(now_).silent) ids.push_back(vehicle.agv_id);
    return ids;
  }
};

TEST_F(TakenOver, NobodyHasRoadUntilEachVehicleWasHeard) {
  run(30.0);
  EXPECT_FALSE(has_road("agv-1"));
  EXPECT_EQ(grants_.at("agv-1").waits_for, std::vector<std::string>{"agv-2"});
  EXPECT_EQ(grants_.at("agv-1").reason.rfind("agv-2 was not heard yet", 0), 0U);
  EXPECT_EQ(silent(), std::vector<std::string>{"agv-2"});

  speak_again("agv-2");
  run(1.5);
  EXPECT_TRUE(has_road("agv-1"));
  EXPECT_TRUE(has_road("agv-2"));
  EXPECT_EQ(newest_plan("agv-1").trigger, PlanTrigger::kTakeover);
}

TEST_F(TakenOver, AVehicleThatIsSignedOffHoldsWhereItStandsAndNobodyWaitsForIt) {
  run(4.0);
  planner_.sign_off({"agv-2", std::nullopt}, now_);
  run(1.5);
  EXPECT_TRUE(has_road("agv-1"));
  EXPECT_FALSE(has_road("agv-2"));
  EXPECT_TRUE(silent().empty());

  send_goal("agv-1", "goal-3", {1.2, 1.0, 0.0});
  run(2.0);
  EXPECT_FALSE(newest_plan("agv-1").goal_id == "goal-3") << "agv-2 stands there";

  // Heard again, it takes part again.
  speak_again("agv-2");
  run(3.0);
  EXPECT_TRUE(has_road("agv-2"));
}

TEST_F(TakenOver, ASignOffOutlivesTheNextTakeover) {
  planner_.sign_off({"agv-2", std::nullopt}, now_ + from_seconds(3.0));
  lead_with(3);
  run(4.0);
  EXPECT_TRUE(has_road("agv-1"));
}

/// Its word is of before the takeover: a grant of the former leader may still reach it.
TEST_F(TakenOver, AWordOfAVehicleThatHasNotHeardOfTheNewLeaderDoesNotCount) {
  speak_again("agv-2");
  says_["agv-2"].traffic_epoch = 1;
  run(5.0);
  EXPECT_FALSE(has_road("agv-1"));
  EXPECT_FALSE(has_road("agv-2"));

  says_["agv-2"].traffic_epoch = 2;
  run(1.5);
  EXPECT_TRUE(has_road("agv-1"));
  EXPECT_TRUE(has_road("agv-2"));
}

/// Another planner leads with the same epoch on its side of a network that was split.
TEST_F(TakenOver, AWordOfAVehicleThatObeysAnotherPlannerOfThisEpochDoesNotCount) {
  speak_again("agv-2");
  says_["agv-2"].traffic_boot_id = kBoot - 1;
  run(5.0);
  EXPECT_FALSE(has_road("agv-1"));

  says_["agv-2"].traffic_boot_id = kBoot;
  run(1.5);
  EXPECT_TRUE(has_road("agv-1"));
}

TEST_F(TakenOver, ASignOffIsToldWithThePlaceThatThePersonNames) {
  run(4.0);
  planner_.sign_off({"agv-2", std::nullopt}, now_);
  ASSERT_EQ(planner_.status(now_).signed_off.size(), 1U);
  EXPECT_EQ(planner_.status(now_).signed_off[0].place_in_map, (geometry::Point2{1.0, 1.0}))
      << "where it was heard last";

  planner_.sign_off({"agv-2", geometry::Point2{9.0, 9.0}}, now_);
  EXPECT_EQ(planner_.status(now_).signed_off[0].place_in_map, (geometry::Point2{9.0, 9.0}));

  speak_again("agv-2");
  run(0.2);
  EXPECT_TRUE(planner_.status(now_).signed_off.empty());
}

/// Its build is known, and no word of it was ever heard. Its driver goes on telling its build.
TEST_F(TakenOver, ASignedOffVehicleOfWhichNothingIsKnownHoldsUpNobody) {
  speak_again("agv-2");
  fleet::Vehicle silent;
  silent.id = "agv-3";
  planner_.set_vehicle(silent);
  run(4.0);
  EXPECT_FALSE(has_road("agv-1"));

  planner_.sign_off({"agv-3", std::nullopt}, now_);
  planner_.set_vehicle(silent);
  run(1.5);
  EXPECT_TRUE(has_road("agv-1"));
}

TEST_F(TakenOver, AVehicleThatIsHeardIsNotSignedOff) {
  planner_.sign_off({"agv-1", std::nullopt}, now_);
  speak_again("agv-2");
  run(1.5);
  EXPECT_TRUE(has_road("agv-1"));
}

/// The goal of a vehicle that nobody hears was there before this planner, which has forgotten all.
TEST_F(TrafficFleet, AVehicleThatOnlyItsGoalTellsOfMayBeAnywhere) {
  send_goal("agv-9", "goal-9", {5.0, 9.0, 0.0});
  send_goal("agv-1", "goal-1", {5.0, 5.0, 0.0});
  arrive("agv-1", {1.0, 5.0, 0.0});
  run(10.0);
  EXPECT_EQ(grants_.at("agv-1").limit_m, 0.0);
  EXPECT_EQ(grants_.at("agv-1").waits_for, std::vector<std::string>{"agv-9"});

  planner_.sign_off({"agv-9", std::nullopt}, now_);
  run(1.5);
  EXPECT_GT(grants_.at("agv-1").limit_m, 0.0);

  send_goal("agv-8", "goal-8", {5.0, 9.0, 0.0});
  send_goal("agv-1", "goal-2", {1.0, 5.0, 0.0});
  run(1.5);
  EXPECT_EQ(newest_plan("agv-1").goal_id, "goal-2") << "a goal for a vehicle that is not there holds up nobody later";
}

TEST_F(TrafficFleet, ACancelledGoalOfAnUnknownVehicleIsNoVehicle) {
  arrive("agv-1", {1.0, 5.0, 0.0});
  send_goal("agv-1", "goal-1", {5.0, 5.0, 0.0});
  run(1.0);
  send_goal("agv-9", "goal-9", {5.0, 9.0, 0.0});
  send_goal("agv-9", "goal-9", {5.0, 9.0, 0.0}, true);
  send_goal("agv-8", "goal-8", {5.0, 9.0, 0.0}, true);
  run(1.0);
  EXPECT_EQ(planner_.status(now_).vehicles, 1U);
  EXPECT_EQ(plans_.count("agv-9") + plans_.count("agv-8"), 0U);
}

TEST_F(TrafficFleet, MoreVehiclesThanItHoldsAreRefusedByName) {
  fleet::Vehicle vehicle;
  for (int i = 1; i <= 1001; ++i) {
    vehicle.id = "cart-" + std::to_string(i);
    planner_.set_vehicle(vehicle);
  }

  EXPECT_EQ(planner_.status(now_).vehicles, 1000U);
  EXPECT_EQ(planner_.take_events().back(), "cart-1001 is refused: 1000 vehicles are the most");
}

FleetSettings as_printed() {
  FleetSettings settings;
  settings.as_printed = true;
  return settings;
}

class PrintedFleet : public TrafficFleet {
 protected:
  PrintedFleet() : TrafficFleet(as_printed()) {}
};

TEST_F(PrintedFleet, HasPlansWithoutStepsAndNoGrants) {
  arrive("agv-1", {1.0, 5.0, 0.0});
  planner_.set_static_track(7, {{6.0, 5.0}, 0.4}, now_);
  send_goal("agv-1", "goal-1", {19.0, 5.0, 0.0});
  run(5.0);
  ASSERT_EQ(plans_.at("agv-1").size(), 1U);
  EXPECT_TRUE(newest_plan("agv-1").step_ends_m.empty());
  EXPECT_TRUE(is_near_its_way("agv-1", {6.0, 5.0}, 0.1)) << "by the map alone";
  EXPECT_TRUE(grants_.empty());
}

/// agv-1 in the left half, and a zone.
class ZonedFleet : public TrafficFleet {
 protected:
  ZonedFleet() { arrive("agv-1", {3.0, 5.0, 0.0}); }

  void set_zone(fleet::Zone::Kind kind, Point2 low, Point2 high, double direction_rad = 0.0) {
    zone_.id = "dock";
    zone_.kind = kind;
    zone_.points_in_map = {low, high};
    zone_.direction_rad = direction_rad;
    planner_.set_zones({zone_}, now_);
  }

  fleet::Zone zone_;
};

TEST_F(ZonedFleet, AGoalWhereNobodyMayEnterOrStopIsRefusedByTheZonesName) {
  for (const fleet::Zone::Kind kind : {fleet::Zone::Kind::kKeepOut, fleet::Zone::Kind::kNoStopping}) {
    set_zone(kind, {14.0, 4.0}, {18.0, 6.0});
    send_goal("agv-1", fleet::name(kind), {18.1, 5.0, 0.0});
    run(1.0);
    EXPECT_EQ(newest_plan("agv-1").outcome, PlanOutcome::kGoalBlocked);
    EXPECT_NE(newest_plan("agv-1").detail.find(std::string(fleet::name(kind)) + " zone dock"), std::string::npos)
        << newest_plan("agv-1").detail;
  }

  planner_.set_zones({}, now_);
  run(1.0);
  EXPECT_TRUE(newest_plan("agv-1").is_found());
}

TEST_F(ZonedFleet, AKeepOutZoneThatIsMadeUnderWayActsLikeAnEdit) {
  send_goal("agv-1", "goal", {17.0, 5.0, 0.0});
  run(1.0);
  ASSERT_TRUE(is_near_its_way("agv-1", {10.1, 5.0}, 0.5));

  set_zone(fleet::Zone::Kind::kKeepOut, {9.5, 3.5}, {10.7, 6.5});
  for (int i = 0; i < 40 && !is_near_its_way("agv-1", {10.1, 8.9}, 0.6); ++i) {
    says_["agv-1"].grant_number = grants_.at("agv-1").number;
    says_["agv-1"].limit_step = grants_.at("agv-1").limit_step;
    run(0.1);
  }
  EXPECT_TRUE(is_near_its_way("agv-1", {10.1, 8.9}, 0.6));
  EXPECT_FALSE(is_near_its_way("agv-1", {10.1, 5.0}, 1.0));
}

TEST_F(ZonedFleet, AVehicleThatStandsInAKeepOutZoneLeavesIt) {
  set_zone(fleet::Zone::Kind::kKeepOut, {2.0, 4.0}, {4.0, 6.0});
  send_goal("agv-1", "goal", {7.0, 5.0, 0.0});
  run(1.0);
  ASSERT_TRUE(newest_plan("agv-1").is_found());
  EXPECT_GT(grants_.at("agv-1").limit_m, 1.0);
}

TEST_F(ZonedFleet, AOneWayZoneIsNotPassedTheWrongWay) {
  set_zone(fleet::Zone::Kind::kOneWay, {9.0, 3.5}, {11.2, 6.5}, geometry::kPi);
  send_goal("agv-1", "goal", {17.0, 5.0, 0.0});
  run(1.0);
  EXPECT_TRUE(is_near_its_way("agv-1", {10.1, 8.9}, 0.6));
}

TEST_F(ZonedFleet, AOneWayZoneIsPassedTheRightWay) {
  set_zone(fleet::Zone::Kind::kOneWay, {9.0, 3.5}, {11.2, 6.5});
  send_goal("agv-1", "goal", {17.0, 5.0, 0.0});
  run(1.0);
  EXPECT_TRUE(is_near_its_way("agv-1", {10.1, 5.0}, 0.6));
}

TEST_F(ZonedFleet, NoStepEndsWhereNobodyMayStop) {
  arrive("agv-2", {17.0, 2.0, 0.0});
  set_zone(fleet::Zone::Kind::kNoStopping, {8.0, 0.0}, {13.0, 10.0});
  send_goal("agv-1", "goal", {17.0, 5.0, 0.0});
  run(1.0);
  const Plan& plan = newest_plan("agv-1");
  ASSERT_TRUE(plan.is_found());

  for (const double end_m : plan.step_ends_m) {
    double left_m = end_m;
    for (std::size_t i = 1; i < plan.waypoints_in_map.size(); ++i) {
      const Point2 from = plan.waypoints_in_map[i - 1], to = plan.waypoints_in_map[i];
      const double leg_m = geometry::distance(from, to);
      if (left_m <= leg_m + 1e-9) {
        const Point2 at = from + (leg_m > 0.0 ? left_m / leg_m : 0.0) * (to - from);
        EXPECT_GE(fleet::distance_m(zone_, at, at), kRadiusM) << at.x << " " << at.y;
        break;
      }
      left_m -= leg_m;
    }
  }
}

TEST_F(ZonedFleet, ZonesThatAreMadeUnderWayAreObeyedBehindTheRoadThatIsGranted) {
  arrive("agv-2", {17.0, 1.5, 0.0});
  for (const fleet::Zone::Kind kind : {fleet::Zone::Kind::kNoStopping, fleet::Zone::Kind::kOneVehicle}) {
    const bool leads_right = poses_.at("agv-1").x < 10.0;
    const std::string goal = fleet::name(kind);
    send_goal("agv-1", goal, {leads_right ? 17.0 : 3.0, 5.0, 0.0});
    run(1.0);
    set_zone(kind, {8.0, 0.0}, {13.0, 10.0});

    for (int i = 0; i < 40 && geometry::distance(poses_.at("agv-1").position(), {leads_right ? 17.0 : 3.0, 5.0}) > 0.1;
         ++i) {
      run(0.3);
      drive_to_limit("agv-1");
      const Point2 at = poses_.at("agv-1").position();
      const bool may_stop = kind != fleet::Zone::Kind::kNoStopping || fleet::distance_m(zone_, at, at) >= kRadiusM;
      EXPECT_TRUE(may_stop) << at.x;
    }
    EXPECT_NEAR(poses_.at("agv-1").x, leads_right ? 17.0 : 3.0, 0.1) << goal;
  }
  EXPECT_EQ(planner_.status(now_).refused, 0u);
  EXPECT_EQ(planner_.status(now_).circles, 0u);
}

TEST_F(ZonedFleet, AVehicleWaitsOutsideAZoneForOneUntilTheOtherIsOut) {
  arrive("agv-2", {14.0, 5.0, 0.0});
  set_zone(fleet::Zone::Kind::kOneVehicle, {8.0, 0.0}, {15.0, 10.0});
  send_goal("agv-1", "goal", {18.0, 8.0, 0.0});
  for (int i = 0; i < 20; ++i) {
    run(0.3);
    if (grants_.count("agv-1") > 0) drive_to_limit("agv-1");
  }
  EXPECT_LT(poses_.at("agv-1").x, 8.0 - kRadiusM) << "agv-2 stands in the zone";
  EXPECT_EQ(grants_.at("agv-1").waits_for, std::vector<std::string>{"agv-2"});

  for (int i = 0; i < 30; ++i) {
    run(0.3);
    for (const std::string id : {"agv-1", "agv-2"})
      if (grants_.count(id) > 0 && plans_.count(id) > 0) drive_to_limit(id);
  }
  EXPECT_NEAR(poses_.at("agv-1").x, 18.0, 0.1) << "agv-2 was sent out of the zone";
}

}  // namespace
}  // namespace aisle::global_planner
