// Shells without a process around them: on a bus of the test, several on one bus.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "common/bus/dds/dds_bus.hpp"
#include "common/service/shell.hpp"

namespace aisle::service {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kDomain = 131;  // and the next ones

bus::Settings local_settings(int domain, const std::string& name) {
  bus::Settings settings;
  settings.domain = domain;
  settings.interfaces = {"127.0.0.1"};
  settings.participant_name = name;
  return settings;
}

bool run_until(const std::vector<bus::Bus*>& buses, const std::function<bool()>& done) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
  while (!done() && std::chrono::steady_clock::now() < end) {
    for (bus::Bus* bus : buses) bus->run_once(milliseconds(5));
  }
  return done();
}

Identity identity(const std::string& instance_id, const std::string& agv_id = {}) {
  return {"test", instance_id, agv_id, 7, "host", 1};
}

/// A shell on a bus of its own.
struct Station {
  Station(int domain, const std::string& name) : bus(local_settings(domain, name)), shell(bus, identity(name)) {}
  bus::DdsBus bus;
  Shell shell;
};

fleet::MapEdit edit(const std::string& id, double radius_m = 1.0) {
  return {id, "floor", fleet::MapEdit::Action::kBlock, fleet::MapEdit::Shape::kDisc, {{1.0, 2.0}}, radius_m};
}

TEST(Inbox, HandsOverValuesWithTheirSender) {
  Station writer(kDomain, "writer");
  Station reader(kDomain, "reader");
  Outbox<topics::MapEdit> edits = writer.shell.outbox<topics::MapEdit>();
  std::vector<fleet::MapEdit> heard;
  std::vector<Sender> from;
  reader.shell.inbox<topics::MapEdit>([&](const fleet::MapEdit& value, const Sender& sender) {
    heard.push_back(value);
    from.push_back(sender);
  });
  ASSERT_TRUE(run_until({&writer.bus, &reader.bus}, [&] { return edits.matched_readers() > 0; }));
  const time::Stamp before = reader.shell.now();
  EXPECT_TRUE(edits.write(edit("one")));
  EXPECT_TRUE(edits.write(edit("one", 2.0)));
  ASSERT_TRUE(run_until({&writer.bus, &reader.bus}, [&] { return heard.size() == 2; }));
  EXPECT_TRUE(heard[0] == edit("one"));
  EXPECT_TRUE(heard[1] == edit("one", 2.0));
  EXPECT_EQ(from[0].by.source_id, "writer");
  EXPECT_EQ(from[0].by.boot_id, 7U);
  EXPECT_EQ(from[0].by.epoch, 1U);
  EXPECT_EQ(from[0].by.sequence_number, 1U);
  EXPECT_EQ(from[1].by.sequence_number, 2U);
  EXPECT_GE(from[0].arrived, before);
  EXPECT_LE(from[1].arrived, reader.shell.now());
}

TEST(Inbox, DropsCountsAndTellsWhatItsCodecRefuses) {
  Station writer(kDomain + 1, "writer");
  Station reader(kDomain + 1, "reader");
  Outbox<topics::MapEdit> edits = writer.shell.outbox<topics::MapEdit>();
  std::vector<std::string> heard;
  std::map<std::string, std::string> refused;
  reader.shell.inbox<topics::MapEdit>([&](const fleet::MapEdit& value) { heard.push_back(value.edit_id); })
      .on_refused([&](const std::string& edit_id, const std::string& reason) { refused[edit_id] = reason; });
  ASSERT_TRUE(run_until({&writer.bus, &reader.bus}, [&] { return edits.matched_readers() > 0; }));
  edits.write(edit("bad", std::nan("")));
  edits.write(edit("good"));
  ASSERT_TRUE(run_until({&writer.bus, &reader.bus}, [&] { return heard.size() == 1; }));
  EXPECT_EQ(heard[0], "good");
  EXPECT_THAT(refused["bad"], HasSubstr("radius_m"));
  EXPECT_EQ(reader.shell.health().counters["dropped_map_edit"], 1U);
}

TEST(Inbox, AHandlerMayAddInboxesOfItsTopic) {
  Station writer(kDomain + 41, "writer");
  Station reader(kDomain + 41, "reader");
  Outbox<topics::MapEdit> edits = writer.shell.outbox<topics::MapEdit>();
  int heard = 0, last = 0, added = 0;
  reader.shell.inbox<topics::MapEdit>([&](const fleet::MapEdit&) {
    if (++heard > 1) return;
    for (int i = 0; i < 1000; ++i) reader.shell.inbox<topics::MapEdit>([&](const fleet::MapEdit&) { ++added; });
  });
  reader.shell.inbox<topics::MapEdit>([&](const fleet::MapEdit&) { ++last; });
  ASSERT_TRUE(run_until({&writer.bus, &reader.bus}, [&] { return edits.matched_readers() > 0; }));
  edits.write(edit("one"));
  ASSERT_TRUE(run_until({&writer.bus, &reader.bus}, [&] { return last == 1; }));
  EXPECT_EQ(added, 0) << "from the next sample on";
  edits.write(edit("two"));
  ASSERT_TRUE(run_until({&writer.bus, &reader.bus}, [&] { return last == 2; }));
  EXPECT_EQ(added, 1000);
}

TEST(Inbox, TellsTheEndOfAnInstanceByItsKey) {
  auto writer = std::make_unique<Station>(kDomain + 2, "writer");
  Station reader(kDomain + 2, "reader");
  Outbox<topics::MapTile> tiles = writer->shell.outbox<topics::MapTile>();
  int heard = 0;
  std::vector<std::tuple<std::string, std::uint32_t, std::uint32_t>> gone;
  std::vector<End> how;
  reader.shell.inbox<topics::MapTile>([&](const grid::Tile&) { ++heard; }).on_gone([&](const auto& key, End end) {
    gone.push_back(key);
    how.push_back(end);
  });
  grid::Tile tile;
  tile.map_id = "floor";
  tile.tile_x = 3;
  tile.cells = {grid::Occupancy::kFree};
  tile.hash = grid::tile_hash(tile.cells);
  tiles.write(tile);
  tile.tile_y = 4;
  tiles.write(tile);
  ASSERT_TRUE(run_until({&writer->bus, &reader.bus}, [&] { return heard == 2; }));
  EXPECT_TRUE(tiles.dispose({"floor", 3, 0}));
  ASSERT_TRUE(run_until({&writer->bus, &reader.bus}, [&] { return gone.size() == 1; }));
  EXPECT_EQ(gone[0], std::make_tuple("floor", 3U, 0U));
  EXPECT_EQ(how[0], End::kDisposed);
  tiles = {};
  writer.reset();
  ASSERT_TRUE(run_until({&reader.bus}, [&] { return gone.size() == 2; }));
  EXPECT_EQ(gone[1], std::make_tuple("floor", 3U, 4U));
  EXPECT_EQ(how[1], End::kSilent);
}

TEST(Outbox, OfATopicWithOneOwnerIsClosedUntilItIsClaimed) {
  Station writer(kDomain + 3, "writer");
  Station reader(kDomain + 3, "reader");
  Outbox<topics::VelocityCommand> commands = writer.shell.outbox<topics::VelocityCommand>();
  std::vector<Sender> from;
  reader.shell.inbox<topics::VelocityCommand>(
      [&](const fleet::VelocityCommand&, const Sender& sender) { from.push_back(sender); });
  fleet::VelocityCommand command;
  command.agv_id = "agv-1";
  EXPECT_FALSE(commands.write(command));
  EXPECT_EQ(writer.shell.health().counters.count("velocity_command_not_written"), 0U) << "closed is no failure";
  commands.claim(5, 5);
  ASSERT_TRUE(run_until({&writer.bus, &reader.bus}, [&] {
    EXPECT_TRUE(commands.write(command));  // best effort: the first may come before the reader
    return !from.empty();
  }));
  EXPECT_EQ(from[0].by.epoch, 5U);
  commands.release();
  EXPECT_FALSE(commands.write(command));
}

TEST(Outbox, DefaultMadeWritesNothing) {
  Outbox<topics::VelocityCommand> none;
  none.claim(5, 5);
  EXPECT_FALSE(none.write({}));
  EXPECT_FALSE(none.dispose("agv-1"));
  EXPECT_EQ(none.matched_readers(), 0);
  none.release();
}

TEST(Shell, ReportsWhatItsServiceWaitsFor) {
  Station station(kDomain + 4, "service");
  Station observer(kDomain + 4, "observer");
  std::vector<fleet::ServiceHealth> heard;
  observer.shell.inbox<topics::ServiceHealth>([&](const fleet::ServiceHealth& health) {
    if (health.instance_id == "service") heard.push_back(health);
  });
  bool has_map = false;
  bool is_lame = false;
  station.shell.report([&](Health& health) {
    if (!has_map) health.wait_for("map_info");
    health.is_degraded = is_lame;
    health.counters["maps"] = has_map ? 1 : 0;
  });
  const auto said = [&](fleet::ServiceState state) {
    return run_until({&station.bus, &observer.bus}, [&] { return !heard.empty() && heard.back().state == state; });
  };
  ASSERT_TRUE(said(fleet::ServiceState::kWaiting));
  EXPECT_EQ(heard.back().waits_for, "map_info");
  has_map = true;
  ASSERT_TRUE(said(fleet::ServiceState::kReady));
  EXPECT_EQ(heard.back().counters["maps"], 1U);
  is_lame = true;
  station.shell.report_now();
  ASSERT_TRUE(said(fleet::ServiceState::kDegraded));
}

/// What the default logger says while this lives.
class LogLines {
 public:
  LogLines() {
    auto sink = std::make_shared<spdlog::sinks::ostream_sink_st>(lines_);
    sink->set_pattern("%n: %v");
    spdlog::set_default_logger(std::make_shared<spdlog::logger>("process", sink));
  }
  ~LogLines() { spdlog::set_default_logger(before_); }
  LogLines(const LogLines&) = delete;
  LogLines& operator=(const LogLines&) = delete;
  std::string text() const { return lines_.str(); }

 private:
  std::ostringstream lines_;
  std::shared_ptr<spdlog::logger> before_{spdlog::default_logger()};
};

/// Two shells on one bus, and an observer of their health.
struct Pair {
  explicit Pair(int domain)
      : bus(local_settings(domain, "pair")),
        first(bus, identity("test-agv-1", "agv-1")),
        second(first, identity("test-agv-2", "agv-2")),
        observer(domain, "observer") {
    observer.shell.inbox<topics::ServiceHealth>(
        [this](const fleet::ServiceHealth& health) { said[health.instance_id] = health; });
  }
  bool run(const std::function<bool()>& done) { return run_until({&bus, &observer.bus}, done); }
  bus::DdsBus bus;
  Shell first, second;
  Station observer;
  std::map<std::string, fleet::ServiceHealth> said;
};

TEST(Shells, OnOneBusHaveEachTheirIdentityAndHealth) {
  Pair pair(kDomain + 5);
  pair.first.report([](Health& health) { health.wait_for("plan"); });
  pair.second.report([](Health& health) { health.counters["cycles"] = 3; });
  ASSERT_TRUE(pair.run([&] {
    return pair.said["test-agv-1"].state == fleet::ServiceState::kWaiting &&
           pair.said["test-agv-2"].state == fleet::ServiceState::kReady;
  }));
  EXPECT_EQ(pair.said["test-agv-1"].agv_id, "agv-1");
  EXPECT_EQ(pair.said["test-agv-2"].agv_id, "agv-2");
  EXPECT_EQ(pair.said["test-agv-2"].counters["cycles"], 3U);
}

TEST(Shells, OnOneBusShareAReaderAndCountEachForThemselvesAndLogOnce) {
  const LogLines lines;
  Pair pair(kDomain + 6);
  Outbox<topics::MapEdit> edits = pair.observer.shell.outbox<topics::MapEdit>();
  int first = 0, second = 0;
  pair.first.inbox<topics::MapEdit>([&](const fleet::MapEdit&) { ++first; });
  pair.second.inbox<topics::MapEdit>([&](const fleet::MapEdit&) { ++second; });
  ASSERT_TRUE(pair.run([&] { return edits.matched_readers() > 0; }));
  EXPECT_EQ(edits.matched_readers(), 1);
  edits.write(edit("bad", std::nan("")));
  edits.write(edit("good"));
  ASSERT_TRUE(pair.run([&] { return first + second >= 2; }));
  EXPECT_EQ(first, 1);
  EXPECT_EQ(second, 1);
  EXPECT_EQ(pair.first.health().counters["dropped_map_edit"], 1U);
  EXPECT_EQ(pair.second.health().counters["dropped_map_edit"], 1U);
  EXPECT_THAT(lines.text(), HasSubstr("test-agv-1: map_edit: a sample was dropped: "));
  EXPECT_THAT(lines.text(), Not(HasSubstr("test-agv-2: map_edit")));
}

TEST(Shells, TheFailureOfOneDoesNotStopTheOther) {
  Pair pair(kDomain + 7);
  Outbox<topics::MapEdit> of_first = pair.first.outbox<topics::MapEdit>();
  Outbox<topics::MapEdit> of_second = pair.second.outbox<topics::MapEdit>();
  int ticks = 0;
  pair.first.every(milliseconds(10), [] { throw std::runtime_error("no such critic"); });
  pair.second.every(milliseconds(10), [&] { ++ticks; });
  pair.second.report([](Health&) {});
  ASSERT_TRUE(pair.run([&] {
    return pair.said["test-agv-1"].state == fleet::ServiceState::kDegraded &&
           pair.said["test-agv-2"].state == fleet::ServiceState::kReady && ticks > 10;
  }));
  EXPECT_THAT(pair.said["test-agv-1"].last_error, HasSubstr("failed: no such critic"));
  EXPECT_TRUE(pair.first.has_failed());
  EXPECT_FALSE(of_first.write(edit("one")));
  EXPECT_TRUE(of_second.write(edit("two")));

  // The last one's failure is the process's.
  pair.second.post([] { throw std::runtime_error("nor this one"); });
  EXPECT_THROW(run_until({&pair.bus}, [] { return false; }), std::runtime_error);
}

TEST(Shells, SayAllGoodbyeBeforeOneWaits) {
  Pair pair(kDomain + 42);
  ASSERT_TRUE(pair.run([&] { return pair.said.count("test-agv-1") > 0 && pair.said.count("test-agv-2") > 0; }));
  const time::Stamp begun = pair.bus.now();
  pair.first.say_goodbye();
  pair.second.say_goodbye();
  pair.first.wait_for_goodbye(begun);  // a moment that is past: no wait
  pair.second.wait_for_goodbye(begun + milliseconds(200));
  ASSERT_TRUE(run_until({&pair.observer.bus}, [&] {
    return pair.said["test-agv-1"].state == fleet::ServiceState::kStopping &&
           pair.said["test-agv-2"].state == fleet::ServiceState::kStopping;
  }));
}

TEST(Shells, AloneOneLetsItsExceptionPass) {
  Station station(kDomain + 8, "alone");
  station.shell.post([] { throw std::runtime_error("bug"); });
  EXPECT_THROW(run_until({&station.bus}, [] { return false; }), std::runtime_error);
}

TEST(Shells, LogLinesCarryTheNameOfTheirInstance) {
  const LogLines lines;
  Pair pair(kDomain + 9);
  pair.first.log().info("drives");
  pair.second.log().info("waits");
  pair.second.warn("plan", "plan refused");
  pair.second.warn("plan", "plan refused");
  EXPECT_EQ(lines.text(), "test-agv-1: drives\ntest-agv-2: waits\ntest-agv-2: plan refused\n");
}

}  // namespace
}  // namespace aisle::service
