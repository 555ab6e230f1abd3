// What only a simulated network can show: loss, cuts, crashes, clocks, and the same run for the same seed. The rules it
// shares with DDS are in tests/integration/bus/conformance.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include "common/bus/simulated/network.hpp"

namespace aisle::bus_test {
namespace {

using namespace std::chrono_literals;
using bus::SampleInfo;
using bus::SampleKind;
using bus::simulated::Link;
using bus::simulated::Network;
using bus::simulated::SimulatedBus;

bus::Settings named(const std::string& name) {
  bus::Settings settings;
  settings.participant_name = name;
  return settings;
}

aisle::VehicleState state_of(double x_m) {
  aisle::VehicleState state;
  state.agv_id("agv-1");
  state.base_in_map().x_m(x_m);
  return state;
}

aisle::MapEdit edit_of(double radius_m) {
  aisle::MapEdit edit;
  edit.edit_id("edit");
  edit.radius_m(radius_m);
  return edit;
}

/// Two processes on hosts "a" and "b" that know each other; the network runs their loops.
struct Pair {
  explicit Pair(std::uint64_t seed = 1) : network(seed) {
    a = network.join(named("a"), "a");
    b = network.join(named("b"), "b");
    a->drive();
    b->drive();
    pass(100ms);
  }
  void pass(std::chrono::nanoseconds time) { network.advance_to(network.now() + time); }
  void set_both(const Link& link) {
    network.set_link("a", "b", link);
    network.set_link("b", "a", link);
  }
  /// a writes `count` states, one every 10 ms; the x of those that b heard, in order.
  std::vector<double> stream(int count) {
    std::vector<double> heard;
    b->on<topics::VehicleState>(
        [&](const aisle::VehicleState& state, const SampleInfo&) { heard.push_back(state.base_in_map().x_m()); });
    auto states = a->writer<topics::VehicleState>();
    pass(100ms);
    for (int i = 0; i < count; ++i) {
      states.write(state_of(i));
      pass(10ms);
    }
    pass(1s);
    return heard;
  }
  Network network;
  std::unique_ptr<SimulatedBus> a, b;
};

TEST(SimulatedNetwork, BestEffortLosesWhatTheLinkLoses) {
  Pair pair;
  Link lossy;
  lossy.loss = 0.1;
  pair.set_both(lossy);
  const std::size_t heard = pair.stream(5000).size();
  EXPECT_GT(heard, 4350U);
  EXPECT_LT(heard, 4650U);
  EXPECT_EQ(pair.network.tally().lost, 5000 - heard);
}

TEST(SimulatedNetwork, BestEffortTakesNothingTwiceAndNothingOvertaken) {
  Pair pair;
  Link disorderly;
  disorderly.duplicate = 0.3;
  disorderly.reorder = 0.2;
  disorderly.jitter = 5ms;
  pair.set_both(disorderly);
  const std::vector<double> heard = pair.stream(500);
  EXPECT_TRUE(std::is_sorted(heard.begin(), heard.end()));
  EXPECT_EQ(std::adjacent_find(heard.begin(), heard.end()), heard.end());
  EXPECT_LT(heard.size(), 480U) << "what was overtaken is dropped";
  EXPECT_GT(pair.network.tally().duplicated, 100U);
  EXPECT_GT(pair.network.tally().reordered, 50U);
}

TEST(SimulatedNetwork, ReliableSamplesPassABadLinkOnceAndInOrder) {
  Pair pair;
  std::vector<double> heard, sent;
  pair.b->on<topics::MapEdit>([&](const aisle::MapEdit& edit, const SampleInfo&) { heard.push_back(edit.radius_m()); });
  auto edits = pair.a->writer<topics::MapEdit>();
  pair.pass(100ms);
  Link bad;
  bad.loss = 0.3;
  bad.duplicate = 0.2;
  bad.reorder = 0.2;
  bad.jitter = 20ms;
  pair.set_both(bad);
  for (int i = 0; i < 300; ++i) {
    ASSERT_TRUE(edits.write(edit_of(i)));
    sent.push_back(i);
    pair.pass(5ms);
  }
  EXPECT_TRUE(edits.wait_until_acknowledged(20s));
  pair.pass(100ms);
  EXPECT_EQ(heard, sent);
  EXPECT_GT(pair.network.tally().resent, 50U);
}

TEST(SimulatedNetwork, OfStatesTheNewestPassesABadLink) {
  Pair pair;
  std::string newest;
  pair.b->on<topics::Goal>([&](const aisle::Goal& goal, const SampleInfo&) { newest = goal.goal_id().to_string(); });
  auto goals = pair.a->writer<topics::Goal>();
  pair.pass(100ms);
  Link bad;
  bad.loss = 0.5;
  pair.set_both(bad);
  aisle::Goal goal;
  for (int i = 0; i < 50; ++i) {
    goal.goal_id("goal-" + std::to_string(i));
    ASSERT_TRUE(goals.write(goal));
    pair.pass(1ms);
  }
  pair.pass(5s);
  EXPECT_EQ(newest, "goal-49");
}

TEST(SimulatedNetwork, AShortCutIsCaughtUpWith) {
  Pair pair;
  std::vector<double> heard;
  int ends = 0;
  pair.b->on<topics::MapEdit>([&](const aisle::MapEdit& edit, const SampleInfo&) { heard.push_back(edit.radius_m()); });
  pair.b->on<topics::Track>(
      [&](const aisle::Track&, const SampleInfo& info) { ends += info.kind != SampleKind::kData; });
  auto edits = pair.a->writer<topics::MapEdit>();
  auto tracks = pair.a->writer<topics::Track>();
  pair.pass(100ms);
  tracks.write(aisle::Track());
  pair.network.cut("a", "b");
  edits.write(edit_of(1));
  edits.write(edit_of(2));
  pair.pass(2s);
  EXPECT_TRUE(heard.empty());
  EXPECT_GT(pair.network.tally().cut, 0U);
  pair.network.heal("a", "b");
  pair.pass(200ms);
  EXPECT_EQ(heard, (std::vector<double>{1, 2}));
  EXPECT_EQ(ends, 0);
}

TEST(SimulatedNetwork, ACutInOneDirectionBeyondTheLeaseForgetsAndAHealDiscovers) {
  Pair pair;
  std::vector<std::string> heard;
  pair.b->on<topics::Goal>([&](const aisle::Goal& goal, const SampleInfo& info) {
    heard.push_back(info.kind == SampleKind::kData ? goal.goal_id().to_string() : "orphaned");
  });
  auto goals = pair.a->writer<topics::Goal>();
  aisle::Goal goal;
  goal.goal_id("first");
  goals.write(goal);
  pair.pass(100ms);
  pair.network.cut("a", "b");
  pair.pass(4900ms);
  EXPECT_EQ(pair.b->participants().size(), 1U);
  pair.pass(200ms);
  EXPECT_TRUE(pair.b->participants().empty());
  EXPECT_EQ(pair.a->participants().size(), 1U) << "what b says still comes through";
  EXPECT_EQ(heard, (std::vector<std::string>{"first", "orphaned"}));
  goal.goal_id("second");
  goals.write(goal);
  pair.network.heal("a", "b");
  pair.pass(1s);
  EXPECT_EQ(pair.b->participants().size(), 1U);
  EXPECT_EQ(heard.back(), "second");
  goal.goal_id("third");
  goals.write(goal);
  pair.pass(100ms);
  EXPECT_EQ(heard.back(), "third");
}

TEST(SimulatedNetwork, ALinkThatLosesAllIsACut) {
  Pair pair;
  Link lossy;
  lossy.loss = 1.0;
  pair.network.set_link("a", "b", lossy);
  pair.pass(4900ms);
  EXPECT_EQ(pair.b->participants().size(), 1U);
  pair.pass(200ms);
  EXPECT_TRUE(pair.b->participants().empty());
  const auto late = pair.network.join(named("late"), "a");
  pair.pass(2s);
  EXPECT_TRUE(pair.b->participants().empty()) << "nobody on a is discovered";
  pair.network.set_link("a", "b", Link{});
  pair.pass(1s);
  EXPECT_EQ(pair.b->participants().size(), 2U);
}

TEST(SimulatedNetwork, ASlowLinkDelaysDiscoveryAndMatching) {
  Pair pair;
  Link slow;
  slow.latency = 300ms;
  pair.network.set_link("a", "b", slow);
  const auto late = pair.network.join(named("late"), "a");
  pair.b->on<topics::VehicleState>([](const aisle::VehicleState&, const SampleInfo&) {});
  auto states = pair.a->writer<topics::VehicleState>();
  pair.pass(300ms);
  EXPECT_EQ(pair.b->participants().size(), 1U);
  EXPECT_EQ(states.matched_readers(), 0);
  pair.pass(30ms);
  EXPECT_EQ(pair.b->participants().size(), 2U);
  EXPECT_EQ(states.matched_readers(), 1);
}

TEST(SimulatedNetwork, AGoodbyeThatIsLostIsNotSaidAgain) {
  Pair pair;
  pair.network.cut("a", "b");
  pair.a.reset();
  pair.network.heal("a", "b");
  pair.pass(4900ms);
  EXPECT_EQ(pair.b->participants().size(), 1U) << "the lease has not run out";
  pair.pass(200ms);
  EXPECT_TRUE(pair.b->participants().empty());
}

TEST(SimulatedNetwork, AGoodbyeMayBeLostByChance) {
  Link lossy;
  lossy.loss = 0.5;
  int lost = 0;
  for (int i = 0; i < 20; ++i) {
    Pair pair(static_cast<std::uint64_t>(i) + 1);
    pair.set_both(lossy);
    pair.a.reset();
    pair.pass(1s);
    lost += pair.b->participants().empty() ? 0 : 1;
    pair.pass(5s);
    EXPECT_TRUE(pair.b->participants().empty());
  }
  EXPECT_GT(lost, 3);
  EXPECT_LT(lost, 17);
}

TEST(SimulatedNetwork, ACutLosesLiveliness) {
  Pair pair;
  int ends = 0, plans = 0;
  pair.b->on<topics::Plan>(
      [&](const aisle::Plan&, const SampleInfo& info) { (info.kind == SampleKind::kData ? plans : ends) += 1; });
  auto writer = pair.a->writer<topics::Plan>();
  pair.a->every(50ms, [&] { writer.write(aisle::Plan()); });
  pair.pass(500ms);
  EXPECT_GT(plans, 5);
  pair.network.cut("a", "b");
  pair.pass(260ms);
  EXPECT_EQ(ends, 1);
  const int before = plans;
  pair.network.heal("a", "b");
  pair.pass(200ms);
  EXPECT_GT(plans, before);
}

TEST(SimulatedNetwork, ADeadlineThatIsMissedGivesOwnershipToTheNext) {
  Pair pair;
  auto weak = pair.network.join(named("weak"), "c");
  weak->drive();
  const bus::Qos exclusive{
      bus::Reliability::kBestEffort, bus::Durability::kVolatile, 1, 0, 100ms, bus::Ownership::kExclusive, 0ms};
  for (SimulatedBus* bus : {pair.a.get(), pair.b.get(), weak.get()})
    bus->announce_as("vehicle_state", exclusive, "aisle::VehicleState");
  double heard = 0.0;
  pair.b->on<topics::VehicleState>(
      [&](const aisle::VehicleState& state, const SampleInfo&) { heard = state.base_in_map().x_m(); });
  auto strong_states = pair.a->writer<topics::VehicleState>(5);
  auto weak_states = weak->writer<topics::VehicleState>(1);
  bool speaks = true;
  pair.a->every(20ms, [&] {
    if (speaks) strong_states.write(state_of(5.0));
  });
  weak->every(20ms, [&] { weak_states.write(state_of(1.0)); });
  pair.pass(500ms);
  EXPECT_EQ(heard, 5.0);
  speaks = false;
  pair.pass(60ms);
  EXPECT_EQ(heard, 5.0);
  pair.pass(100ms);
  EXPECT_EQ(heard, 1.0);
  speaks = true;
  pair.pass(50ms);
  EXPECT_EQ(heard, 5.0);
}

TEST(SimulatedNetwork, ACrashedProcessFallsSilentAndARestartedOneIsMet) {
  Pair pair;
  int heard = 0;
  pair.b->on<topics::VehicleState>(
      [&](const aisle::VehicleState&, const SampleInfo& info) { heard += info.kind == SampleKind::kData; });
  auto states = pair.a->writer<topics::VehicleState>();
  pair.a->every(20ms, [&] { states.write(state_of(0.0)); });
  pair.pass(500ms);
  EXPECT_GT(heard, 10);
  pair.a->crash();
  EXPECT_TRUE(pair.a->has_crashed());
  EXPECT_FALSE(states.write(state_of(0.0)));
  pair.pass(1ms);
  const int before = heard;
  pair.pass(1s);
  EXPECT_EQ(heard, before);
  pair.a = pair.network.join(named("a"), "a");
  pair.a->drive();
  states = pair.a->writer<topics::VehicleState>();
  pair.a->every(20ms, [&] { states.write(state_of(0.0)); });
  pair.pass(500ms);
  EXPECT_GT(heard, before + 10);
  EXPECT_EQ(pair.b->participants().size(), 2U) << "the dead one keeps its lease";
  pair.pass(5s);
  EXPECT_EQ(pair.b->participants().size(), 1U);
}

TEST(SimulatedNetwork, AHangStopsTheLoopOnly) {
  Pair pair;
  int ticks = 0;
  pair.b->every(10ms, [&] { ++ticks; });
  pair.b->on<topics::MapEdit>([](const aisle::MapEdit&, const SampleInfo&) {});
  auto edits = pair.a->writer<topics::MapEdit>();
  pair.pass(100ms);
  pair.b->hang(true);
  ticks = 0;
  edits.write(edit_of(1));
  pair.pass(1s);
  EXPECT_EQ(ticks, 0);
  EXPECT_TRUE(edits.wait_until_acknowledged(0ms)) << "the middleware's threads go on";
  pair.b->hang(false);
  pair.pass(95ms);
  EXPECT_GE(ticks, 9);
  EXPECT_LE(ticks, 11) << "missed ticks are skipped";
}

TEST(SimulatedNetwork, ASlowProcessSkipsTicks) {
  Pair pair;
  int ticks = 0;
  pair.a->every(10ms, [&] { ++ticks; });
  pair.a->set_turn_time(45ms);
  pair.pass(1s);
  EXPECT_GE(ticks, 19);
  EXPECT_LE(ticks, 23);
}

TEST(SimulatedNetwork, TheWallClockOfAHostJumpsAndItsMonotonicClockDoesNot) {
  Pair pair;
  const time::Stamp now = pair.a->now();
  const std::int64_t wall = pair.a->wall_clock_ns();
  EXPECT_EQ(wall, pair.b->wall_clock_ns());
  pair.network.set_wall_clock_offset("a", -1h);
  EXPECT_EQ(pair.a->wall_clock_ns(), wall - 3'600'000'000'000);
  EXPECT_EQ(pair.b->wall_clock_ns(), wall);
  EXPECT_EQ(pair.a->now(), now);
  pair.pass(1s);
  EXPECT_EQ(pair.b->wall_clock_ns(), wall + 1'000'000'000);
  EXPECT_EQ(pair.b->now(), now + 1s);
}

TEST(SimulatedNetwork, OthersGoOnWhileAHandlerWaits) {
  Pair pair;
  int ticks = 0, got = 0;
  pair.b->every(10ms, [&] { ++ticks; });
  pair.b->on<topics::MapEdit>([&](const aisle::MapEdit&, const SampleInfo&) { ++got; });
  auto edits = pair.a->writer<topics::MapEdit>();
  pair.pass(100ms);
  pair.network.cut("b", "a");
  pair.network.at(pair.network.now() + 300ms, [&] { pair.network.heal("b", "a"); });
  bool acknowledged = false;
  pair.a->post([&] {
    edits.write(edit_of(1));
    ticks = 0;
    acknowledged = edits.wait_until_acknowledged(1s);
    EXPECT_GE(ticks, 29);
  });
  pair.pass(2s);
  EXPECT_TRUE(acknowledged);
  EXPECT_EQ(got, 1);
}

TEST(SimulatedNetwork, TicksOfOneMomentComeInTheOrderOfJoining) {
  Pair pair;
  std::string order;
  pair.b->every(10ms, [&] { order += "b"; });
  pair.a->every(10ms, [&] { order += "a"; });
  pair.pass(30ms);
  EXPECT_EQ(order, "ababab");
}

/// What two processes hear over a bad link, as text.
std::string trace(std::uint64_t seed) {
  Pair pair(seed);
  std::string heard;
  pair.b->on<topics::VehicleState>([&](const aisle::VehicleState& state, const SampleInfo& info) {
    heard += std::to_string(state.base_in_map().x_m()) + "@" + std::to_string(info.arrived.count()) + " ";
  });
  auto states = pair.a->writer<topics::VehicleState>();
  int x_m = 0;
  pair.a->every(10ms, [&] { states.write(state_of(++x_m)); });
  Link bad;
  bad.loss = 0.2;
  bad.duplicate = 0.1;
  bad.reorder = 0.1;
  bad.jitter = 3ms;
  pair.set_both(bad);
  pair.pass(3s);
  return heard;
}

TEST(SimulatedNetwork, TheSameSeedGivesTheSameRun) {
  const std::string first = trace(7);
  EXPECT_GT(first.size(), 1000U);
  EXPECT_EQ(first, trace(7));
  EXPECT_NE(first, trace(8));
}

TEST(SimulatedNetwork, BusesMayOutliveIt) {
  auto network = std::make_unique<Network>(1);
  auto bus = network->join(named("late"), "a");
  auto states = bus->writer<topics::VehicleState>();
  network.reset();
  EXPECT_TRUE(states.write(state_of(1.0)));
  bus.reset();
  EXPECT_FALSE(states.write(state_of(1.0)));
}

}  // namespace
}  // namespace aisle::bus_test
