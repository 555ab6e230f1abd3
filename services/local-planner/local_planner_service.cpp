#include "services/local-planner/local_planner_service.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "common/config/reader.hpp"
#include "common/wire/origin.hpp"
#include "common/wire/planning.hpp"
#include "common/wire/tracking.hpp"
#include "common/wire/vehicle.hpp"

namespace aisle::local_planner {
namespace {

using bus::SampleInfo;
using bus::SampleKind;
using std::chrono::milliseconds;

constexpr milliseconds kPeriod{20};
constexpr int kStatusEvery = 5;           // cycles
constexpr milliseconds kTrackGrace{300};  // a new track may be heard before the status that lists it
constexpr std::uint32_t kMostStrength = 1'000'000'000;
constexpr double kLeastTolerance_m = 0.02;  // of a goal's position: no vehicle stops more exactly
constexpr double kUnknownRadiusM = 0.6;     // of a peer whose vehicle_info has not come yet

const Variant& variant_of(const std::string& name) {
  if (const Variant* variant = find_variant(name)) return *variant;
  throw config::BadInput("planner: '" + name + "' is unknown; there are " + variant_names());
}

}  // namespace

LocalPlannerService::LocalPlannerService(bus::Bus& bus, const std::string& agv_id,
                                         const service::OriginStamper& stamper, service::Health& health,
                                         const std::string& instance_id, const ServiceConfig& config)
    : bus_(bus),
      agv_id_(agv_id),
      command_stamper_(stamper),
      status_stamper_(stamper),
      health_(health),
      map_(bus, instance_id, {}),
      planner_(config.settings, variant_of(config.planner)),
      statuses_(bus.writer<topics::NavigationStatus>()),
      warnings_(std::chrono::seconds(10), [&bus] { return bus.now(); }) {
  map_.on_map([this](const grid::OccupancyGrid&, const grid::ClearanceField& clearance, grid::Cell, grid::Cell) {
    inputs_.clearance = &clearance;
    inputs_.map_revision = map_.revision();
  });
  listen_to_vehicles();
  listen_to_tracks();
  bus_.on<topics::Plan>([this](const aisle::Plan& sample, const SampleInfo& info) {
    if (info.kind == SampleKind::kData) take(sample);  // a plan outlives its planner
  });
  bus_.every(kPeriod, [this] { cycle(); });
}

template <class T>
std::optional<T> LocalPlannerService::accepted(const char* topic, wire::Decoded<T> decoded) {
  if (decoded) return *std::move(decoded);
  health_.count(std::string("dropped_") + topic);
  warnings_.warn(topic, std::string(topic) + ": a sample was dropped: " + decoded.reason());
  return std::nullopt;
}

void LocalPlannerService::listen_to_vehicles() {
  const auto peer = [this](const std::string& id) -> Peer& {
    Peer& entry = peers_[id];
    if (entry.id.empty()) entry.id = id, entry.radius_m = kUnknownRadiusM;
    return entry;
  };
  bus_.on<topics::VehicleInfo>([this, peer](const aisle::VehicleInfo& sample, const SampleInfo& info) {
    if (info.kind != SampleKind::kData) return;  // a vehicle that is gone still stands where it was
    const auto vehicle = accepted("vehicle_info", wire::decode(sample));
    if (!vehicle) return;
    if (vehicle->id == agv_id_) {
      inputs_.vehicle = *vehicle;
      return;
    }
    Peer& entry = peer(vehicle->id);
    entry.radius_m = vehicle->reach_m();
    entry.limits = vehicle->limits;
    entry.rectangle = vehicle->footprint.is_disc() ? std::nullopt : std::optional(vehicle->footprint);
  });
  bus_.on<topics::VehicleState>([this, peer](const aisle::VehicleState& sample, const SampleInfo& info) {
    if (info.kind != SampleKind::kData) return;
    if (sample.agv_id().to_string() == agv_id_) return take_own_state(sample, info.arrived);
    if (const auto report = accepted("vehicle_state", wire::decode(sample))) {
      Peer& entry = peer(report->agv_id);
      entry.state = report->motion;
      entry.state_arrived = info.arrived;
    }
  });
  bus_.on<topics::NavigationStatus>([this, peer](const aisle::NavigationStatus& sample, const SampleInfo& info) {
    if (info.kind != SampleKind::kData || sample.agv_id().to_string() == agv_id_) return;
    if (auto status = accepted("navigation_status", wire::decode(sample))) {
      Peer& entry = peer(status->agv_id);
      entry.phase = status->phase;
      entry.reason = status->reason;
      entry.intent = std::move(status->intent);
      entry.intent_arrived = info.arrived;
    }
  });
}

void LocalPlannerService::take_own_state(const aisle::VehicleState& sample, time::Stamp arrived) {
  const auto report = accepted("vehicle_state", wire::decode(sample));
  if (!report) return;
  inputs_.state.set(report->motion, arrived);
  if (!epoch_) {
    epoch_ = report->accepted_epoch + 1;
    command_stamper_.set_epoch(*epoch_);
    // Who is heard on the wire follows who is obeyed: a later epoch owns the topic.
    commands_ = bus_.writer<topics::VelocityCommand>(static_cast<int>(std::min(*epoch_, kMostStrength)));
    spdlog::info("drives {} with epoch {}", agv_id_, *epoch_);
  }
  if (report->accepted_epoch > *epoch_ && !inputs_.authority_lost) {
    inputs_.authority_lost = true;
    health_.last_error =
        agv_id_ + " obeys epoch " + std::to_string(report->accepted_epoch) + ", ours is " + std::to_string(*epoch_);
    spdlog::warn("{}: another local planner drives it; this one stays silent until it is restarted",
                 health_.last_error);
  }
}

void LocalPlannerService::take(const aisle::Plan& sample) {
  if (sample.agv_id().to_string() != agv_id_) return plan_authority_.hear(sample.by().epoch());
  auto plan = accepted("plan", wire::decode(sample));
  if (!plan) return;
  const fleet::Origin by = wire::origin_of(sample);
  const fleet::PlanVerdict verdict = plan_authority_.judge(by.epoch, by.boot_id, by.sequence_number);
  if (verdict == fleet::PlanVerdict::kAccepted) {
    plan->position_tolerance_m = std::max(kLeastTolerance_m, plan->position_tolerance_m);
    inputs_.plan = *std::move(plan);
    return;
  }
  health_.count(std::string("refused_plan_") + name(verdict));
  warnings_.warn(std::string("plan ") + name(verdict),
                 fmt::format("plan refused: {} (plan {} of {}, epoch {}; newest epoch heard {})", name(verdict),
                             plan->id, by.source_id, by.epoch, plan_authority_.epoch()));
}

void LocalPlannerService::listen_to_tracks() {
  bus_.on<topics::Track>([this](const aisle::Track& sample, const SampleInfo& info) {
    if (info.kind != SampleKind::kData) {
      tracks_.erase(sample.track_id());
      return;
    }
    if (const auto track = accepted("track", wire::decode(sample)))
      tracks_[track->id] = {{*track, info.arrived}, sample.by().source_id().to_string()};
  });
  bus_.on<topics::TrackingStatus>([this](const aisle::TrackingStatus& sample, const SampleInfo& info) {
    if (info.kind != SampleKind::kData) return;
    if (const auto status = accepted("tracking_status", wire::decode(sample)))
      take_status(*status, wire::origin_of(sample).source_id, info.arrived);
  });
}

void LocalPlannerService::take_status(const fleet::TrackingStatus& status, const std::string& source,
                                      time::Stamp arrived) {
  inputs_.tracker_heard = arrived;
  const std::vector<std::uint64_t>& live = status.live_track_ids;
  for (const fleet::ScanUse& use : status.newest_scans) {
    if (use.agv_id != agv_id_) continue;
    scan_stamp_ns_ = std::max(scan_stamp_ns_, use.scan_stamp_ns);
    // Another number is another scan, also the 1 of a vehicle that was restarted. The first one heard may be of long
    // ago.
    const auto [known, is_first] = own_scans_.try_emplace(source, use.scan_sequence);
    if (!is_first && std::exchange(known->second, use.scan_sequence) != use.scan_sequence)
      inputs_.tracker_alive = arrived;
  }
  for (auto entry = tracks_.begin(); entry != tracks_.end();) {
    const bool listed = std::find(live.begin(), live.end(), entry->first) != live.end();
    const bool lost =
        !listed && entry->second.source_id == source && arrived - entry->second.seen.arrived > kTrackGrace;
    entry = lost ? tracks_.erase(entry) : std::next(entry);
  }
}

void LocalPlannerService::cycle() {
  inputs_.tracks.clear();
  for (const auto& [id, entry] : tracks_) inputs_.tracks.push_back(entry.seen);
  inputs_.peers.clear();
  for (const auto& [id, peer] : peers_)
    if (peer.state_arrived != time::Stamp{}) inputs_.peers.push_back(peer);

  const time::Stamp begun = bus_.now();
  const Output output = planner_.step(inputs_, begun);
  control_ms_ = 1e3 * time::seconds(bus_.now() - begun);

  const bool changed = output.phase != phase_ || output.reason != reason_;
  const bool silent = inputs_.authority_lost;
  if (!silent) write_command(output);
  if (changed || (!silent && cycles_ % kStatusEvery == 0)) write_status(output);
  for (const Event& event : output.events) spdlog::info("{}", event.text);
  if (changed)
    spdlog::info("{}: {}{}{}", name(output.phase), name(output.reason), output.detail.empty() ? "" : ": ",
                 output.detail);
  phase_ = output.phase;
  reason_ = output.reason;
  if (cycles_++ % 50 == 0 || changed) report(output);
}

void LocalPlannerService::write_command(const Output& output) {
  fleet::VelocityCommand command;
  command.agv_id = agv_id_;
  if (inputs_.plan) {
    command.goal_id = inputs_.plan->goal_id;
    command.plan_id = inputs_.plan->id;
    command.map_revision = inputs_.plan->map_revision;
  }
  command.twist = output.twist;
  command.scan_stamp_ns = scan_stamp_ns_;
  command.control_ms = control_ms_;
  aisle::VelocityCommand sample = wire::encode(command);
  sample.by(command_stamper_.next());
  commands_.write(sample);
}

void LocalPlannerService::write_status(const Output& output) {
  fleet::NavigationStatus status;
  status.agv_id = agv_id_;
  if (inputs_.plan) {
    status.goal_id = inputs_.plan->goal_id;
    status.plan_id = inputs_.plan->id;
  }
  status.map_revision = inputs_.map_revision;
  status.phase = output.phase;
  status.reason = output.reason;
  status.detail = output.detail;
  status.distance_left_m = output.distance_left_m;
  status.time_left_s = output.time_left_s;
  status.blocked_at_in_map = output.blocked_at_in_map;
  status.blocked_radius_m = output.blocked_radius_m;
  status.control_ms = control_ms_;
  status.intent = output.intent;
  aisle::NavigationStatus sample = wire::encode(status);
  sample.by(status_stamper_.next());
  statuses_.write(sample);
}

void LocalPlannerService::report(const Output& output) {
  health_.map_id = map_.map_id();
  health_.map_revision = map_.revision();
  health_.map_hash = map_.hash();
  health_.counters["cycles"] = cycles_;
  health_.counters["epoch"] = epoch_.value_or(0);
  health_.counters["plan_epoch"] = plan_authority_.epoch();
  switch (output.reason) {
    case Reason::kNoState:
      health_.waits_for = inputs_.vehicle ? "vehicle_state of " + agv_id_ : "vehicle_info of " + agv_id_;
      break;
    case Reason::kNoMap:
      health_.waits_for = "map_info and map_tile";
      break;
    case Reason::kNoTracker:
      health_.waits_for = "tracking_status with scans of " + agv_id_;
      break;
    default:
      health_.waits_for.clear();
  }
  const bool degraded = output.phase == Phase::kHeld && output.reason != Reason::kCancelled;
  health_.state = !health_.waits_for.empty() ? fleet::ServiceState::kWaiting
                  : degraded                 ? fleet::ServiceState::kDegraded
                                             : fleet::ServiceState::kReady;
}

}  // namespace aisle::local_planner
