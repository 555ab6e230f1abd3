#include "services/local-planner/local_planner_service.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <utility>

#include "common/config/reader.hpp"
#include "common/process/clock.hpp"
#include "services/local-planner/codec.hpp"

namespace aisle::local_planner {
namespace {

using bus::SampleInfo;
using bus::SampleKind;
using process::monotonic_now;
using std::chrono::milliseconds;

constexpr milliseconds kPeriod{20};
constexpr int kStatusEvery = 5;           // cycles
constexpr milliseconds kTrackGrace{300};  // a new track may be heard before the status that lists it
constexpr std::uint32_t kMostStrength = 1'000'000'000;
constexpr double kUnknownRadiusM = 0.6;  // of a peer whose vehicle_info has not come yet

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
      warnings_(std::chrono::seconds(10)) {
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
    const auto vehicle = accepted("vehicle_info", decode(sample));
    if (!vehicle) return;
    if (vehicle->id == agv_id_) {
      inputs_.vehicle = *vehicle;
      return;
    }
    Peer& entry = peer(vehicle->id);
    entry.radius_m = vehicle->radius_m;
    entry.limits = vehicle->limits;
    entry.rectangle = vehicle->rectangle;
  });
  bus_.on<topics::VehicleState>([this, peer](const aisle::VehicleState& sample, const SampleInfo& info) {
    if (info.kind != SampleKind::kData) return;
    if (sample.agv_id().to_string() == agv_id_) return take_own_state(sample, info.arrived.time_since_epoch());
    if (const auto report = accepted("vehicle_state", decode(sample))) {
      Peer& entry = peer(sample.agv_id().to_string());
      entry.state = report->state;
      entry.state_arrived = info.arrived.time_since_epoch();
    }
  });
  bus_.on<topics::NavigationStatus>([this, peer](const aisle::NavigationStatus& sample, const SampleInfo& info) {
    if (info.kind != SampleKind::kData || sample.agv_id().to_string() == agv_id_) return;
    if (auto announcement = accepted("navigation_status", decode(sample))) {
      Peer& entry = peer(sample.agv_id().to_string());
      entry.phase = announcement->phase;
      entry.reason = announcement->reason;
      entry.intent = std::move(announcement->intent);
      entry.intent_arrived = info.arrived.time_since_epoch();
    }
  });
}

void LocalPlannerService::take_own_state(const aisle::VehicleState& sample, time::Stamp arrived) {
  const auto report = accepted("vehicle_state", decode(sample));
  if (!report) return;
  inputs_.state.set(report->state, arrived);
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
  auto plan = accepted("plan", decode(sample));
  if (!plan) return;
  const PlanVerdict verdict =
      plan_authority_.judge(sample.by().epoch(), sample.by().boot_id(), sample.by().sequence_number());
  if (verdict == PlanVerdict::kAccepted) {
    inputs_.plan = *std::move(plan);
    return;
  }
  health_.count(std::string("refused_plan_") + name(verdict));
  warnings_.warn(
      std::string("plan ") + name(verdict),
      fmt::format("plan refused: {} (plan {} of {}, epoch {}; newest epoch heard {})", name(verdict), sample.plan_id(),
                  sample.by().source_id().to_string(), sample.by().epoch(), plan_authority_.epoch()));
}

void LocalPlannerService::listen_to_tracks() {
  bus_.on<topics::Track>([this](const aisle::Track& sample, const SampleInfo& info) {
    if (info.kind != SampleKind::kData) {
      tracks_.erase(sample.track_id());
      return;
    }
    if (const auto track = accepted("track", decode(sample)))
      tracks_[track->id] = {{*track, info.arrived.time_since_epoch()}, sample.by().source_id().to_string()};
  });
  bus_.on<topics::TrackingStatus>([this](const aisle::TrackingStatus& sample, const SampleInfo& info) {
    if (info.kind == SampleKind::kData) take_status(sample, info.arrived.time_since_epoch());
  });
}

void LocalPlannerService::take_status(const aisle::TrackingStatus& sample, time::Stamp arrived) {
  inputs_.tracker_heard = arrived;
  const auto& live = sample.live_track_ids();
  const std::string source = sample.by().source_id().to_string();
  for (const aisle::ScanUse& use : sample.newest_scans()) {
    if (use.agv_id().to_string() != agv_id_) continue;
    scan_stamp_ns_ = std::max<std::int64_t>(scan_stamp_ns_, use.scan_stamp_ns());
    // Another number is another scan, also the 1 of a vehicle that was restarted. The first one heard may be of long
    // ago.
    const auto [known, is_first] = own_scans_.try_emplace(source, use.scan_sequence());
    if (!is_first && std::exchange(known->second, use.scan_sequence()) != use.scan_sequence())
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

  const time::Stamp begun = monotonic_now();
  const Output output = planner_.step(inputs_, begun);
  control_ms_ = 1e3 * time::seconds(monotonic_now() - begun);

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
  aisle::VelocityCommand sample = encode_command(output);
  sample.agv_id(agv_id_);
  sample.by(command_stamper_.next());
  if (inputs_.plan) {
    sample.goal_id(inputs_.plan->goal_id);
    sample.plan_id(inputs_.plan->id);
    sample.map_revision(inputs_.plan->map_revision);
  }
  sample.scan_stamp_ns(scan_stamp_ns_);
  sample.control_ms(control_ms_);
  commands_.write(sample);
}

void LocalPlannerService::write_status(const Output& output) {
  aisle::NavigationStatus sample = encode_status(output);
  sample.agv_id(agv_id_);
  sample.by(status_stamper_.next());
  if (inputs_.plan) {
    sample.goal_id(inputs_.plan->goal_id);
    sample.plan_id(inputs_.plan->id);
  }
  sample.map_revision(inputs_.map_revision);
  sample.control_ms(control_ms_);
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
