#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "common/bus/dds/dds_bus.hpp"
#include "tests/integration/bus/two_buses.hpp"

namespace aisle::bus_test {
namespace {

using bus::SampleInfo;
using bus::SampleKind;

aisle::VehicleState state_of(const std::string& agv) {
  aisle::VehicleState state;
  state.agv_id(agv);
  return state;
}

TEST(Bus, CarriesASampleWithItsFields) {
  DdsBus sender(loopback(200)), receiver(loopback(200));
  auto goals = sender.writer<topics::Goal>();
  std::vector<aisle::Goal> got;
  receiver.on<topics::Goal>([&](const aisle::Goal& goal, const SampleInfo& info) {
    EXPECT_EQ(info.kind, SampleKind::kData);
    EXPECT_FALSE(info.writer.empty());
    got.push_back(goal);
  });
  aisle::Goal goal;
  goal.agv_id("agv-1");
  goal.goal_id("g-1");
  goal.pose_in_map().x_m(1.5);
  ASSERT_TRUE(goals.write(goal));
  ASSERT_TRUE(run_until({&sender, &receiver}, [&] { return !got.empty(); }));
  EXPECT_EQ(got[0], goal);
}

TEST(Bus, GivesALateJoinerEveryMapTile) {
  constexpr int kTiles = 432;
  DdsBus sender(loopback(201));
  auto tiles = sender.writer<topics::MapTile>();
  aisle::MapTile tile;
  tile.map_id("site");
  tile.cells().resize(64 * 64, 1);
  for (int i = 0; i < kTiles; ++i) {
    tile.tile_x(static_cast<std::uint32_t>(i % 24));
    tile.tile_y(static_cast<std::uint32_t>(i / 24));
    ASSERT_TRUE(tiles.write(tile)) << i;
  }
  DdsBus late(loopback(201));
  std::set<std::pair<std::uint32_t, std::uint32_t>> got;
  late.on<topics::MapTile>(
      [&](const aisle::MapTile& sample, const SampleInfo&) { got.emplace(sample.tile_x(), sample.tile_y()); });
  EXPECT_TRUE(run_until({&sender, &late}, [&] { return got.size() == kTiles; })) << got.size();
}

TEST(Bus, KeepsAHundredVehiclesApart) {
  DdsBus sender(loopback(202)), receiver(loopback(202));
  auto states = sender.writer<topics::VehicleState>();
  std::set<std::string> got;
  receiver.on<topics::VehicleState>(
      [&](const aisle::VehicleState& state, const SampleInfo&) { got.insert(state.agv_id().to_string()); });
  sender.every(20ms, [&] {
    for (int i = 0; i < 100; ++i) states.write(state_of("agv-" + std::to_string(i)));
  });
  EXPECT_TRUE(run_until({&sender, &receiver}, [&] { return got.size() == 100; })) << got.size();
}

TEST(Bus, TellsOfADisposalWithTheKey) {
  DdsBus sender(loopback(203)), receiver(loopback(203));
  auto tracks = sender.writer<topics::Track>();
  std::vector<std::uint64_t> seen, gone;
  receiver.on<topics::Track>([&](const aisle::Track& track, const SampleInfo& info) {
    (info.kind == SampleKind::kDisposed ? gone : seen).push_back(track.track_id());
  });
  ASSERT_TRUE(run_until({&sender, &receiver}, [&] { return tracks.matched_readers() == 1; }));
  aisle::Track track;
  for (std::uint64_t id : {7U, 8U}) {
    track.track_id(id);
    ASSERT_TRUE(tracks.write(track));
  }
  ASSERT_TRUE(run_until({&sender, &receiver}, [&] { return seen.size() == 2; }));
  ASSERT_TRUE(tracks.dispose(track));
  ASSERT_TRUE(run_until({&sender, &receiver}, [&] { return !gone.empty(); }));
  EXPECT_EQ(gone, std::vector<std::uint64_t>{8});
}

TEST(Bus, CarriesSamplesBeyond64Kilobytes) {
  DdsBus sender(loopback(204)), receiver(loopback(204));
  auto infos = sender.writer<topics::MapInfo>();
  aisle::MapInfo info, got;
  info.map_id("site");
  for (std::uint64_t i = 0; i < 16384; ++i) info.tile_hashes().push_back(i * i);
  receiver.on<topics::MapInfo>([&](const aisle::MapInfo& sample, const SampleInfo&) { got = sample; });
  ASSERT_TRUE(infos.write(info));
  ASSERT_TRUE(run_until({&sender, &receiver}, [&] { return !got.tile_hashes().empty(); }));
  EXPECT_EQ(got, info);
}

TEST(Bus, RunsTimersAtTheirPeriod) {
  DdsBus bus(loopback(205));
  int ticks = 0;
  bus.every(10ms, [&] { ++ticks; });
  EXPECT_TRUE(run_until({&bus}, [&] { return ticks >= 20; }));
  const auto start = std::chrono::steady_clock::now();
  ticks = 0;
  ASSERT_TRUE(run_until({&bus}, [&] { return ticks >= 50; }));
  const auto took = std::chrono::steady_clock::now() - start;
  EXPECT_GE(took, 450ms);
}

TEST(Bus, DeliversEachEditOfAQueueOnce) {
  constexpr int kEdits = 3000;
  DdsBus sender(loopback(206)), receiver(loopback(206));
  auto edits = sender.writer<topics::MapEdit>();
  std::vector<std::string> got;
  receiver.on<topics::MapEdit>([&](const aisle::MapEdit& edit, const SampleInfo& info) {
    EXPECT_EQ(info.kind, SampleKind::kData);
    got.push_back(edit.edit_id().to_string());
  });
  ASSERT_TRUE(run_until({&sender, &receiver}, [&] { return edits.matched_readers() == 1; }));
  int sent = 0;
  EXPECT_TRUE(run_until(
      {&sender, &receiver},
      [&] {
        aisle::MapEdit edit;
        edit.edit_id("edit-" + std::to_string(sent));
        if (sent < kEdits && edits.write(edit)) ++sent;
        return got.size() == kEdits;
      },
      60s))
      << sent << " sent, " << got.size() << " got";
  EXPECT_EQ(std::set<std::string>(got.begin(), got.end()).size(), static_cast<std::size_t>(kEdits));
}

}  // namespace
}  // namespace aisle::bus_test
