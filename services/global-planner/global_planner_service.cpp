#include "services/global-planner/global_planner_service.hpp"

#include <spdlog/logger.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "common/config/reader.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kTurn{20};
constexpr milliseconds kAssert{50};  // four times within a lease of 200 ms
constexpr milliseconds kBeat{100};   // between two statuses of the traffic
constexpr std::uint32_t kMostEpochs = 2'000'000;
constexpr const char* kPerson = "aisle";          // the command line: a source of sign_off
constexpr const char* kPlanEpoch = "plan_epoch";  // counter in service_health: of the plans that a service follows

/// @throws config::BadInput, which lists the planners that there are
std::unique_ptr<Planner> make_planner(const std::string& name, const Parameters& parameters) {
  if (const Variant* variant = find_variant(name)) return variant->make(parameters);

  std::string names;
  for (const Variant& variant : all_variants()) names += (names.empty() ? "" : ", ") + variant.name;
  throw config::BadInput("planner: '" + name + "' is unknown; there are " + names);
}

/// Ownership on the wire follows authority: a later epoch always wins, and `strength` decides within one epoch.
int ownership_strength(std::uint32_t epoch, int strength) {
  return static_cast<int>(std::min(epoch, kMostEpochs)) * 1000 + strength;
}

}  // namespace

GlobalPlannerService::GlobalPlannerService(service::Shell& shell, const ServiceConfig& config)
    : shell_(shell),
      config_(config),
      map_(shell.map(
          {{}, false, 0.0, milliseconds(300)},
          [this](const grid::OccupancyGrid& grid, const grid::ClearanceField&, grid::Cell low, grid::Cell high) {
            fleet_.set_map(map_.map_id(), map_.revision(), grid, low, high);
            work_soon_();
          },
          [this](const std::vector<fleet::Zone>& zones) {
            fleet_.set_zones(zones, shell_.now());
            work_soon_();
          })),
      fleet_(config.fleet, make_planner(config.planner, config.parameters)),
      leadership_(config.standby, shell.boot_id()),
      plans_(shell.outbox<topics::Plan>()),
      grants_(shell.outbox<topics::Grant>()),
      statuses_(shell.outbox<topics::TrafficStatus>()),
      work_soon_(shell.soon([this] { work(); })) {
  statuses_.release();  // until it leads
  listen();
  shell.every(kTurn, work_soon_);
  shell.every(kAssert, [this] { keep_lead(); });
  shell.every(kBeat, [this] { publish_status(); });

  shell.report([this](service::Health& health) { report(health); });
}

void GlobalPlannerService::listen() {
  // Vehicles are kept when they leave the bus, as they still stand where they were, and goals outlive the program that
  // gave them. Only tracks and plans end.
  shell_.inbox<topics::VehicleInfo>([this](const fleet::Vehicle& vehicle) { fleet_.set_vehicle(vehicle); });

  shell_.inbox<topics::VehicleState>(
      [this](const fleet::VehicleState& state) { fleet_.set_state(state, shell_.now()); });

  shell_.inbox<topics::Goal>([this](const fleet::Goal& goal) {
    fleet_.set_goal(goal);
    work_soon_();
  });

  shell_.inbox<topics::NavigationStatus>(
      [this](const fleet::NavigationStatus& navigation, const service::Sender& from) {
        fleet_.set_navigation(navigation, from.by.boot_id, shell_.now());
        hear_obeyed({navigation.traffic_epoch, navigation.traffic_boot_id});
      });

  shell_.inbox<topics::SignOff>([this](const fleet::SignOff& sign_off, const service::Sender& from) {
    if (from.by.source_id == kPerson) return fleet_.sign_off(sign_off, shell_.now());
    shell_.count("refused_sign_offs");
    shell_.warn("sign_off", "sign_off of " + sign_off.agv_id + " refused: " + from.by.source_id + " is no person");
  });

  shell_
      .inbox<topics::Track>([this](const fleet::Track& track) {
        if (track.is_static) {
          fleet_.set_static_track(track.id, {track.position_in_map, track.radius_m}, shell_.now());
        } else {
          fleet_.drop_track(track.id, shell_.now());
        }
      })
      .on_gone([this](std::uint64_t track_id, service::End) { fleet_.drop_track(track_id, shell_.now()); });

  shell_.inbox<topics::Coverage>([this](const fleet::CoverageTile& tile) { fleet_.set_coverage(tile, shell_.now()); });

  heard_plans_ = shell_.inbox<topics::Plan>([this](const fleet::Plan& plan, const service::Sender& from) {
    if (from.by.boot_id != shell_.boot_id()) {
      fleet_.hear_plan(plan.agv_id, plan.goal_id);
      shell_.count("heard_plans");
    }
    hear_planner(from.by);
  });

  heard_plans_.on_gone([this](const std::string&, service::End) {
    if (!leads()) leadership_.lose_leader();
    keep_lead();
  });

  shell_.inbox<topics::ServiceHealth>(
      [this](const fleet::ServiceHealth& health, const service::Sender& from) { hear(health, from.by); });
}

void GlobalPlannerService::hear(const fleet::ServiceHealth& health, const fleet::Origin& by) {
  const auto epoch = health.counters.find(kPlanEpoch);
  if (by.boot_id == shell_.boot_id() || epoch == health.counters.end()) return;

  leadership_.hear_of(static_cast<std::uint32_t>(std::min<std::uint64_t>(epoch->second, kMostEpochs)));
}

void GlobalPlannerService::hear_planner(const fleet::Origin& by) {
  if (by.boot_id == shell_.boot_id()) return;  // our own

  leadership_.hear(by.epoch, by.boot_id);

  keep_lead();
  if (leads()) return;

  const std::string leader = by.source_id + ", epoch " + std::to_string(by.epoch);
  if (leader != std::exchange(followed_, leader)) shell_.log().info("follows {}", leader);
}

/// Vehicles tell it when neither of the two has a plan to write.
void GlobalPlannerService::hear_obeyed(const fleet::Claim& claim) {
  const bool is_of_our_epoch = leads() && claim.epoch == leadership_.epoch() && claim.boot_id != 0;
  if (!is_of_our_epoch || !outranks(claim, {leadership_.epoch(), shell_.boot_id()})) return;

  leadership_.hear(claim.epoch, claim.boot_id);
  keep_lead();
}

void GlobalPlannerService::keep_lead() {
  const time::Stamp now = shell_.now();
  const bool was_leading = leads();
  const bool changed = leadership_.step(now, heard_plans_.matched_writers() - (was_leading ? 1 : 0));

  // The first turn as the leader claims the topic under the new epoch; each later one says that it is alive.
  if (leads()) {
    if (changed) {
      const int strength = ownership_strength(leadership_.epoch(), config_.strength);
      plans_.claim(leadership_.epoch(), strength);
      grants_.claim(leadership_.epoch(), strength);
      statuses_.claim(leadership_.epoch(), strength);
      fleet_.take_over(now, {leadership_.epoch(), shell_.boot_id()});
      shell_.log().info("leads, epoch {}", leadership_.epoch());
      work_soon_();
    }

    assert_liveliness();
  } else if (changed) {
    plans_.release();
    grants_.release();
    statuses_.release();
    shell_.log().info("stands by{}", was_leading ? ": another planner leads with a higher epoch" : "");
  }
}

void GlobalPlannerService::work() {
  if (!leads()) return;

  const time::Stamp begun = shell_.now();
  FleetOrders orders = fleet_.step(begun, [&] { return is_too_late(begun); });
  for (const std::string& event : fleet_.take_events()) shell_.log().info("{}", event);

  const double took_ms = 1e3 * time::seconds(shell_.now() - begun);
  slices_.add(took_ms);

  for (Plan& plan : orders.plans) {
    plan.planner = config_.planner;
    plan.planning_ms = took_ms;

    plans_.write(plan);
    shell_.count(plan.is_found() ? "plans_published" : "plans_without_path");
    if (plan.trigger != PlanTrigger::kNewGoal) shell_.count("plans_replaced_or_checked");
  }

  for (const fleet::Grant& grant : orders.grants) grants_.write(grant);
  if (!orders.empty()) asserted_ = shell_.now();

  if (fleet_.is_busy()) return work_soon_();
  rest_after_searches();
}

void GlobalPlannerService::publish_status() {
  if (!leads()) return;

  fleet::TrafficStatus status = fleet_.status(shell_.now());
  status.source_id = shell_.instance_id();
  status.beat = ++beat_;
  status.slice_ms_p99 = slices_.p99_ms();
  statuses_.write(status);
}

void GlobalPlannerService::assert_liveliness() {
  plans_.assert_liveliness();
  grants_.assert_liveliness();
  asserted_ = shell_.now();
}

void GlobalPlannerService::rest_after_searches() {
  if (searches_before_rest_ == fleet_.searches()) return;
  fleet_.rest();
  searches_before_rest_ = fleet_.searches();
}

bool GlobalPlannerService::is_too_late(time::Stamp begun) {
  const time::Stamp now = shell_.now();
  if (now - asserted_ >= kAssert) {  // a long search is no silence
    assert_liveliness();
  }

  return now - begun > time::from_seconds(config_.longest_search_s);
}

void GlobalPlannerService::report(service::Health& health) const {
  health.counters["leads"] = leads() ? 1 : 0;
  health.counters["epoch"] = leadership_.epoch();
  health.counters[kPlanEpoch] = leadership_.highest_epoch();
  health.counters["searches"] = fleet_.searches();
  health.waits_for = fleet_.waits_for(shell_.now());
}

}  // namespace aisle::global_planner
