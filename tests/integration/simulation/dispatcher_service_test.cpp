// The dispatcher on a bus; the test plays vehicles, local planners and the map.
#include "services/dispatcher/dispatcher_service.hpp"

#include <gtest/gtest.h>

#include <set>
#include <string>
#include <vector>

#include "common/wire/geometry.hpp"
#include "common/wire/map.hpp"
#include "common/wire/origin.hpp"
#include "common/wire/vehicle.hpp"
#include "tests/integration/simulation/site.hpp"

namespace aisle::dispatcher {
namespace {

using namespace std::chrono_literals;
using simulation_test::Folder;
using simulation_test::run_until;
using simulation_test::site;

constexpr int kDomain = 119;
constexpr int kTaskDomain = 227;

ServiceConfig two_goals() {
  ServiceConfig config;
  config.scenario.name = "yard";
  scenario::Vehicle vehicle;
  vehicle.id = "agv-1";
  config.scenario.vehicles.push_back(vehicle);
  scenario::Mission mission;
  mission.vehicle = "agv-1";
  mission.goals_in_map = {{1, 1, 0}, {2, 2, 0}};
  config.scenario.missions.push_back(mission);
  config.settings.greet_s = 0.2;
  config.settings.pause_s = 0.0;
  return config;
}

struct DispatcherProcess {
  DispatcherProcess(int domain, std::uint64_t boot_id, const ServiceConfig& config)
      : bus(site(domain, "dispatcher")),
        shell(bus, {"dispatcher", "dispatcher", "", boot_id, "", 0}),
        service(shell, config) {}
  bus::DdsBus bus;
  service::Shell shell;
  service::Health& health{shell.health()};
  DispatcherService service;
};

class Fleet {
 public:
  explicit Fleet(int domain)
      : bus(site(domain, "fleet")),
        vehicles_(bus.writer<topics::VehicleInfo>()),
        statuses_(bus.writer<topics::NavigationStatus>()),
        results_(bus.writer<topics::MapEditResult>()),
        infos_(bus.writer<topics::MapInfo>()),
        states_(bus.writer<topics::VehicleState>()),
        sent_goals_(bus.writer<topics::Goal>()) {
    bus.on<topics::Goal>([this](const aisle::Goal& sample, const bus::SampleInfo& info) {
      if (info.kind != bus::SampleKind::kData || sample.agv_id().to_string() == "any") return;
      goals.push_back(sample.goal_id().to_string());
    });
    bus.on<topics::MapEdit>([this](const aisle::MapEdit& sample, const bus::SampleInfo& info) {
      if (info.kind == bus::SampleKind::kData) edits.push_back(sample.edit_id().to_string());
    });
    aisle::VehicleInfo vehicle = wire::encode(fleet::Vehicle{"agv-1", geometry::disc(0.35), {}, 10.0, 0.2});
    vehicle.by(origin());
    vehicles_.write(vehicle);
  }
  void say(const std::string& goal_id, NavigationPhase phase) {
    aisle::NavigationStatus status;
    status.agv_id(std::string("agv-1"));
    status.by(origin());
    status.goal_id(goal_id);
    status.phase(phase);
    statuses_.write(status);
  }
  /// agv-1 stands at the origin.
  void stand() {
    aisle::VehicleState state;
    state.agv_id(std::string("agv-1"));
    state.by(origin());
    states_.write(state);
  }
  void send_any(const std::string& goal_id) {
    aisle::Goal goal = wire::encode(fleet::Goal{"any", goal_id, {1.0, 1.0, 0.0}, 0.25, 0.0, false});
    goal.by(origin());
    sent_goals_.write(goal);
  }
  void show_map() {
    grid::MapSummary summary;
    summary.map_id = "hall";
    summary.revision = 1;
    summary.tiling.geometry = grid::Geometry{10, 10, 0.1, {}};
    summary.tile_hashes = {1};
    summary.hash = grid::map_hash(summary.tile_hashes);
    aisle::MapInfo sample = wire::encode(summary);
    sample.by(origin());
    infos_.write(sample);
  }
  void answer(const std::string& edit_id) {
    fleet::MapEditResult result;
    result.edit_id = edit_id;
    result.map_id = "hall";
    result.outcome = fleet::MapEditResult::Outcome::kApplied;
    result.revision = 2;
    aisle::MapEditResult sample = wire::encode(result);
    sample.by(origin());
    results_.write(sample);
  }
  bool got(const std::string& goal) const { return !goals.empty() && goals.back() == goal; }

  bus::DdsBus bus;
  std::vector<std::string> goals;
  std::vector<std::string> edits;

 private:
  aisle::Origin origin() { return wire::encode(fleet::Origin{"fleet", 1, 1, ++sequence_, 0}); }
  std::uint64_t sequence_{0};
  bus::Writer<topics::VehicleInfo> vehicles_;
  bus::Writer<topics::NavigationStatus> statuses_;
  bus::Writer<topics::MapEditResult> results_;
  bus::Writer<topics::MapInfo> infos_;
  bus::Writer<topics::VehicleState> states_;
  bus::Writer<topics::Goal> sent_goals_;
};

TEST(DispatcherService, GivesOneGoalAfterTheOtherAndCountsThem) {
  Fleet fleet(kDomain);
  DispatcherProcess dispatcher(kDomain, 5, two_goals());
  const auto run = [&](const std::function<bool()>& done) { return run_until({&fleet.bus, &dispatcher.bus}, done); };
  ASSERT_TRUE(run([&] { return fleet.got("agv-1/0"); }));
  fleet.say("agv-1/0", NavigationPhase::PHASE_DRIVING);
  fleet.say("agv-1/0", NavigationPhase::PHASE_ARRIVED);
  ASSERT_TRUE(run([&] { return fleet.got("agv-1/1"); }));
  fleet.say("agv-1/1", NavigationPhase::PHASE_ARRIVED);
  ASSERT_TRUE(run([&] { return dispatcher.health.counters["missions_done"] == 1; }));
  EXPECT_EQ(dispatcher.health.counters["goals_reached"], 2u);
  EXPECT_EQ(dispatcher.health.counters["goals_failed"], 0u);
}

TEST(DispatcherService, RepeatsAnEditUntilItIsAnswered) {
  ServiceConfig config = two_goals();
  config.scenario.map_edits = {{0.0, true, {0.1, 0.1}, {0.5, 0.5}}};
  Fleet fleet(kDomain + 1);
  DispatcherProcess dispatcher(kDomain + 1, 5, config);
  const auto run = [&](const std::function<bool()>& done) { return run_until({&fleet.bus, &dispatcher.bus}, done); };
  fleet.show_map();
  ASSERT_TRUE(run([&] { return fleet.edits.size() >= 3; }));
  EXPECT_EQ(std::set<std::string>(fleet.edits.begin(), fleet.edits.end()).size(), 1u);
  fleet.answer(fleet.edits.front());
  ASSERT_TRUE(run([&] { return dispatcher.health.counters["edits_applied"] == 1; }));
}

TEST(DispatcherService, ARestartGoesOnWithTheOpenGoal) {
  const Folder folder("dispatcher-memory");
  for (const bool with_memory : {true, false}) {
    ServiceConfig config = two_goals();
    if (with_memory) config.state_file = folder.path() / "dispatcher.state";
    const int domain = kDomain + (with_memory ? 2 : 3);
    Fleet fleet(domain);
    {
      DispatcherProcess dispatcher(domain, 5, config);
      const auto run = [&](const std::function<bool()>& done) {
        return run_until({&fleet.bus, &dispatcher.bus}, done);
      };
      ASSERT_TRUE(run([&] { return fleet.got("agv-1/0"); }));
      fleet.say("agv-1/0", NavigationPhase::PHASE_ARRIVED);
      ASSERT_TRUE(run([&] { return fleet.got("agv-1/1"); }));
      fleet.say("agv-1/1", NavigationPhase::PHASE_DRIVING);
    }
    fleet.goals.clear();
    DispatcherProcess again(domain, 6, config);
    ASSERT_TRUE(run_until({&fleet.bus, &again.bus}, [&] { return !fleet.goals.empty(); }));
    EXPECT_EQ(fleet.goals.front(), "agv-1/1") << "with memory: " << with_memory;
  }
}

/// A goal that a person sent is written nowhere else, so that a restart must remember it.
TEST(DispatcherService, AGoalForAnyVehicleIsGivenToOneAlsoAfterARestart) {
  const Folder folder("dispatcher-tasks");
  ServiceConfig config = two_goals();
  config.scenario.missions.clear();
  config.state_file = folder.path() / "dispatcher.state";
  Fleet fleet(kTaskDomain);
  fleet.bus.every(50ms, [&] {
    fleet.stand();
    if (fleet.goals.empty()) fleet.say("", NavigationPhase::PHASE_WAITING);
  });
  fleet.bus.every(200ms, [&] { fleet.send_any("aisle-7"); });
  {
    DispatcherProcess dispatcher(kTaskDomain, 5, config);
    ASSERT_TRUE(run_until({&fleet.bus, &dispatcher.bus}, [&] { return fleet.got("aisle-7"); }));
    EXPECT_EQ(dispatcher.health.counters["missions_done"], 0u);
  }
  const std::optional<DispatcherMemory> memory = recall(config.state_file, "yard");
  ASSERT_TRUE(memory);
  ASSERT_EQ(memory->tasks.size(), 1u);
  EXPECT_EQ(memory->tasks[0].stage, TaskProgress::Stage::kGiven);
  EXPECT_EQ(memory->tasks[0].task.stops.at(0).goal_in_map.x, 1.0);
  DispatcherProcess again(kTaskDomain, 6, config);
  ASSERT_TRUE(run_until({&fleet.bus, &again.bus}, [&] {
    fleet.say("aisle-7", NavigationPhase::PHASE_ARRIVED);
    return again.health.counters["missions_done"] == 1 && again.health.counters["goals_reached"] == 1;
  }));
}

}  // namespace
}  // namespace aisle::dispatcher
