#include "services/local-planner/local_planner_service.hpp"

#include <fmt/format.h>
#include <spdlog/logger.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "common/config/reader.hpp"

namespace aisle::local_planner {
namespace {

using service::Sender;
using std::chrono::milliseconds;

constexpr milliseconds kPeriod{20};
constexpr milliseconds kSurelySilent{2000};  // a peer that was not heard for so long
constexpr int kStatusEvery = 5;              // cycles
constexpr milliseconds kTrackGrace{300};     // a new track may be heard before the status that lists it
constexpr std::uint32_t kMostStrength = 1'000'000'000;
constexpr double kLeastTolerance_m = 0.02;  // of a goal's position: no vehicle stops more exactly
constexpr double kUnknownRadiusM = 0.6;     // of a peer whose vehicle_info has not come yet

}  // namespace

const Variant& chosen_variant(const std::string& name) {
  if (const Variant* variant = find_variant(name)) return *variant;
  throw config::BadInput("planner: '" + name + "' is unknown; there are " + variant_names());
}

LocalPlannerService::LocalPlannerService(service::Shell& shell, const ServiceConfig& config)
    : shell_(shell),
      agv_id_(shell.agv_id()),
      map_(shell.map(
          {},
          [this](const grid::OccupancyGrid& grid, const grid::ClearanceField& clearance, grid::Cell, grid::Cell) {
            keep_out_.set_map(grid, clearance);
            inputs_.map_revision = map_.revision();
          },
          [this](const std::vector<fleet::Zone>& zones) {
            keep_out_.set_zones(zones);
            inputs_.zones = zones;
          })),
      planner_(make_planner(config.settings, config.variant)),
      commands_(shell.outbox<topics::VelocityCommand>()),
      statuses_(shell.outbox<topics::NavigationStatus>()) {
  // Vehicles that are gone from the bus still stand where they were, and a plan outlives its planner: only tracks end.
  shell.inbox<topics::VehicleInfo>([this](const fleet::Vehicle& vehicle) { take(vehicle); });
  shell.inbox<topics::VehicleState>(
      [this](const fleet::VehicleState& state, const Sender& from) { take(state, from.arrived); });
  shell.inbox<topics::Plan>([this](const fleet::Plan& plan, const Sender& from) { take(plan, from.by); });
  shell.inbox<topics::Grant>([this](const fleet::Grant& grant, const Sender& from) { take(grant, from.by); });
  shell.inbox<topics::TrafficStatus>(
      [this](const fleet::TrafficStatus& status, const Sender& from) { take(status, from.by); });

  shell
      .inbox<topics::Track>([this](const fleet::Track& track, const Sender& from) {
        tracks_[track.id] = {{track, from.arrived}, from.by.source_id};
      })
      .on_gone([this](std::uint64_t track_id, service::End) { tracks_.erase(track_id); });

  shell.inbox<topics::TrackingStatus>([this](const fleet::TrackingStatus& status, const Sender& from) {
    take_status(status, from.by.source_id, from.arrived);
  });

  shell.every(kPeriod, [this] { cycle(); });
  shell.report([this](service::Health& health) { report(health); });
}

Peer& LocalPlannerService::peer(const std::string& agv_id) {
  const auto [entry, is_new] = peers_.try_emplace(agv_id);

  if (is_new) {
    entry->second.id = agv_id;
    entry->second.radius_m = kUnknownRadiusM;
  }

  return entry->second;
}

void LocalPlannerService::take(const fleet::Vehicle& vehicle) {
  if (vehicle.id == agv_id_) {
    inputs_.vehicle = vehicle;
    return;
  }

  Peer& entry = peer(vehicle.id);
  entry.radius_m = vehicle.reach_m();
  entry.limits = vehicle.limits;
  entry.rectangle = vehicle.footprint.is_disc() ? std::nullopt : std::optional(vehicle.footprint);
}

void LocalPlannerService::take(const fleet::VehicleState& state, time::Stamp arrived) {
  if (state.agv_id == agv_id_) return take_own(state, arrived);

  Peer& entry = peer(state.agv_id);
  entry.state = state.motion;
  entry.state_arrived = arrived;
}

void LocalPlannerService::take_own(const fleet::VehicleState& state, time::Stamp arrived) {
  inputs_.state.set(state.motion, arrived);
  inputs_.is_held_by_person = state.hold == fleet::Hold::kPerson;

  if (!epoch_) {
    epoch_ = state.accepted_epoch + 1;

    // The planner that is heard on the wire is the one that is obeyed: a later epoch owns the topic.
    commands_.claim(*epoch_, static_cast<int>(std::min(*epoch_, kMostStrength)));
    shell_.log().info("drives {} with epoch {}", agv_id_, *epoch_);
  }

  if (state.accepted_epoch > *epoch_ && !inputs_.authority_lost) {
    inputs_.authority_lost = true;
    std::string& error = shell_.health().last_error;
    error = fmt::format("{} obeys epoch {}, ours is {}", agv_id_, state.accepted_epoch, *epoch_);
    shell_.log().warn("{}: another local planner drives it; this one stays silent until it is restarted", error);
  }
}

void LocalPlannerService::take(const fleet::Plan& plan, const fleet::Origin& by) {
  if (plan.agv_id != agv_id_) return plan_authority_.hear(by.epoch);

  const fleet::PlanVerdict verdict = plan_authority_.judge(by.epoch, by.boot_id, by.sequence_number);
  if (verdict == fleet::PlanVerdict::kAccepted) {
    fleet::Plan taken = plan;
    taken.position_tolerance_m = std::max(kLeastTolerance_m, plan.position_tolerance_m);
    if (!orders_.take(taken, {by.epoch, by.boot_id})) shell_.count("refused_plan_outranked");
    return;
  }

  shell_.count(std::string("refused_plan_") + name(verdict));
  shell_.warn(std::string("plan ") + name(verdict),
              fmt::format("plan refused: {} (plan {} of {}, epoch {}; newest epoch heard {})", name(verdict), plan.id,
                          by.source_id, by.epoch, plan_authority_.epoch()));
}

void LocalPlannerService::take(const fleet::Grant& grant, const fleet::Origin& by) {
  plan_authority_.hear(by.epoch);
  if (grant.agv_id != agv_id_) return;
  if (!orders_.take(grant, {by.epoch, by.boot_id})) shell_.count("refused_grant_old");
}

void LocalPlannerService::take(const fleet::TrafficStatus& status, const fleet::Origin& by) {
  const fleet::Claim claim{by.epoch, by.boot_id};
  const fleet::Claim before = orders_.obeyed();
  orders_.hear(claim);
  plan_authority_.hear(by.epoch);
  if (claim != orders_.obeyed()) return;

  heard_beat_ = claim == before ? std::max(heard_beat_, status.beat) : status.beat;
  for (const fleet::SilentVehicle& vehicle : status.signed_off) take_signed_off(vehicle);
}

/// A vehicle that braked after its last word stands where a person saw it. At the origin: nobody knows its place.
void LocalPlannerService::take_signed_off(const fleet::SilentVehicle& vehicle) {
  const auto known = peers_.find(vehicle.agv_id);
  if (known == peers_.end() || vehicle.place_in_map == geometry::Point2{}) return;

  Peer& peer = known->second;
  if (shell_.now() - peer.state_arrived < kSurelySilent) return;

  peer.state.base_in_map = {vehicle.place_in_map.x, vehicle.place_in_map.y, peer.state.base_in_map.yaw};
  peer.state.twist = {};
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
  inputs_.plan = orders_.plan();
  inputs_.grant = orders_.grant();
  inputs_.tracks.clear();
  for (const auto& [id, entry] : tracks_) inputs_.tracks.push_back(entry.seen);

  inputs_.peers.clear();

  for (const auto& [id, peer] : peers_)
    if (peer.state_arrived != time::Stamp{}) inputs_.peers.push_back(peer);

  const std::optional<geometry::Pose2> base =
      inputs_.state.seen() ? std::optional(inputs_.state.any()->base_in_map) : std::nullopt;
  const double reach_m = inputs_.vehicle ? geometry::reach_m(inputs_.vehicle->footprint) : 0.0;
  inputs_.clearance = keep_out_.clearance(inputs_.vehicle ? base : std::nullopt, reach_m);

  if (before_cycle_) before_cycle_();
  const time::Stamp begun = shell_.now();
  const Output output = planner_->step(inputs_, begun);
  control_ms_ = 1e3 * time::seconds(shell_.now() - begun);
  if (on_cycle_) on_cycle_(output);

  const bool changed = output.phase != phase_ || output.reason != reason_;
  const bool silent = inputs_.authority_lost;
  if (!silent) write_command(output);
  if (changed || (!silent && (cycles_ % kStatusEvery == 0 || has_news(output)))) write_status(output);

  for (const Event& event : output.events) shell_.log().info("{}", event.text);
  if (changed)
    shell_.log().info("{}: {}{}{}", name(output.phase), name(output.reason), output.detail.empty() ? "" : ": ",
                      output.detail);

  phase_ = output.phase;
  reason_ = output.reason;
  ++cycles_;

  if (changed) shell_.report_now();
}

bool LocalPlannerService::has_news(const Output& output) const {
  return orders_.obeyed() != told_leader_ || output.road.step_done != told_steps_done_ ||
         output.road.limit_step != told_limit_step_ || output.road.grant_number != told_grant_;
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

  commands_.write(command);
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

  status.progress_m = output.road.progress_m;
  status.step_done = told_steps_done_ = output.road.step_done;
  status.limit_step = told_limit_step_ = output.road.limit_step;
  status.limit_m = output.road.limit_m;
  status.grant_number = told_grant_ = output.road.grant_number;
  told_leader_ = orders_.obeyed();
  status.traffic_epoch = told_leader_.epoch;
  status.traffic_boot_id = told_leader_.boot_id;
  status.grant_boot_id = orders_.granted_by().boot_id;
  status.heard_beat = heard_beat_;
  status.stray_m = output.road.stray_m;
  status.wants_room = output.road.wants_room;
  status.held = output.road.held;

  statuses_.write(status);
}

void LocalPlannerService::report(service::Health& health) const {
  health.counters["cycles"] = cycles_;
  health.counters["epoch"] = epoch_.value_or(0);
  health.counters["plan_epoch"] = plan_authority_.epoch();
  if (cycles_ == 0) return health.wait_for("its first cycle");

  switch (reason_) {
    case Reason::kNoState:
      health.wait_for((inputs_.vehicle ? "vehicle_state of " : "vehicle_info of ") + agv_id_);
      break;
    case Reason::kNoMap:
      health.wait_for("map_info and map_tile");
      break;
    case Reason::kNoTracker:
      health.wait_for("tracking_status with scans of " + agv_id_);
      break;
    default:
      health.is_degraded = phase_ == Phase::kHeld && reason_ != Reason::kCancelled;
  }
}

}  // namespace aisle::local_planner
