#include "services/global-planner/global_planner_service.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "common/config/reader.hpp"
#include "common/wire/origin.hpp"
#include "common/wire/planning.hpp"
#include "common/wire/service.hpp"
#include "common/wire/tracking.hpp"
#include "common/wire/vehicle.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

using bus::SampleInfo;
using bus::SampleKind;
using std::chrono::milliseconds;

constexpr milliseconds kTurn{20};
constexpr milliseconds kAssert{50};  // of a lease of 200 ms
constexpr std::uint32_t kMostEpochs = 2'000'000;
constexpr const char* kPlanEpoch = "plan_epoch";  // counter in service_health: of the plans that a service follows

std::unique_ptr<Planner> make_planner(const std::string& name) {
  if (const Variant* variant = find_variant(name)) return variant->make();
  std::string names;
  for (const Variant& variant : all_variants()) names += (names.empty() ? "" : ", ") + variant.name;
  throw config::BadInput("planner: '" + name + "' is unknown; there are " + names);
}

/// A later epoch is heard, whatever its strength: ownership on the wire follows authority.
int ownership_strength(std::uint32_t epoch, int strength) {
  return static_cast<int>(std::min(epoch, kMostEpochs)) * 1000 + strength;
}

}  // namespace

GlobalPlannerService::GlobalPlannerService(bus::Bus& bus, const std::string& instance_id, std::uint64_t boot_id,
                                           service::Health& health, const ServiceConfig& config)
    : bus_(bus),
      config_(config),
      boot_id_(boot_id),
      health_(health),
      stamper_(bus, instance_id, boot_id),
      map_(bus, instance_id, {{}, false, 0.0, milliseconds(300)}),
      fleet_(config.fleet, make_planner(config.planner)),
      leadership_(config.standby, boot_id),
      warnings_(std::chrono::seconds(10), [&bus] { return bus.now(); }) {
  listen();
  bus_.every(kTurn, [this] { work_soon(); });
  bus_.every(kAssert, [this] { keep_lead(); });
  bus_.every(milliseconds(250), [this] { report(); });
}

template <class T>
std::optional<T> GlobalPlannerService::accepted(const char* topic, wire::Decoded<T> decoded) {
  if (decoded) return *std::move(decoded);
  health_.count(std::string("dropped_") + topic);
  warnings_.warn(topic, std::string(topic) + ": a sample was dropped: " + decoded.reason());
  return std::nullopt;
}

void GlobalPlannerService::listen() {
  map_.on_map([this](const grid::OccupancyGrid& grid, const grid::ClearanceField&, grid::Cell low, grid::Cell high) {
    fleet_.set_map(map_.map_id(), map_.revision(), grid, low, high);
    work_soon();
  });
  bus_.on<topics::VehicleInfo>([this](const aisle::VehicleInfo& sample, const SampleInfo& info) {
    if (info.kind != SampleKind::kData) return;  // a vehicle that is gone still stands where it was
    if (const auto vehicle = accepted("vehicle_info", wire::decode(sample)))
      fleet_.set_vehicle(vehicle->id, shape_of(vehicle->footprint, vehicle->limits));
  });
  bus_.on<topics::VehicleState>([this](const aisle::VehicleState& sample, const SampleInfo& info) {
    if (info.kind != SampleKind::kData) return;
    if (const auto state = accepted("vehicle_state", wire::decode(sample)))
      fleet_.set_pose(state->agv_id, state->motion.base_in_map, bus_.now());
  });
  bus_.on<topics::Goal>([this](const aisle::Goal& sample, const SampleInfo& info) {
    if (info.kind != SampleKind::kData) return;  // goals outlive whoever gave them
    if (const auto goal = accepted("goal", wire::decode(sample))) fleet_.set_goal(*goal);
    work_soon();
  });
  bus_.on<topics::NavigationStatus>([this](const aisle::NavigationStatus& sample, const SampleInfo& info) {
    if (info.kind != SampleKind::kData) return;
    if (const auto navigation = accepted("navigation_status", wire::decode(sample)))
      fleet_.set_navigation(*navigation, bus_.now());
  });
  bus_.on<topics::Track>([this](const aisle::Track& sample, const SampleInfo& info) {
    if (info.kind != SampleKind::kData) return fleet_.drop_track(sample.track_id());
    const auto track = accepted("track", wire::decode(sample));
    if (!track) return;
    if (track->is_static) {
      fleet_.set_static_track(track->id, {track->position_in_map, track->radius_m});
    } else {
      fleet_.drop_track(track->id);
    }
  });
  bus_.on<topics::Plan>([this](const aisle::Plan& sample, const SampleInfo& info) { hear(sample, info); });
  bus_.on<topics::ServiceHealth>([this](const aisle::ServiceHealth& sample, const SampleInfo& info) {
    if (info.kind != SampleKind::kData || wire::origin_of(sample).boot_id == boot_id_) return;
    const auto health = accepted("service_health", wire::decode(sample));
    if (!health) return;
    const auto epoch = health->counters.find(kPlanEpoch);
    if (epoch != health->counters.end())
      leadership_.hear_of(static_cast<std::uint32_t>(std::min<std::uint64_t>(epoch->second, kMostEpochs)));
  });
}

void GlobalPlannerService::hear(const aisle::Plan& sample, const SampleInfo& info) {
  if (info.kind != SampleKind::kData) {
    if (leadership_.role() != fleet::Leadership::Role::kLeading) leadership_.lose_leader();
    return keep_lead();
  }
  const fleet::Origin by = wire::origin_of(sample);
  if (by.boot_id == boot_id_) return;  // our own
  const auto plan = accepted("plan", wire::decode(sample));
  if (!plan) return;
  health_.count("heard_plans");
  leadership_.hear(by.epoch, by.boot_id);
  keep_lead();
  if (leadership_.role() == fleet::Leadership::Role::kLeading) return;
  fleet_.adopt(*plan);
  const std::string leader = by.source_id + ", epoch " + std::to_string(by.epoch);
  if (leader != std::exchange(followed_, leader)) spdlog::info("follows {}", leader);
}

void GlobalPlannerService::keep_lead() {
  const time::Stamp now = bus_.now();
  const bool was_leading = leadership_.role() == fleet::Leadership::Role::kLeading;
  const bool changed = leadership_.step(now, bus_.matched_writers(topics::Plan::kName) - (was_leading ? 1 : 0));
  if (leadership_.role() == fleet::Leadership::Role::kLeading) {
    if (changed) {
      stamper_.set_epoch(leadership_.epoch());
      plans_ = bus_.writer<topics::Plan>(ownership_strength(leadership_.epoch(), config_.strength));
      fleet_.take_over();
      spdlog::info("leads, epoch {}", leadership_.epoch());
      work_soon();
    }
    plans_.assert_liveliness();
    asserted_ = now;
  } else if (changed) {
    plans_ = {};
    spdlog::info("stands by{}", was_leading ? ": another planner leads with a higher epoch" : "");
  }
}

void GlobalPlannerService::work_soon() {
  if (std::exchange(is_work_posted_, true)) return;
  bus_.post([this] { work(); });
}

void GlobalPlannerService::work() {
  is_work_posted_ = false;
  if (leadership_.role() != fleet::Leadership::Role::kLeading) return;
  const time::Stamp begun = bus_.now();
  std::optional<Plan> plan = fleet_.step(begun, [&] { return is_too_late(begun); });
  for (const std::string& event : fleet_.take_events()) spdlog::info("{}", event);
  if (!plan) return rest_after_searches();
  plan->planner = config_.planner;
  plan->planning_ms = 1e3 * time::seconds(bus_.now() - begun);
  aisle::Plan sample = wire::encode(*plan);
  sample.by(stamper_.next());
  if (!plans_.write(sample)) health_.count("plans_not_written");
  asserted_ = bus_.now();
  health_.count(plan->is_found() ? "plans_published" : "plans_without_path");
  if (plan->trigger != PlanTrigger::kNewGoal) health_.count("plans_replaced_or_checked");
  work_soon();
}

void GlobalPlannerService::rest_after_searches() {
  if (searches_before_rest_ == fleet_.searches()) return;
  fleet_.rest();
  searches_before_rest_ = fleet_.searches();
}

bool GlobalPlannerService::is_too_late(time::Stamp begun) {
  const time::Stamp now = bus_.now();
  if (now - asserted_ >= kAssert) {  // a long search is no silence
    plans_.assert_liveliness();
    asserted_ = now;
  }
  return now - begun > time::from_seconds(config_.longest_search_s);
}

void GlobalPlannerService::report() {
  health_.map_id = map_.map_id();
  health_.map_revision = map_.revision();
  health_.map_hash = map_.hash();
  health_.counters["leads"] = leadership_.role() == fleet::Leadership::Role::kLeading ? 1 : 0;
  health_.counters["epoch"] = leadership_.epoch();
  health_.counters[kPlanEpoch] = leadership_.highest_epoch();
  health_.counters["searches"] = fleet_.searches();
  health_.waits_for = fleet_.waits_for(bus_.now());
  health_.state = health_.waits_for.empty() ? fleet::ServiceState::kReady : fleet::ServiceState::kWaiting;
}

}  // namespace aisle::global_planner
