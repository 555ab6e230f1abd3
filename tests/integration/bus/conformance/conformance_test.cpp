// One table of cases over every bus: what services rely on. Each case runs on DDS, in real time and on loopback, and on
// the simulated network, in virtual time, so that the simulated one cannot be kinder. common/bus/README.md lists which
// case shows which rule.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "tests/integration/bus/conformance/conformance_site.hpp"
#include "tests/support/sanitized.hpp"

namespace aisle::bus_test {
namespace {

using bus::Incident;
using bus::SampleInfo;
using bus::SampleKind;

/// After a lease of 200 ms, and well before the 5 s of a participant's. A sanitized process needs longer for a turn.
constexpr std::chrono::milliseconds kSoon{test_support::kSanitized ? 2000 : 500};

aisle::Track track_of(std::uint64_t id, double x_m = 0.0) {
  aisle::Track track;
  track.track_id(id);
  track.position_in_map().x_m(x_m);
  return track;
}

aisle::Goal goal_of(const std::string& agv, const std::string& id) {
  aisle::Goal goal;
  goal.agv_id(agv);
  goal.goal_id(id);
  return goal;
}

aisle::MapEdit edit_of(const std::string& id, double radius_m = 0.0) {
  aisle::MapEdit edit;
  edit.edit_id(id);
  edit.radius_m(radius_m);
  return edit;
}

/// What a reader of a topic was told, in words: "7 data", "7 disposed", "7 orphaned".
template <class Topic>
struct Ear {
  using Sample = typename Topic::Sample;
  Ear(Bus& bus, std::function<std::string(const Sample&)> name) {
    bus.on<Topic>([this, name = std::move(name)](const Sample& sample, const SampleInfo& info) {
      heard.push_back(name(sample) + (info.kind == SampleKind::kData       ? " data"
                                      : info.kind == SampleKind::kDisposed ? " disposed"
                                                                           : " orphaned"));
      if (info.kind == SampleKind::kData) newest = sample;
    });
  }
  int count(const std::string& word) const {
    return static_cast<int>(std::count_if(heard.begin(), heard.end(),
                                          [&](const std::string& one) { return one.find(word) != std::string::npos; }));
  }
  std::vector<std::string> heard;
  Sample newest;
};

struct TrackEar : Ear<topics::Track> {
  explicit TrackEar(Bus& bus) : Ear(bus, [](const aisle::Track& track) { return std::to_string(track.track_id()); }) {}
};
struct GoalEar : Ear<topics::Goal> {
  explicit GoalEar(Bus& bus)
      : Ear(bus, [](const aisle::Goal& goal) { return goal.agv_id().to_string() + " " + goal.goal_id().to_string(); }) {
  }
};
struct EditEar : Ear<topics::MapEdit> {
  explicit EditEar(Bus& bus) : Ear(bus, [](const aisle::MapEdit& edit) { return edit.edit_id().to_string(); }) {}
};
struct PlanEar : Ear<topics::Plan> {
  explicit PlanEar(Bus& bus)
      : Ear(bus, [](const aisle::Plan& plan) {
          return plan.agv_id().to_string() + " " + plan.by().source_id().to_string();
        }) {}
  std::string source() const { return newest.by().source_id().to_string(); }
};
struct StateEar : Ear<topics::VehicleState> {
  explicit StateEar(Bus& bus) : Ear(bus, [](const aisle::VehicleState& state) { return state.agv_id().to_string(); }) {}
};

struct IncidentEar {
  explicit IncidentEar(Bus& bus) {
    bus.on_incident([this](const Incident& incident) { incidents.push_back(incident); });
  }
  int count(Incident::Kind kind, const std::string& words = "") const {
    return static_cast<int>(std::count_if(incidents.begin(), incidents.end(), [&](const Incident& one) {
      return one.kind == kind && one.text.find(words) != std::string::npos;
    }));
  }
  std::vector<Incident> incidents;
};

using MakeSite = std::unique_ptr<ConformanceSite> (*)();

class Conformance : public ::testing::TestWithParam<std::pair<const char*, MakeSite>> {
 protected:
  Conformance() : site_(GetParam().second()) {}
  std::unique_ptr<Bus> join(const std::string& name) { return site_->join(name); }
  bool run_until(std::initializer_list<Bus*> buses, const std::function<bool()>& done,
                 std::chrono::milliseconds limit = 10s) {
    return site_->run_until(buses, done, limit);
  }
  void run_for(std::initializer_list<Bus*> buses, std::chrono::milliseconds time) { site_->run_for(buses, time); }
  /// Time for what must not happen.
  static constexpr std::chrono::milliseconds kQuiet{300};

  std::unique_ptr<ConformanceSite> site_;
};

// Delivery.

TEST_P(Conformance, ReliableSamplesComeAllAndThoseOfAKeyInOrder) {
  const auto sender = join("sender"), receiver = join("receiver");
  auto edits = sender->writer<topics::MapEdit>();
  std::map<std::string, std::vector<double>> got, sent;  // radii by edit id
  receiver->on<topics::MapEdit>([&](const aisle::MapEdit& edit, const SampleInfo&) {
    got[edit.edit_id().to_string()].push_back(edit.radius_m());
  });
  ASSERT_TRUE(run_until({sender.get(), receiver.get()}, [&] { return edits.matched_readers() == 1; }));
  for (int i = 0; i < 300; ++i) {
    const std::string id = "edit-" + std::to_string(i % 3);
    ASSERT_TRUE(edits.write(edit_of(id, i)));
    sent[id].push_back(i);
  }
  EXPECT_TRUE(run_until({sender.get(), receiver.get()}, [&] { return got == sent; }));
}

TEST_P(Conformance, KeysAreTakenInAnOrderOfTheirOwn) {
  const auto sender = join("sender"), receiver = join("receiver");
  auto goals = sender->writer<topics::Goal>();
  GoalEar ear(*receiver);
  ASSERT_TRUE(run_until({sender.get(), receiver.get()}, [&] { return goals.matched_readers() == 1; }));
  std::vector<std::string> sent;
  for (int i = 0; i < 20; ++i) {
    const std::string agv = "agv-" + std::to_string(i);
    ASSERT_TRUE(goals.write(goal_of(agv, "g")));
    sent.push_back(agv + " g data");
  }
  ASSERT_TRUE(goals.wait_until_acknowledged(5s));
  ASSERT_TRUE(run_until({receiver.get()}, [&] { return ear.heard.size() == sent.size(); }));
  EXPECT_NE(ear.heard, sent) << "no service may count on the order of arrival across keys";
  EXPECT_THAT(ear.heard, ::testing::UnorderedElementsAreArray(sent));
}

TEST_P(Conformance, WhatAStandingProcessCouldNotHoldIsSentAgain) {
  constexpr std::uint64_t kMaps = 60;  // 8 MB, twice a socket's buffer
  const auto sender = join("sender");
  const auto counter = site_->start("counter", "map-counter");
  auto infos = sender->writer<topics::MapInfo>();
  TrackEar ear(*sender);
  ASSERT_TRUE(run_until({sender.get()}, [&] { return infos.matched_readers() == 1 && ear.count("0 data") > 0; }));
  counter->freeze(true);
  site_->idle(20ms);
  aisle::MapInfo info;
  info.tile_hashes().resize(16384, 1);
  for (std::uint64_t i = 0; i < kMaps; ++i) {
    info.map_id("map-" + std::to_string(i));
    if (i + 1 == kMaps) info.tile_hashes().resize(1);  // small: it finds room where those before it did not
    ASSERT_TRUE(infos.write(info));
  }
  site_->idle(100ms);
  counter->freeze(false);
  EXPECT_TRUE(run_until({sender.get()}, [&] { return ear.newest.track_id() == kMaps; })) << ear.newest.track_id();
}

TEST_P(Conformance, ASampleArrivesWithItsFieldsAndItsWriter) {
  const auto sender = join("sender"), receiver = join("receiver");
  auto goals = sender->writer<topics::Goal>();
  auto others = sender->writer<topics::Goal>();
  std::map<std::string, aisle::Goal> got;  // by writer
  receiver->on<topics::Goal>([&](const aisle::Goal& goal, const SampleInfo& info) { got[info.writer] = goal; });
  aisle::Goal goal = goal_of("agv-1", "g-1");
  goal.pose_in_map().x_m(1.5);
  ASSERT_TRUE(goals.write(goal));
  ASSERT_TRUE(others.write(goal_of("agv-2", "g-1")));
  ASSERT_TRUE(run_until({sender.get(), receiver.get()}, [&] { return got.size() == 2; }));
  EXPECT_TRUE(got.begin()->second == goal || got.rbegin()->second == goal);
}

TEST_P(Conformance, ABusHearsItself) {
  const auto bus = join("alone");
  TrackEar ear(*bus);
  auto tracks = bus->writer<topics::Track>();
  ASSERT_TRUE(run_until({bus.get()}, [&] { return tracks.matched_readers() == 1; }));
  ASSERT_TRUE(tracks.write(track_of(1)));
  EXPECT_TRUE(run_until({bus.get()}, [&] { return ear.count("1 data") == 1; }));
}

TEST_P(Conformance, ArrivalIsOnTheClockOfTheBus) {
  const auto sender = join("sender"), receiver = join("receiver");
  auto goals = sender->writer<topics::Goal>();
  std::vector<time::Stamp> arrived;
  receiver->on<topics::Goal>([&](const aisle::Goal&, const SampleInfo& info) { arrived.push_back(info.arrived); });
  const time::Stamp before = receiver->now();
  const std::int64_t wall_before = receiver->wall_clock_ns();
  ASSERT_TRUE(goals.write(goal_of("agv-1", "g-1")));
  ASSERT_TRUE(run_until({sender.get(), receiver.get()}, [&] { return !arrived.empty(); }));
  EXPECT_GT(arrived[0], before);
  EXPECT_LE(arrived[0], receiver->now());
  EXPECT_GT(receiver->wall_clock_ns(), wall_before);
  EXPECT_GT(wall_before, 1'700'000'000'000'000'000);
}

// History.

TEST_P(Conformance, OfEachKeyTheNewestIsKeptForALoopThatIsLate) {
  const auto sender = join("sender"), receiver = join("receiver");
  auto goals = sender->writer<topics::Goal>();
  GoalEar ear(*receiver);
  ASSERT_TRUE(run_until({sender.get(), receiver.get()}, [&] { return goals.matched_readers() == 1; }));
  for (const char* id : {"old", "older", "new"}) {
    ASSERT_TRUE(goals.write(goal_of("agv-1", id)));
    ASSERT_TRUE(goals.write(goal_of("agv-2", id)));
  }
  ASSERT_TRUE(goals.wait_until_acknowledged(5s));
  run_for({receiver.get()}, kQuiet);
  EXPECT_THAT(ear.heard, ::testing::UnorderedElementsAre("agv-1 new data", "agv-2 new data"));
}

TEST_P(Conformance, AQueueKeepsEverySample) {
  const auto sender = join("sender"), receiver = join("receiver");
  auto edits = sender->writer<topics::MapEdit>();
  EditEar ear(*receiver);
  ASSERT_TRUE(run_until({sender.get(), receiver.get()}, [&] { return edits.matched_readers() == 1; }));
  for (int i = 0; i < 5; ++i) ASSERT_TRUE(edits.write(edit_of("same", i)));
  ASSERT_TRUE(edits.wait_until_acknowledged(5s));
  run_for({receiver.get()}, kQuiet);
  EXPECT_EQ(ear.heard, std::vector<std::string>(5, "same data"));
  EXPECT_EQ(ear.newest.radius_m(), 4.0);
}

TEST_P(Conformance, AFullQueueRefusesUntilItsReaderGoesOn) {
  const auto reader = site_->start("reader", "edit-reader");
  const auto sender = join("sender");
  auto edits = sender->writer<topics::MapEdit>();
  ASSERT_TRUE(run_until({sender.get()}, [&] { return edits.matched_readers() == 1; }));
  reader->freeze(true);
  site_->idle(20ms);
  int taken = 0;
  while (taken < 2000 && edits.write(edit_of("edit-" + std::to_string(taken)))) ++taken;
  EXPECT_EQ(taken, topics::MapEdit::kQos.max_kept);
  EXPECT_FALSE(edits.wait_until_acknowledged(50ms));
  reader->freeze(false);
  EXPECT_TRUE(edits.wait_until_acknowledged(5s));
  EXPECT_TRUE(edits.write(edit_of("one more")));
}

/// No reader alone leaves a queue's worth unacknowledged.
TEST_P(Conformance, AQueueHoldsWhatNotAllReadersHaveAcknowledged) {
  const auto first = site_->start("first", "edit-reader");
  const auto second = site_->start("second", "edit-reader");
  const auto sender = join("sender");
  auto edits = sender->writer<topics::MapEdit>();
  ASSERT_TRUE(run_until({sender.get()}, [&] { return edits.matched_readers() == 2; }));
  int taken = 0;
  const auto write = [&] { return taken < 2000 && edits.write(edit_of("edit-" + std::to_string(taken))) && ++taken; };

  first->freeze(true);
  site_->idle(20ms);
  while (taken < topics::MapEdit::kQos.max_kept * 3 / 4) ASSERT_TRUE(write());
  site_->idle(200ms);  // the second acknowledges
  second->freeze(true);
  site_->idle(20ms);
  ASSERT_TRUE(write());
  first->freeze(false);
  site_->idle(500ms);  // the first acknowledges
  while (write()) {
  }
  EXPECT_EQ(taken, topics::MapEdit::kQos.max_kept);
  second->freeze(false);
  EXPECT_TRUE(edits.wait_until_acknowledged(5s));
  EXPECT_TRUE(write());
}

TEST_P(Conformance, WithoutAReaderAQueueIsNeverFull) {
  const auto sender = join("sender");
  auto edits = sender->writer<topics::MapEdit>();
  for (int i = 0; i < 2 * topics::MapEdit::kQos.max_kept; ++i)
    ASSERT_TRUE(edits.write(edit_of(std::to_string(i)))) << i;
}

// Late join.

TEST_P(Conformance, ALateJoinerGetsTheNewestOfEachKey) {
  const auto sender = join("sender");
  auto goals = sender->writer<topics::Goal>();
  for (const char* id : {"old", "new"}) {
    for (const char* agv : {"agv-1", "agv-2", "agv-3"}) ASSERT_TRUE(goals.write(goal_of(agv, id)));
  }
  const auto late = join("late");
  GoalEar ear(*late);
  EXPECT_TRUE(run_until({sender.get(), late.get()}, [&] { return ear.heard.size() >= 3; }));
  run_for({sender.get(), late.get()}, kQuiet);
  EXPECT_THAT(ear.heard, ::testing::UnorderedElementsAre("agv-1 new data", "agv-2 new data", "agv-3 new data"));
}

TEST_P(Conformance, ALateJoinerGetsNothingOfAVolatileTopic) {
  const auto sender = join("sender");
  auto tracks = sender->writer<topics::Track>();
  ASSERT_TRUE(tracks.write(track_of(1)));
  const auto late = join("late");
  TrackEar ear(*late);
  ASSERT_TRUE(run_until({sender.get(), late.get()},
                        [&] { return tracks.matched_readers() == 1 && late->matched_writers("track") == 1; }));
  ASSERT_TRUE(tracks.write(track_of(2)));
  EXPECT_TRUE(run_until({sender.get(), late.get()}, [&] { return !ear.heard.empty(); }));
  EXPECT_EQ(ear.heard, std::vector<std::string>{"2 data"});
}

TEST_P(Conformance, WhatIsKeptDiesWithItsWriter) {
  const auto sender = join("sender");
  {
    auto goals = sender->writer<topics::Goal>();
    ASSERT_TRUE(goals.write(goal_of("agv-1", "g")));
  }
  auto others = sender->writer<topics::Goal>();
  const auto late = join("late");
  GoalEar ear(*late);
  ASSERT_TRUE(run_until({sender.get(), late.get()}, [&] { return late->matched_writers("goal") == 1; }));
  run_for({sender.get(), late.get()}, kQuiet);
  EXPECT_TRUE(ear.heard.empty());
}

// Instances.

TEST_P(Conformance, ADisposalIsToldOnceWithItsKey) {
  const auto sender = join("sender"), receiver = join("receiver");
  auto tracks = sender->writer<topics::Track>();
  TrackEar ear(*receiver);
  ASSERT_TRUE(run_until({sender.get(), receiver.get()}, [&] { return tracks.matched_readers() == 1; }));
  ASSERT_TRUE(tracks.write(track_of(7)));
  ASSERT_TRUE(tracks.write(track_of(8)));
  ASSERT_TRUE(run_until({sender.get(), receiver.get()}, [&] { return ear.heard.size() == 2; }));
  EXPECT_TRUE(tracks.dispose(track_of(8)));
  EXPECT_FALSE(tracks.dispose(track_of(9))) << "never written";
  ASSERT_TRUE(run_until({sender.get(), receiver.get()}, [&] { return ear.heard.size() == 3; }));
  run_for({sender.get(), receiver.get()}, kQuiet);
  EXPECT_THAT(ear.heard, ::testing::UnorderedElementsAre("7 data", "8 data", "8 disposed"));
}

TEST_P(Conformance, AnInstanceLivesAgainWhenItIsWrittenAgain) {
  const auto sender = join("sender"), receiver = join("receiver");
  auto tracks = sender->writer<topics::Track>();
  TrackEar ear(*receiver);
  ASSERT_TRUE(run_until({sender.get(), receiver.get()}, [&] { return tracks.matched_readers() == 1; }));
  const auto say = [&](bool written, std::size_t count) {
    EXPECT_TRUE(written);
    EXPECT_TRUE(run_until({sender.get(), receiver.get()}, [&] { return ear.heard.size() == count; }));
  };
  say(tracks.write(track_of(7)), 1);
  say(tracks.dispose(track_of(7)), 2);
  say(tracks.write(track_of(7)), 3);
  say(tracks.dispose(track_of(7)), 4);
  EXPECT_EQ(ear.heard, (std::vector<std::string>{"7 data", "7 disposed", "7 data", "7 disposed"}));
}

TEST_P(Conformance, WhatWasDisposedIsNotToldToALateJoiner) {
  const auto sender = join("sender");
  auto goals = sender->writer<topics::Goal>();
  ASSERT_TRUE(goals.write(goal_of("agv-1", "g")));
  ASSERT_TRUE(goals.write(goal_of("agv-2", "g")));
  ASSERT_TRUE(goals.dispose(goal_of("agv-1", "")));
  const auto late = join("late");
  GoalEar ear(*late);
  EXPECT_TRUE(run_until({sender.get(), late.get()}, [&] { return !ear.heard.empty(); }));
  run_for({sender.get(), late.get()}, kQuiet);
  EXPECT_EQ(ear.heard, std::vector<std::string>{"agv-2 g data"});
}

TEST_P(Conformance, NoWritersIsToldOnceForEachInstanceHeardOf) {
  const auto sender = join("sender"), other = join("other"), receiver = join("receiver");
  auto lasting = other->writer<topics::Track>();
  TrackEar ear(*receiver);
  {
    auto tracks = sender->writer<topics::Track>();
    ASSERT_TRUE(run_until({sender.get(), other.get(), receiver.get()},
                          [&] { return tracks.matched_readers() == 1 && lasting.matched_readers() == 1; }));
    for (const std::uint64_t id : {1U, 2U, 3U}) ASSERT_TRUE(tracks.write(track_of(id)));
    ASSERT_TRUE(run_until({sender.get(), other.get(), receiver.get()}, [&] { return ear.count("data") == 3; }));
    ASSERT_TRUE(lasting.write(track_of(3)));
    ASSERT_TRUE(run_until({sender.get(), other.get(), receiver.get()}, [&] { return ear.count("data") >= 4; }));
    ASSERT_TRUE(tracks.dispose(track_of(2)));
    ASSERT_TRUE(run_until({sender.get(), other.get(), receiver.get()}, [&] { return ear.count("disposed") == 1; }));
  }
  ASSERT_TRUE(run_until({sender.get(), other.get(), receiver.get()}, [&] { return ear.count("orphaned") >= 1; }));
  run_for({sender.get(), other.get(), receiver.get()}, kQuiet);
  EXPECT_EQ(ear.count("orphaned"), 1) << "2 was disposed, 3 has another writer";
  EXPECT_EQ(ear.heard.back(), "1 orphaned");
}

TEST_P(Conformance, AQueueTellsOfNoEnds) {
  const auto sender = join("sender"), receiver = join("receiver");
  EditEar ear(*receiver);
  {
    auto edits = sender->writer<topics::MapEdit>();
    ASSERT_TRUE(run_until({sender.get(), receiver.get()}, [&] { return edits.matched_readers() == 1; }));
    ASSERT_TRUE(edits.write(edit_of("e")));
    ASSERT_TRUE(run_until({sender.get(), receiver.get()}, [&] { return ear.heard.size() == 1; }));
  }
  ASSERT_TRUE(run_until({sender.get(), receiver.get()}, [&] { return receiver->matched_writers("map_edit") == 0; }));
  run_for({sender.get(), receiver.get()}, kQuiet);
  EXPECT_EQ(ear.heard, std::vector<std::string>{"e data"});
}

TEST_P(Conformance, AProcessThatIsKilledIsForgottenAfterTheParticipantLease) {
  const auto receiver = join("receiver");
  TrackEar ear(*receiver);
  const auto peer = site_->start("tracker", "track");
  ASSERT_TRUE(run_until({receiver.get()}, [&] { return ear.count("data") > 0; }));
  peer->kill();
  run_for({receiver.get()}, 2s);
  EXPECT_EQ(ear.count("orphaned"), 0) << "automatic liveliness: silence means nothing yet";
  EXPECT_EQ(receiver->participants().size(), 1U);
  EXPECT_TRUE(run_until({receiver.get()}, [&] { return ear.count("orphaned") == 1; }));
  EXPECT_TRUE(run_until({receiver.get()}, [&] { return receiver->participants().empty(); }));
}

TEST_P(Conformance, AProcessThatLeavesIsForgottenAtOnce) {
  const auto receiver = join("receiver");
  TrackEar ear(*receiver);
  const auto peer = site_->start("tracker", "track");
  ASSERT_TRUE(run_until({receiver.get()}, [&] { return ear.count("data") > 0; }));
  peer->leave();
  EXPECT_TRUE(run_until(
      {receiver.get()}, [&] { return ear.count("orphaned") == 1; }, 2s));
  EXPECT_TRUE(run_until(
      {receiver.get()}, [&] { return receiver->participants().empty(); }, 2s));
}

// Ownership.

TEST_P(Conformance, OnlyTheStrongestWriterIsHeard) {
  const auto receiver = join("receiver"), strong = join("strong"), weak = join("weak");
  PlanEar ear(*receiver);
  auto strong_plans = strong->writer<topics::Plan>(5);
  auto weak_plans = weak->writer<topics::Plan>(1);
  aisle::Plan plan;
  plan.agv_id("agv-1");
  const auto write_as = [&](bus::Writer<topics::Plan>& plans, const char* source) {
    plan.by().source_id(source);
    plans.write(plan);
  };
  strong->every(50ms, [&] { write_as(strong_plans, "strong"); });
  weak->every(50ms, [&] { write_as(weak_plans, "weak"); });
  const std::initializer_list<Bus*> all{receiver.get(), strong.get(), weak.get()};
  ASSERT_TRUE(run_until(all, [&] {
    return ear.source() == "strong" && weak_plans.matched_readers() == 1 && strong_plans.matched_readers() == 1;
  }));
  ear.heard.clear();
  EXPECT_TRUE(run_until(all, [&] { return ear.count("strong") > 8; }));
  EXPECT_EQ(ear.count("weak"), 0);
}

TEST_P(Conformance, OfEquallyStrongWritersOneIsHeard) {
  const auto receiver = join("receiver"), first = join("first"), second = join("second");
  PlanEar ear(*receiver);
  auto first_plans = first->writer<topics::Plan>(3);
  auto second_plans = second->writer<topics::Plan>(3);
  aisle::Plan plan;
  plan.agv_id("agv-1");
  const auto write_as = [&](bus::Writer<topics::Plan>& plans, const char* source) {
    plan.by().source_id(source);
    plans.write(plan);
  };
  first->every(50ms, [&] { write_as(first_plans, "first"); });
  run_for({first.get()}, 25ms);  // out of step, so that a reader that keeps one sample could hear both
  second->every(50ms, [&] { write_as(second_plans, "second"); });
  const std::initializer_list<Bus*> all{receiver.get(), first.get(), second.get()};
  ASSERT_TRUE(run_until(all, [&] {
    return first_plans.matched_readers() == 1 && second_plans.matched_readers() == 1 && !ear.heard.empty();
  }));
  run_for(all, kQuiet);
  ear.heard.clear();
  EXPECT_TRUE(run_until(all, [&] { return ear.heard.size() > 8; }));
  EXPECT_TRUE(ear.count("first") == 0 || ear.count("second") == 0);
}

TEST_P(Conformance, TheNextIsHeardSoonAfterAKill) {
  const auto receiver = join("receiver");
  PlanEar ear(*receiver);
  const auto weak = site_->start("weak", "plan", 1), strong = site_->start("strong", "plan", 5);
  ASSERT_TRUE(run_until({receiver.get()}, [&] { return ear.source() == "strong"; }));
  strong->kill();
  EXPECT_TRUE(run_until(
      {receiver.get()}, [&] { return ear.source() == "weak"; }, kSoon));
}

TEST_P(Conformance, TheNextIsHeardSoonAfterAHangAndTheStrongestWhenItIsBack) {
  const auto receiver = join("receiver");
  PlanEar ear(*receiver);
  const auto weak = site_->start("weak", "plan", 1), strong = site_->start("strong", "plan", 5);
  ASSERT_TRUE(run_until({receiver.get()}, [&] { return ear.source() == "strong"; }));
  strong->freeze(true);
  EXPECT_TRUE(run_until(
      {receiver.get()}, [&] { return ear.source() == "weak"; }, kSoon));
  strong->freeze(false);
  EXPECT_TRUE(run_until(
      {receiver.get()}, [&] { return ear.source() == "strong"; }, 2s));
}

// Liveliness and deadlines.

TEST_P(Conformance, ALoopThatHangsLosesItsLivelinessAndComesBack) {
  const auto receiver = join("receiver"), sender = join("sender");
  PlanEar ear(*receiver);
  IncidentEar incidents(*receiver);
  auto plans = sender->writer<topics::Plan>(1);
  aisle::Plan plan;
  plan.agv_id("agv-1");
  sender->every(50ms, [&] { plans.write(plan); });
  ASSERT_TRUE(run_until({receiver.get(), sender.get()}, [&] { return ear.count("data") > 0; }));
  const time::Stamp silent = site_->now();
  ASSERT_TRUE(run_until(
      {receiver.get()}, [&] { return ear.count("orphaned") > 0; }, 2 * kSoon));
  EXPECT_GT(site_->now() - silent, 100ms);
  EXPECT_LT(site_->now() - silent, kSoon);
  EXPECT_GE(incidents.count(Incident::Kind::kLivelinessLost, "sender"), 1);
  run_for({receiver.get()}, 500ms);
  EXPECT_EQ(ear.count("orphaned"), 1);
  ear.heard.clear();
  EXPECT_TRUE(run_until({receiver.get(), sender.get()}, [&] { return ear.count("data") > 0; }));
}

TEST_P(Conformance, AnAssertionKeepsAWriterAliveWithoutSamples) {
  const auto receiver = join("receiver"), sender = join("sender");
  PlanEar ear(*receiver);
  IncidentEar incidents(*receiver);
  auto plans = sender->writer<topics::Plan>(1);
  aisle::Plan plan;
  plan.agv_id("agv-1");
  sender->every(50ms, [&] { plans.assert_liveliness(); });
  ASSERT_TRUE(plans.write(plan));
  ASSERT_TRUE(run_until({receiver.get(), sender.get()}, [&] { return ear.count("data") == 1; }));
  run_for({receiver.get(), sender.get()}, 1s);
  EXPECT_EQ(ear.count("orphaned"), 0);
  EXPECT_EQ(incidents.count(Incident::Kind::kLivelinessLost), 0);
}

TEST_P(Conformance, AWriterThatNeverSpokeIsNotMissed) {
  const auto receiver = join("receiver"), sender = join("sender");
  PlanEar ear(*receiver);
  IncidentEar incidents(*receiver);
  auto plans = sender->writer<topics::Plan>(1);
  ASSERT_TRUE(run_until({receiver.get(), sender.get()}, [&] { return plans.matched_readers() == 1; }));
  run_for({receiver.get(), sender.get()}, 600ms);
  EXPECT_EQ(incidents.count(Incident::Kind::kLivelinessLost), 0);
}

TEST_P(Conformance, AMissedDeadlineIsToldAndTheInstanceLivesOn) {
  const auto receiver = join("receiver"), sender = join("sender");
  StateEar ear(*receiver);
  IncidentEar incidents(*receiver);
  auto states = sender->writer<topics::VehicleState>();
  aisle::VehicleState state;
  state.agv_id("agv-1");
  bool speaks = true;
  sender->every(50ms, [&] {
    if (speaks) states.write(state);
  });
  ASSERT_TRUE(run_until({receiver.get(), sender.get()}, [&] { return ear.count("data") > 5; }));
  EXPECT_EQ(incidents.count(Incident::Kind::kDeadlineMissed), 0);
  speaks = false;
  EXPECT_TRUE(run_until(
      {receiver.get(), sender.get()}, [&] { return incidents.count(Incident::Kind::kDeadlineMissed) == 1; }, 1s));
  run_for({receiver.get(), sender.get()}, 1s);
  EXPECT_EQ(incidents.count(Incident::Kind::kDeadlineMissed), 1) << "one in five seconds";
  EXPECT_EQ(ear.count("orphaned"), 0);
}

// Discovery.

TEST_P(Conformance, ParticipantsAndEndpointsAreSeen) {
  const auto sender = join("sender"), receiver = join("receiver");
  auto tracks = sender->writer<topics::Track>();
  TrackEar ear(*receiver);
  const auto sees_writer = [&] {
    const auto endpoints = receiver->endpoints();
    return std::any_of(endpoints.begin(), endpoints.end(), [](const bus::Endpoint& seen) {
      return seen.topic == "track" && seen.type == "aisle::Track" && seen.participant == "sender" && seen.is_writer &&
             seen.qos.reliability == bus::Reliability::kReliable && seen.qos.depth == 0;
    });
  };
  EXPECT_TRUE(run_until({sender.get(), receiver.get()}, sees_writer));
  EXPECT_EQ(receiver->participants(), std::vector<std::string>{"sender"});
  EXPECT_TRUE(run_until({sender.get(), receiver.get()}, [&] { return receiver->matched_writers("track") == 1; }));
  EXPECT_EQ(receiver->endpoints()[0].participant, "receiver") << "our own come first";
}

TEST_P(Conformance, MatchesComeAndGo) {
  const auto sender = join("sender");
  auto tracks = sender->writer<topics::Track>();
  EXPECT_EQ(tracks.matched_readers(), 0);
  {
    const auto receiver = join("receiver");
    TrackEar ear(*receiver);
    ASSERT_TRUE(run_until({sender.get(), receiver.get()}, [&] { return tracks.matched_readers() == 1; }));
  }
  EXPECT_TRUE(run_until(
      {sender.get()}, [&] { return tracks.matched_readers() == 0; }, 2s));
}

TEST_P(Conformance, PartitionsKeepSamplesApartAndParticipantsInSight) {
  const auto sender = site_->join("sender", "site-a"), stranger = site_->join("stranger", "site-b");
  const auto receiver = site_->join("receiver", "site-b");
  auto goals = sender->writer<topics::Goal>();
  auto others = stranger->writer<topics::Goal>();
  GoalEar ear(*receiver);
  ASSERT_TRUE(goals.write(goal_of("agv-1", "a")));
  ASSERT_TRUE(others.write(goal_of("agv-2", "b")));
  const std::initializer_list<Bus*> all{sender.get(), stranger.get(), receiver.get()};
  ASSERT_TRUE(run_until(all, [&] { return !ear.heard.empty() && receiver->participants().size() == 2; }));
  run_for(all, kQuiet);
  EXPECT_EQ(ear.heard, std::vector<std::string>{"agv-2 b data"});
  EXPECT_EQ(goals.matched_readers(), 0);
}

TEST_P(Conformance, DomainsDoNotSeeEachOther) {
  const auto sender = site_->join("sender", "", true), receiver = join("receiver");
  auto goals = sender->writer<topics::Goal>();
  GoalEar ear(*receiver);
  ASSERT_TRUE(goals.write(goal_of("agv-1", "a")));
  run_for({sender.get(), receiver.get()}, 500ms);
  EXPECT_TRUE(ear.heard.empty());
  EXPECT_TRUE(receiver->participants().empty());
}

TEST_P(Conformance, AWriterWithWeakerQosIsNamedAndNotHeard) {
  const auto receiver = join("receiver");
  GoalEar ear(*receiver);
  IncidentEar incidents(*receiver);
  const auto stranger = site_->foreign_writer("goal", topics::kStream, "goal");
  EXPECT_TRUE(
      run_until({receiver.get()}, [&] { return incidents.count(Incident::Kind::kIncompatibleQos, "stranger") == 1; }));
  EXPECT_EQ(receiver->matched_writers("goal"), 0);
}

TEST_P(Conformance, AWriterOfAnotherTypeIsNamedAndNotHeard) {
  const auto receiver = join("receiver");
  GoalEar ear(*receiver);
  IncidentEar incidents(*receiver);
  const auto stranger = site_->foreign_writer("goal", topics::kState, "plan");
  EXPECT_TRUE(
      run_until({receiver.get()}, [&] { return incidents.count(Incident::Kind::kTypeMismatch, "aisle::Plan") == 1; }));
  EXPECT_EQ(receiver->matched_writers("goal"), 0);
}

// The loop.

TEST_P(Conformance, ALateLoopSkipsTicksAndKeepsItsBeat) {
  const auto bus = join("late");
  std::vector<time::Stamp> ticks;
  bus->every(100ms, [&] { ticks.push_back(bus->now()); });
  ASSERT_TRUE(run_until({bus.get()}, [&] { return ticks.size() == 1; }));
  const time::Stamp first = ticks[0];
  site_->idle(450ms);
  bus->run_once(0ms);
  EXPECT_EQ(ticks.size(), 2U) << "one for all that were missed";
  ASSERT_TRUE(run_until({bus.get()}, [&] { return ticks.size() == 3; }));
  const std::chrono::nanoseconds off_beat = (ticks[2] - first) % 100ms;
  EXPECT_LT(std::min<std::chrono::nanoseconds>(off_beat, 100ms - off_beat), 30ms);
}

TEST_P(Conformance, ALoopWithNothingToDoWaitsItsLimit) {
  const auto bus = join("idle");
  const time::Stamp begun = bus->now();
  EXPECT_FALSE(bus->run_once(50ms));
  EXPECT_GE(bus->now() - begun, 50ms);
}

TEST_P(Conformance, PostedWorkRunsInTheLoop) {
  const auto bus = join("poster");
  int done = 0;
  bus->post([&] {
    ++done;
    bus->post([&] { ++done; });
  });
  EXPECT_EQ(done, 0);
  EXPECT_TRUE(bus->run_once(1s));
  EXPECT_TRUE(run_until({bus.get()}, [&] { return done == 2; }));
}

TEST_P(Conformance, AWriterOutlivesItsBusAndWritesNothing) {
  auto bus = join("short");
  auto goals = bus->writer<topics::Goal>();
  EXPECT_TRUE(goals.write(goal_of("agv-1", "g")));
  bus.reset();
  EXPECT_FALSE(goals.write(goal_of("agv-1", "g")));
  EXPECT_FALSE(goals.dispose(goal_of("agv-1", "g")));
  EXPECT_EQ(goals.matched_readers(), 0);
}

INSTANTIATE_TEST_SUITE_P(On, Conformance,
                         ::testing::Values(std::pair<const char*, MakeSite>{"Dds", dds_site},
                                           std::pair<const char*, MakeSite>{"Simulated", simulated_site}),
                         [](const auto& bus) { return std::string(bus.param.first); });

}  // namespace
}  // namespace aisle::bus_test
