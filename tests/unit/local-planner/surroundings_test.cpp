#include "services/local-planner/core/surroundings.hpp"

#include <gtest/gtest.h>

namespace aisle::local_planner {
namespace {

using geometry::Point2;
using time::from_seconds;

constexpr time::Stamp kNow = std::chrono::seconds(100);

SeenTrack track(Point2 position, Point2 velocity, bool is_static = false) {
  SeenTrack seen;
  seen.track.position_in_map = position;
  seen.track.velocity_in_map = velocity;
  seen.track.is_static = is_static;
  seen.arrived = kNow;
  return seen;
}

Peer peer(const std::string& id, geometry::Pose2 base, double speed_mps) {
  Peer p;
  p.id = id;
  p.state = {base, {speed_mps, 0.0, 0.0}};
  p.state_arrived = kNow;
  return p;
}

Surroundings observe(Observer& observer, const Inputs& inputs, double later_s = 0.0) {
  return observer.observe(inputs, {3.0, 5.0}, kNow + from_seconds(later_s));
}

TEST(Surroundings, CarryPeopleOnToWhenTheCommandActs) {
  Observer observer{SurroundingsSettings{}};
  Inputs inputs;
  inputs.tracks = {track({2.0, 3.0}, {1.0, 0.0})};
  const Surroundings around = observe(observer, inputs, 0.1);  // 0.1 s old, 0.05 s on the way, 0.1 s of dead time
  ASSERT_EQ(around.movers.size(), 1U);
  EXPECT_NEAR(around.movers[0].position_in_map.x, 2.25, 1e-9);
  EXPECT_TRUE(around.standing.empty());
}

TEST(Surroundings, PeopleAreLessCertainThanThings) {
  Observer observer{SurroundingsSettings{}};
  Inputs inputs;
  inputs.tracks = {track({2.0, 3.0}, {1.0, 0.0}), track({4.0, 3.0}, {}, true)};
  const Surroundings around = observe(observer, inputs);
  EXPECT_GT(around.movers[0].margin_m, around.movers[1].margin_m);
  EXPECT_GT(around.movers[0].growth_mps, around.movers[1].growth_mps);
  ASSERT_EQ(around.standing.size(), 1U);
  EXPECT_DOUBLE_EQ(around.standing[0].disc.position.x, 4.0);
}

TEST(Surroundings, RememberWhoHasWalkedWhileTheyAreTracked) {
  Observer observer{SurroundingsSettings{}};
  Inputs inputs;
  const auto has_walked = [&](Point2 position) {
    inputs.tracks = {track(position, {}, true)};
    return observe(observer, inputs).movers[0].has_walked;
  };
  EXPECT_FALSE(has_walked({2.0, 3.0}));
  EXPECT_FALSE(has_walked({2.3, 3.0}));  // another view of a thing
  EXPECT_TRUE(has_walked({3.0, 3.0}));
  EXPECT_TRUE(has_walked({3.0, 3.0}));
  inputs.tracks.clear();
  observe(observer, inputs);
  EXPECT_FALSE(has_walked({3.0, 3.0}));  // another track
}

TEST(Surroundings, KnowWhereAPeerCanStop) {
  Observer observer{SurroundingsSettings{}};
  Inputs inputs;
  inputs.peers = {peer("agv-2", {5.0, 5.0, 0.0}, 1.2)};
  const Surroundings around = observe(observer, inputs);
  const auto& stopping = around.peer_motions[0].stopping_in_map;
  EXPECT_EQ(stopping.front(), (Point2{5.0, 5.0}));
  EXPECT_GT(stopping.back().x, 5.0 + 0.6);  // v^2 / 2a, and what it drives before it reacts
  EXPECT_LT(stopping.back().x, 5.0 + 1.3);
}

TEST(Surroundings, ASilentPeerStands) {
  Observer observer{SurroundingsSettings{}};
  Inputs inputs;
  inputs.peers = {peer("agv-2", {5.0, 5.0, 0.0}, 1.2)};
  const Surroundings around = observe(observer, inputs, 1.0);
  EXPECT_EQ(around.peer_motions[0].stopping_in_map.front(), (Point2{5.0, 5.0}));
}

TEST(Surroundings, HoldNoPeerThatIsFarAway) {
  Observer observer{SurroundingsSettings{}};
  Inputs inputs;
  inputs.peers = {peer("agv-2", {8.9, 5.0, 0.0}, 1.2), peer("agv-3", {9.1, 5.0, 0.0}, 1.2)};
  EXPECT_EQ(observe(observer, inputs).peer_motions.size(), 1U);
}

TEST(Surroundings, APeerIsDrivenAroundOnlyWhenItStandsForLong) {
  Observer observer{SurroundingsSettings{}};
  Inputs inputs;
  for (int i = 0; i <= 50; ++i) {
    Peer standing = peer("agv-2", {5.0, 5.0, 0.0}, 0.0);
    standing.state_arrived = kNow + from_seconds(0.1 * i);
    inputs.peers = {standing};
    const Surroundings around = observe(observer, inputs, 0.1 * i);
    EXPECT_EQ(around.standing.empty(), 0.1 * i <= SurroundingsSettings{}.peer_patience_s + 1e-6) << i;
  }
}

}  // namespace
}  // namespace aisle::local_planner
