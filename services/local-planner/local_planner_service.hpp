#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "common/fleet/plan_authority.hpp"
#include "common/service/shell.hpp"
#include "services/local-planner/core/keep_out.hpp"
#include "services/local-planner/core/orders.hpp"
#include "services/local-planner/core/planner.hpp"

namespace aisle::local_planner {

/// The variant of this name in core/variants. @throws config::BadInput when there is none
const Variant& chosen_variant(const std::string& name);

/// What the process takes from its config file and its command line.
struct ServiceConfig {
  Variant variant{wang()};
  Settings settings;

  template <class Reader>
  void describe(Reader& r) {
    std::string planner = variant.name;
    r.field("planner", planner);
    if (find_variant(planner) == nullptr)
      r.reject("planner", "'" + planner + "' is unknown; there are " + variant_names());
    variant = *find_variant(planner);
    settings.describe(r);
  }
};

/// Between the bus and the core, for one vehicle: a command every 20 ms, zero while there is nothing to do; its status
/// at 10 Hz and whenever phase or reason change. Commands begin when the vehicle was heard, with the epoch after the
/// one that it obeys; when the vehicle obeys a later one, this planner falls silent for good (a person decides who
/// drives on).
class LocalPlannerService {
 public:
  /// Drives the vehicle of the shell.
  LocalPlannerService(service::Shell& shell, const ServiceConfig& config);
  LocalPlannerService(const LocalPlannerService&) = delete;
  LocalPlannerService& operator=(const LocalPlannerService&) = delete;

  /// Called in each cycle right after the core with what it decided: for programs that run this service in their own
  /// process and show what is on no topic.
  void on_cycle(std::function<void(const Output&)> handler) { on_cycle_ = std::move(handler); }

  /// Called right before the core, for programs that measure what it computes.
  void before_cycle(std::function<void()> handler) { before_cycle_ = std::move(handler); }

 private:
  /// A track, and the tracker that wrote it.
  struct TrackEntry {
    SeenTrack seen;
    std::string source_id;
  };

  /// Own vehicle, or a peer's outline.
  void take(const fleet::Vehicle& vehicle);

  /// Own state, or a peer's.
  void take(const fleet::VehicleState& state, time::Stamp arrived);

  /// A plan for this vehicle, if its planner has the authority.
  void take(const fleet::Plan& plan, const fleet::Origin& by);

  /// Road for this vehicle.
  void take(const fleet::Grant& grant, const fleet::Origin& by);

  /// The leader's beat, which the status repeats.
  void take(const fleet::TrafficStatus& status, const fleet::Origin& by);

  /// Begins to command once the vehicle was heard, and ends when it obeys another source.
  void take_own(const fleet::VehicleState& state, time::Stamp arrived);

  /// Does the tracker live, does it see this vehicle's scans, and which tracks has it lost?
  void take_signed_off(const fleet::SilentVehicle& vehicle);
  void take_status(const fleet::TrackingStatus& status, const std::string& source, time::Stamp arrived);

  /// One cycle: inputs, core, command and status.
  void cycle();

  /// Does the leader of the traffic wait for what the next status says?
  bool has_news(const Output& output) const;

  void write_command(const Output& output);
  void write_status(const Output& output);

  void report(service::Health& health) const;

  /// The entry of a peer, made when it is new.
  Peer& peer(const std::string& agv_id);

  service::Shell& shell_;
  std::string agv_id_;
  service::MapClient& map_;
  std::unique_ptr<Planner> planner_;
  std::function<void(const Output&)> on_cycle_;  // may be empty
  std::function<void()> before_cycle_;           // may be empty
  KeepOut keep_out_;
  Inputs inputs_;

  fleet::PlanAuthority plan_authority_;
  Orders orders_;
  std::uint64_t heard_beat_{0};       // of the planner that is obeyed
  fleet::Claim told_leader_;          // in the newest status
  std::uint64_t told_steps_done_{0};  // likewise,
  std::uint64_t told_limit_step_{0};  // and what it answers to the grant of this number
  std::uint64_t told_grant_{0};
  std::map<std::string, Peer> peers_;
  std::map<std::uint64_t, TrackEntry> tracks_;
  service::Outbox<topics::VelocityCommand> commands_;
  service::Outbox<topics::NavigationStatus> statuses_;
  std::optional<std::uint32_t> epoch_;              // of our commands, once the vehicle was heard
  std::map<std::string, std::uint64_t> own_scans_;  // the newest in each tracker's tracks, by sequence number
  std::int64_t scan_stamp_ns_{0};
  double control_ms_{0.0};
  std::uint64_t cycles_{0};
  Phase phase_{Phase::kWaiting};
  Reason reason_{Reason::kNone};
};

}  // namespace aisle::local_planner
