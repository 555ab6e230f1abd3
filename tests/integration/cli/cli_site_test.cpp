// The program `aisle` against a site that this test plays: two vehicles, a planner, a map.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/bus/dds/dds_bus.hpp"
#include "common/grid/formats/map_file.hpp"
#include "common/grid/tiles.hpp"
#include "common/process/clock.hpp"
#include "common/service/health_file.hpp"
#include "common/service/origin_stamper.hpp"
#include "common/service/versions.hpp"
#include "common/wire/map.hpp"
#include "common/wire/traffic.hpp"
#include "tests/support/child_process.hpp"
#include "tests/support/places.hpp"

namespace aisle {
namespace {

using nlohmann::json;
using std::chrono::milliseconds;
using std::chrono::seconds;
using test_support::ChildProcess;
using ::testing::AllOf;
using ::testing::ContainsRegex;
using ::testing::HasSubstr;
using ::testing::Not;

struct Outcome {
  int code{-1};
  std::string out;
  std::string err;
};

bus::Settings on_loopback(int domain) {
  bus::Settings settings;
  settings.domain = domain;
  settings.interfaces = {"127.0.0.1"};
  settings.participant_name = "test-site";
  return settings;
}

std::vector<std::string> command_in(int domain, const std::vector<std::string>& arguments) {
  std::vector<std::string> command{test_support::program("aisle")};
  command.insert(command.end(), arguments.begin(), arguments.end());
  command.insert(command.end(), {"--domain", std::to_string(domain), "--interface", "127.0.0.1"});
  return command;
}

Outcome run_alone(const std::vector<std::string>& arguments) {
  std::vector<std::string> command{test_support::program("aisle")};
  command.insert(command.end(), arguments.begin(), arguments.end());
  ChildProcess aisle(command);
  const int code = aisle.wait(seconds(60)).value_or(-1);
  return {code, aisle.out(), aisle.err()};
}

class CliSite : public ::testing::Test {
 protected:
  explicit CliSite() : domain_(next_domain()), bus_(on_loopback(domain_)) {}

  /// Runs `aisle` in this site's domain while the site goes on.
  Outcome run(const std::vector<std::string>& arguments) {
    ChildProcess aisle(command_in(domain_, arguments));
    const auto end = std::chrono::steady_clock::now() + seconds(60);
    std::optional<int> code;
    while (!code && std::chrono::steady_clock::now() < end) {
      bus_.run_once(milliseconds(10));
      code = aisle.wait(milliseconds(5));
    }
    return {code.value_or(-1), aisle.out(), aisle.err()};
  }

  void play_vehicles() {
    for (const char* id : {"agv-1", "agv-2"}) {
      VehicleInfo info;
      info.agv_id(std::string(id));
      infos_.write(info);
    }
    bus_.every(milliseconds(50), [this] {
      for (const char* id : {"agv-1", "agv-2"}) {
        VehicleState state;
        state.agv_id(std::string(id));
        state.by(vehicle_stamper_.next());
        state.twist().linear_mps(0.75);
        states_.write(state);
      }
    });
  }

  /// Plans every goal with x up to 100; the vehicle drives for four ticks and arrives.
  void play_planners() {
    bus_.every(milliseconds(50), [this] {
      plans_.assert_liveliness();
      drive();
    });
    bus_.on<topics::Goal>([this](const Goal& goal, const bus::SampleInfo& info) {
      if (info.kind != bus::SampleKind::kData) return;
      if (goal.goal_id().to_string() == status_.goal_id().to_string() && !goal.cancelled()) return;  // said again
      Plan plan;
      plan.agv_id(goal.agv_id().to_string());
      plan.goal_id(goal.goal_id().to_string());
      plan.length_m(12.5);
      const bool is_outside = goal.pose_in_map().x_m() > 100.0;
      plan.outcome(goal.cancelled() ? PlanOutcome::PLAN_CANCELLED
                   : is_outside     ? PlanOutcome::PLAN_OUT_OF_MAP
                                    : PlanOutcome::PLAN_FOUND);
      plan.detail(std::string(is_outside ? "x = 500 is beyond 40" : ""));
      if (plan.outcome() == PlanOutcome::PLAN_FOUND) plan.waypoints_in_map().resize(2);
      plans_.write(plan);
      status_.agv_id(goal.agv_id().to_string());
      status_.goal_id(goal.goal_id().to_string());
      ticks_left_ = plan.outcome() == PlanOutcome::PLAN_FOUND ? 4 : 0;
      goals_.push_back(goal);
    });
  }
  void drive() {
    if (ticks_left_ <= 0) return;
    --ticks_left_;
    status_.phase(ticks_left_ > 0 ? NavigationPhase::PHASE_DRIVING : NavigationPhase::PHASE_ARRIVED);
    status_.distance_left_m(3.0 * ticks_left_);
    statuses_.write(status_);
  }

  void play_map() {
    grid::Geometry geometry;
    geometry.width = 100;
    geometry.height = 70;
    geometry.resolution_m = 0.1;
    grid_ = grid::OccupancyGrid(geometry);
    grid_.set({3, 4}, grid::Occupancy::kOccupied);
    const grid::Tiling tiling{64, geometry};
    grid::MapSummary summary;
    summary.map_id = "hall";
    summary.revision = 5;
    summary.tiling = tiling;
    for (int index = 0; index < tiling.count(); ++index) {
      grid::Tile tile{
          "hall", index % tiling.tiles_x(), index / tiling.tiles_x(), 5, 0, grid::tile_cells(grid_, tiling, index)};
      tile.hash = grid::tile_hash(tile.cells);
      summary.tile_hashes.push_back(tile.hash);
      tiles_.write(wire::encode(tile));
    }
    summary.hash = grid::map_hash(summary.tile_hashes);
    map_infos_.write(wire::encode(summary));
    bus_.on<topics::MapEdit>([this](const MapEdit& edit, const bus::SampleInfo& info) {
      if (info.kind != bus::SampleKind::kData) return;
      ++edits_heard_;
      newest_edit_ = edit;
      if (edits_heard_ <= edits_to_miss_) return;
      MapEditResult result;
      result.edit_id(edit.edit_id().to_string());
      result.map_id(edit.map_id().to_string());
      const bool is_new = applied_.insert(edit.edit_id().to_string()).second;
      const bool is_outside = edit.points()[0].x_m() > 100.0;
      result.outcome(is_outside ? EditOutcome::EDIT_REFUSED
                     : is_new   ? EditOutcome::EDIT_APPLIED
                                : EditOutcome::EDIT_ALREADY_APPLIED);
      result.detail(std::string(is_outside ? "outside the map" : ""));
      result.revision(6);
      result.changed_cells(42);
      edit_results_.write(result);
    });
  }

  void play_service(const std::string& instance_id, ServiceState state, const std::string& waits_for = "") {
    bus_.every(milliseconds(200), [this, instance_id, state, waits_for] {
      ServiceHealth health;
      health.instance_id(instance_id);
      health.by().boot_id(77);
      health.service(std::string("idle"));
      health.host(std::string("testhost"));
      health.idl_version(service::kIdlVersion);
      health.state(state);
      health.waits_for(waits_for);
      health.wall_clock_ns(process::wall_clock_ns() + clock_error_ns_);
      health_.write(health);
    });
  }

  /// A standing thing as track 7 and somebody who walks as track 8, as the tracker says them.
  void play_tracker() {
    bus_.every(milliseconds(100), [this] {
      for (const std::uint64_t id : {7U, 8U}) {
        Track track;
        track.track_id(id);
        track.position_in_map().x_m(id == 7 ? 4.25 : 6.0);
        track.position_in_map().y_m(2.0);
        track.radius_m(0.4);
        track.is_static(id == 7);
        tracks_.write(track);
      }
    });
  }

  static int next_domain() {
    static int domain = 29;  // 30 and the next ones are this suite's
    return ++domain;
  }

  int domain_;
  bus::DdsBus bus_;
  bus::Writer<topics::VehicleInfo> infos_{bus_.writer<topics::VehicleInfo>()};
  bus::Writer<topics::VehicleState> states_{bus_.writer<topics::VehicleState>()};
  bus::Writer<topics::Plan> plans_{bus_.writer<topics::Plan>()};
  bus::Writer<topics::NavigationStatus> statuses_{bus_.writer<topics::NavigationStatus>()};
  bus::Writer<topics::MapInfo> map_infos_{bus_.writer<topics::MapInfo>()};
  bus::Writer<topics::MapTile> tiles_{bus_.writer<topics::MapTile>()};
  bus::Writer<topics::MapEditResult> edit_results_{bus_.writer<topics::MapEditResult>()};
  bus::Writer<topics::Track> tracks_{bus_.writer<topics::Track>()};
  bus::Writer<topics::Coverage> coverages_{bus_.writer<topics::Coverage>()};
  bus::Writer<topics::ServiceHealth> health_{bus_.writer<topics::ServiceHealth>()};
  service::OriginStamper vehicle_stamper_{bus_, "fake-vehicle", 5};
  NavigationStatus status_;
  int ticks_left_{0};
  std::vector<Goal> goals_;
  grid::OccupancyGrid grid_;
  std::set<std::string> applied_;
  int edits_heard_{0};
  MapEdit newest_edit_;
  int edits_to_miss_{0};
  std::int64_t clock_error_ns_{0};
};

TEST_F(CliSite, TopicListCountsWritersAndReaders) {
  const Outcome outcome = run({"topic", "list", "--wait", "4", "--json"});
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const json rows = json::parse(outcome.out);
  ASSERT_EQ(rows.size(), 22u);
  for (const json& row : rows) {
    if (row["topic"] != "plan") continue;
    EXPECT_EQ(row["type"], "aisle::Plan");
    EXPECT_EQ(row["writers"], 1);
    EXPECT_EQ(row["readers"], 0);
  }
  EXPECT_THAT(run({"topic", "list", "--wait", "0.5"}).out,
              HasSubstr("velocity_command   0        0        aisle::VelocityCommand"));
}

TEST_F(CliSite, TopicInfoNamesThePeersOfOneTopic) {
  const Outcome outcome = run({"topic", "info", "plan", "--wait", "4"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("type: aisle::Plan"), HasSubstr("writer  test-site")));
}

TEST_F(CliSite, TopicEchoPrintsSamplesOfOneInstance) {
  play_vehicles();
  const Outcome text = run({"topic", "echo", "vehicle_state", "--once", "--key", "agv-2"});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_THAT(text.out, AllOf(HasSubstr("agv_id: agv-2\n"),
                              HasSubstr("twist: {linear_mps: 0.75, angular_radps: 0, sideways_mps: 0}\n"),
                              HasSubstr("hold: none\n")));
  const Outcome lines = run({"topic", "echo", "vehicle_state", "--count", "3", "--json"});
  EXPECT_EQ(lines.code, 0);
  EXPECT_EQ(std::count(lines.out.begin(), lines.out.end(), '\n'), 3);
  EXPECT_EQ(json::parse(lines.out.substr(0, lines.out.find('\n')))["twist"]["linear_mps"], 0.75);
}

TEST_F(CliSite, TopicEchoWithoutSamplesSaysSoAndFails) {
  const Outcome outcome = run({"topic", "echo", "plan", "--once", "--timeout", "1"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("no sample on 'plan' yet; 1 writers seen in domain"));
}

TEST_F(CliSite, TopicRatesAreMeasuredByInstance) {
  play_vehicles();
  const Outcome hz = run({"topic", "hz", "vehicle_state", "--seconds", "2", "--json"});
  ASSERT_EQ(hz.code, 0) << hz.err;
  const json first = json::parse(hz.out.substr(0, hz.out.find('\n')));
  EXPECT_EQ(first["key"], "agv-1");
  EXPECT_GT(first["hz"].get<double>(), 0.0);
  EXPECT_LT(first["hz"].get<double>(), 25.0);  // 20 of each vehicle, fewer on a loaded machine; never both together
  EXPECT_GT(first["mean_bytes"].get<double>(), 100.0);
  EXPECT_THAT(run({"topic", "bw", "vehicle_state", "--seconds", "3"}).out,
              AllOf(HasSubstr("KB/S"), HasSubstr("agv-2")));
  EXPECT_EQ(run({"topic", "hz", "scan", "--seconds", "0.3"}).code, 1);
}

TEST_F(CliSite, FleetShowsVehiclesAndServices) {
  play_vehicles();
  play_service("map", ServiceState::SERVICE_READY);
  const Outcome text = run({"fleet", "--wait", "5"});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_THAT(text.out, AllOf(HasSubstr("agv-1"), HasSubstr("0.75"), HasSubstr("map      ready")));
  EXPECT_THAT(text.out, Not(HasSubstr("\x1b")));
  const json snapshot = json::parse(run({"fleet", "--json", "--wait", "5"}).out);
  ASSERT_EQ(snapshot["vehicles"].size(), 2u);
  EXPECT_EQ(snapshot["vehicles"][0]["online"], true);
}

TEST_F(CliSite, TrafficTellsWhichVehicleWaitsForWhichAndDrawsIt) {
  play_vehicles();
  play_map();
  bus::Writer<topics::TrafficStatus> traffic = bus_.writer<topics::TrafficStatus>();
  bus_.every(milliseconds(100), [&] {
    fleet::TrafficStatus status;
    status.source_id = "global-planner-1";
    status.waiting = {{"agv-1", "agv-2", "the lane is taken", 3.0}};
    traffic.write(wire::encode(status));
  });
  const std::string file =
      (std::filesystem::temp_directory_path() / ("aisle-traffic-" + std::to_string(getpid()) + ".svg")).string();
  const Outcome text = run({"traffic", "--once", "--wait", "20", "--svg", file});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_THAT(text.out, AllOf(HasSubstr("leader global-planner-1"), HasSubstr("agv-1    agv-2      3.0")));
  EXPECT_GT(std::filesystem::file_size(file), 1000U);
  std::filesystem::remove(file);
  const json snapshot = json::parse(run({"traffic", "--json", "--wait", "20"}).out);
  EXPECT_EQ(snapshot["waiting"][0]["waits_for"], "agv-2");
}

TEST_F(CliSite, GoalSendReportsThePlan) {
  play_vehicles();
  play_planners();
  const Outcome outcome = run({"goal", "send", "agv-1", "-4.5,2,1.5", "--id", "g1"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("agv-1 goes 12.5 m to "));
  ASSERT_FALSE(goals_.empty());
  EXPECT_EQ(goals_[0].pose_in_map().x_m(), -4.5);
  EXPECT_EQ(goals_[0].yaw_tolerance_rad(), 0.15);
  EXPECT_EQ(goals_[0].goal_id().to_string(), "g1");
}

TEST_F(CliSite, GoalSendWithWaitFollowsTheVehicle) {
  play_vehicles();
  play_planners();
  const Outcome outcome = run({"goal", "send", "agv-1", "4,2", "--wait"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("agv-1 driving, 9.0 m"));
  EXPECT_THAT(outcome.out, HasSubstr("agv-1 arrived\n"));
  ASSERT_FALSE(goals_.empty());
  EXPECT_EQ(goals_[0].yaw_tolerance_rad(), 0.0);  // any heading
}

TEST_F(CliSite, GoalSendSaysWhyItIsImpossible) {
  play_vehicles();
  play_planners();
  const Outcome outcome = run({"goal", "send", "agv-1", "500,2", "--wait"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.err, "agv-1 cannot go there: out_of_map: x = 500 is beyond 40\n");
}

TEST_F(CliSite, GoalSendToAnUnknownVehicleNamesTheOnesSeen) {
  play_vehicles();
  const Outcome outcome = run({"goal", "send", "agv-11", "4,2"});
  EXPECT_EQ(outcome.code, 2);
  EXPECT_EQ(outcome.err, "aisle: no vehicle 'agv-11'; did you mean 'agv-1'? Seen are: agv-1, agv-2\n");
}

TEST_F(CliSite, GoalSendWithoutAPlannerSaysSo) {
  play_vehicles();
  const Outcome outcome = run({"goal", "send", "agv-1", "4,2", "--timeout", "3"});
  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.err, HasSubstr("nobody reads goals; is aisle-global-planner running?"));
}

TEST_F(CliSite, GoalCancelDropsTheOpenGoal) {
  play_vehicles();
  play_planners();
  EXPECT_THAT(run({"goal", "cancel", "agv-1"}).err, HasSubstr("agv-1 has no goal"));
  ASSERT_EQ(run({"goal", "send", "agv-1", "4,2", "--id", "g9"}).code, 0);
  const Outcome outcome = run({"goal", "cancel", "agv-1"});
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "agv-1 dropped goal g9\n");
  EXPECT_TRUE(goals_.back().cancelled());
}

TEST_F(CliSite, MapInfoAndSave) {
  play_map();
  const Outcome info = run({"map", "info"});
  EXPECT_EQ(info.code, 0) << info.err;
  EXPECT_THAT(info.out, AllOf(HasSubstr("map_id: hall"), HasSubstr("revision: 5"), HasSubstr("tiles: 4"),
                              HasSubstr("width_m: 10")));

  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("aisle_cli_" + std::to_string(getpid()));
  std::filesystem::create_directory(folder);
  const Outcome saved = run({"map", "save", (folder / "hall.yaml").string()});
  EXPECT_EQ(saved.code, 0) << saved.err;
  const grid::OccupancyGrid read = grid::read_map_file(folder / "hall.yaml");
  EXPECT_EQ(read.cells(), grid_.cells());
  EXPECT_EQ(read.geometry(), grid_.geometry());
  EXPECT_EQ(run({"map", "save", (folder / "hall.png").string()}).code, 2);
  EXPECT_EQ(run({"map", "save", (folder / "none" / "hall.yaml").string()}).code, 2);
  std::filesystem::remove_all(folder);
}

TEST_F(CliSite, MapEditsAreRepeatedUntilAnsweredAndAppliedOnce) {
  play_map();
  edits_to_miss_ = 1;
  const Outcome blocked = run({"map", "block", "--rect", "-1,0,4,2", "--id", "e1"});
  EXPECT_EQ(blocked.code, 0) << blocked.err;
  EXPECT_EQ(blocked.out, "applied: 42 cells changed, the map is at revision 6 now (edit e1)\n");
  EXPECT_GE(edits_heard_, 2);
  EXPECT_EQ(run({"map", "block", "--rect", "-1,0,4,2", "--id", "e1"}).out,
            "was applied before, in revision 6 (edit e1)\n");
  const Outcome refused = run({"map", "unblock", "--disc", "500,0,1"});
  EXPECT_EQ(refused.code, 1);
  EXPECT_THAT(refused.err, HasSubstr("refused: outside the map"));
  EXPECT_EQ(run({"map", "block", "--polygon", "0,0", "4,0", "2,3"}).code, 0);
}

TEST_F(CliSite, MapOverlayListsWhatStandsAndOnlyThat) {
  EXPECT_EQ(run({"map", "overlay", "--wait", "0.5"}).code, 3) << "no tracker is there";
  play_tracker();
  const Outcome text = run({"map", "overlay", "--wait", "30"});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("7      4.25  2.00  0.40"));
  const Outcome lines = run({"map", "overlay", "--wait", "30", "--json"});
  ASSERT_EQ(lines.code, 0) << lines.err;
  const json overlay = json::parse(lines.out);
  ASSERT_EQ(overlay.size(), 1u);
  EXPECT_EQ(overlay[0]["track_id"], 7);
}

TEST_F(CliSite, MapAcceptBlocksWhatAStandingTrackCovers) {
  play_map();
  play_tracker();
  const Outcome accepted = run({"map", "accept", "7", "--timeout", "30"});
  EXPECT_EQ(accepted.code, 0) << accepted.err;
  EXPECT_EQ(accepted.out, "applied: 42 cells changed, the map is at revision 6 now (edit track-7)\n");
  EXPECT_EQ(newest_edit_.action(), EditAction::EDIT_BLOCK);
  EXPECT_EQ(newest_edit_.shape(), EditShape::SHAPE_DISC);
  ASSERT_EQ(newest_edit_.points().size(), 1u);
  EXPECT_EQ(newest_edit_.points()[0].x_m(), 4.25);
  EXPECT_EQ(newest_edit_.radius_m(), 0.4);
  EXPECT_THAT(run({"map", "accept", "7", "--timeout", "30"}).out, HasSubstr("was applied before"));
}

TEST_F(CliSite, MapAcceptRefusesWhatMovesAndWhatIsNotThere) {
  play_map();
  play_tracker();
  const Outcome moving = run({"map", "accept", "8", "--timeout", "30"});
  EXPECT_EQ(moving.code, 1);
  EXPECT_THAT(moving.err, HasSubstr("track 8 has not stood for 3 s"));
  const Outcome unknown = run({"map", "accept", "9", "--timeout", "4"});
  EXPECT_EQ(unknown.code, 1);
  EXPECT_THAT(unknown.err, HasSubstr("no track 9 is there"));
  EXPECT_EQ(run({"map", "accept", "seven"}).code, 2);
  EXPECT_EQ(edits_heard_, 0);
}

TEST_F(CliSite, TopicEchoDrawsCoverage) {
  Coverage tile;
  tile.source_id(std::string("obstacle-tracker"));
  tile.width_cells(3);
  tile.height_cells(2);
  tile.cell_m(0.5);
  tile.age_step_s(0.5);
  tile.ages({0, 2, 3, 20, 254, 255});
  coverages_.write(tile);  // a late joiner gets it
  const Outcome text = run({"topic", "echo", "coverage", "--once"});
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_THAT(text.out, HasSubstr("cells_seen_in_1_s: 2\ncells_never_seen: 1\n"));
  EXPECT_THAT(text.out, HasSubstr("picture:\n  |+. |\n  |##+|\n"));
}

TEST_F(CliSite, HealthIsOneServicesExitCode) {
  play_service("map", ServiceState::SERVICE_READY);
  play_service("global-planner", ServiceState::SERVICE_WAITING, "map_info");
  EXPECT_EQ(run({"health", "map"}).code, 0);
  const Outcome waiting = run({"health", "global-planner", "--timeout", "4"});
  EXPECT_EQ(waiting.code, 1);
  EXPECT_EQ(waiting.out, "global-planner: waiting, waits for map_info\n");
  const Outcome unknown = run({"health", "mapp", "--timeout", "3"});
  EXPECT_EQ(unknown.code, 1);
  EXPECT_THAT(unknown.err, HasSubstr("did you mean 'map'?"));
}

TEST(CliHealth, ReadsWhatAServiceOfThisHostKeeps) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("aisle_kept_" + std::to_string(getpid()) + ".json");
  const auto check = [&](const std::string& instance) {
    return run_alone({"health", instance, "--file", file.string()});
  };
  EXPECT_THAT(check("map").err, HasSubstr("is not a health file of 'map'"));
  ASSERT_TRUE(service::keep(file, {"map", fleet::ServiceState::kReady, "", "", process::wall_clock_ns()}));
  EXPECT_EQ(check("map").code, 0);
  EXPECT_EQ(check("global-planner").code, 1);
  ASSERT_TRUE(service::keep(file, {"map", fleet::ServiceState::kWaiting, "its disk", "", process::wall_clock_ns()}));
  EXPECT_EQ(check("map").code, 1);
  EXPECT_EQ(check("map").out, "map: waiting, waits for its disk\n");
  ASSERT_TRUE(
      service::keep(file, {"map", fleet::ServiceState::kReady, "", "", process::wall_clock_ns() - 10'000'000'000}));
  EXPECT_EQ(check("map").code, 1);
  EXPECT_THAT(check("map").out, ContainsRegex("^map: silent for 1[0-9]\\.[0-9] s"));
  std::filesystem::remove(file);
}

TEST_F(CliSite, DoctorFindsNothingWhereAllIsWell) {
  play_vehicles();
  play_service("map", ServiceState::SERVICE_READY);
  const Outcome outcome = run({"doctor", "--wait", "5"});
  EXPECT_EQ(outcome.code, 0) << outcome.out;
  EXPECT_THAT(outcome.out, AllOf(HasSubstr("1 other processes, 1 services, 2 vehicles"), HasSubstr("nothing wrong")));
}

TEST_F(CliSite, DoctorSaysWhatIsWrong) {
  clock_error_ns_ = 30'000'000'000;
  play_vehicles();
  play_service("global-planner", ServiceState::SERVICE_WAITING, "map_info");
  service::OriginStamper other(bus_, "truck", 6);
  bus_.every(
      milliseconds(70),
      [&] {  // out of step with the other, so that of a reader that keeps one sample neither is always the one lost
        VehicleState state;
        state.agv_id(std::string("agv-1"));
        state.by(other.next());
        states_.write(state);
      });
  const Outcome outcome = run({"doctor", "--wait", "5", "--json"});
  EXPECT_EQ(outcome.code, 1);
  std::set<std::string> about;
  const json report = json::parse(outcome.out);
  for (const json& problem : report["problems"]) about.insert(problem["about"]);
  EXPECT_EQ(about, (std::set<std::string>{"clock", "service", "vehicle"})) << outcome.out;
}

TEST_F(CliSite, DoctorNamesTheDomainWhereSomebodyIs) {
  bus::DdsBus elsewhere(on_loopback(13));
  const Outcome outcome = run_alone({"doctor", "--wait", "3", "--domain", "68", "--interface", "127.0.0.1"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.out,
              AllOf(HasSubstr("nobody seen in domain 68"), HasSubstr("13"), HasSubstr("use --domain or AISLE_DOMAIN")));
}

TEST_F(CliSite, DoctorNamesThePartitionThatOthersUse) {
  const Outcome outcome = run({"doctor", "--wait", "4", "--partition", "hall-2"});
  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(
      outcome.out,
      HasSubstr("partition: nobody uses partition 'hall-2'; others use '': set --partition or AISLE_PARTITION"));
}

TEST(CliInput, ThatIsBadIsNamedWithExitCode2) {
  const std::vector<std::pair<std::vector<std::string>, std::string>> refusals{
      {{"topic", "echo", "plans"}, "aisle: unknown topic 'plans'; did you mean 'plan'?\n"},
      {{"topc"}, "did you mean 'topic'?"},
      {{"goal", "send", "agv-1"}, "pose is required; see --help\n"},
      {{"goal", "send", "agv-1", "4;5"}, "aisle: goal: '4;5' is not a list of numbers; write e.g. 4.5,12"},
      {{"map", "block"}, "aisle: give one shape: --rect"},
      {{"fleet", "--domain", "300"}, "aisle: --domain: Value 300 not in range"},
      {{"fleet", "--jsn"}, "aisle: unknown flag '--jsn'; did you mean '--json'?\n"},
      {{}, "see --help\n"},
  };
  for (const auto& [arguments, line] : refusals) {
    const Outcome outcome = run_alone(arguments);
    EXPECT_EQ(outcome.code, 2) << line;
    EXPECT_THAT(outcome.err, HasSubstr(line));
  }
}

TEST(CliInput, WithoutASiteEndsWithExitCode3) {
  const std::vector<std::string> nowhere{"--domain", "69", "--interface", "127.0.0.1"};
  for (std::vector<std::string> arguments : {std::vector<std::string>{"goal", "send", "agv-1", "1,2"},
                                             {"map", "info", "--timeout", "1"},
                                             {"traffic", "--wait", "1"},
                                             {"map", "block", "--disc", "1,2,3", "--timeout", "1"}}) {
    arguments.insert(arguments.end(), nowhere.begin(), nowhere.end());
    const Outcome outcome = run_alone(arguments);
    EXPECT_EQ(outcome.code, 3) << outcome.err;
    EXPECT_THAT(outcome.err, HasSubstr("aisle doctor looks for the cause"));
  }
}

TEST(CliInput, EveryVerbHasHelpAndJson) {
  const std::vector<std::vector<std::string>> verbs{{"topic", "list"},
                                                    {"topic", "info"},
                                                    {"topic", "echo"},
                                                    {"topic", "hz"},
                                                    {"topic", "bw"},
                                                    {"fleet"},
                                                    {"goal", "send"},
                                                    {"goal", "cancel"},
                                                    {"map", "info"},
                                                    {"map", "block"},
                                                    {"map", "unblock"},
                                                    {"map", "save"},
                                                    {"map", "zone", "list"},
                                                    {"map", "zone", "add"},
                                                    {"map", "zone", "remove"},
                                                    {"doctor"},
                                                    {"health"},
                                                    {"traffic"}};
  for (std::vector<std::string> verb : verbs) {
    verb.push_back("--help");
    const Outcome outcome = run_alone(verb);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_THAT(outcome.out, HasSubstr("--json"));
  }
}

TEST_F(CliSite, AnEndlessEchoStopsCleanlyOnASignal) {
  ChildProcess aisle(command_in(domain_, {"topic", "echo", "plan"}));
  ASSERT_TRUE(aisle.wait_for_output("no sample on 'plan' yet", seconds(20)));
  aisle.signal(SIGINT);
  EXPECT_EQ(aisle.wait(seconds(5)), 1);  // none came
}

}  // namespace
}  // namespace aisle
