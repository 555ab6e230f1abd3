#include "tools/referee/core/authority_watch.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace aisle::referee {

using Kind = AuthorityViolation::Kind;

const char* name_of(Kind kind) {
  switch (kind) {
    case Kind::kForeignVehicle:
      return "foreign_vehicle";
    case Kind::kEpochWentBack:
      return "epoch_went_back";
    case Kind::kSequenceWentBack:
      return "sequence_went_back";
    case Kind::kBeyondGrant:
      return "beyond_grant";
    case Kind::kZoneBreached:
      return "zone_breached";
    case Kind::kFloorHeldTwice:
      return "floor_held_twice";
    case Kind::kStalePlan:
      break;
  }

  return "stale_plan";
}

void AuthorityWatch::plan_arrived(const std::string& agv_id, std::uint64_t plan_id, bool drivable, double t_s) {
  Followed& vehicle = vehicles_[agv_id];
  if (!vehicle.plan_seen || vehicle.plan_id != plan_id || vehicle.plan_drivable != drivable) vehicle.plan_since_s = t_s;
  vehicle.plan_seen = true;
  vehicle.plan_id = plan_id;
  vehicle.plan_drivable = drivable;
}

void AuthorityWatch::plan_named(const std::string& agv_id, std::uint64_t plan_id, double t_s) {
  Followed& vehicle = vehicles_[agv_id];
  if (vehicle.named_plan_id != plan_id) vehicle.named_since_s = t_s;
  vehicle.named_plan_id = plan_id;
}

/// Another boot id: the vehicle restarted, and its history with it.
void AuthorityWatch::vehicle_reported(const VehicleReport& report) {
  Followed& vehicle = vehicles_[report.agv_id];
  if (!vehicle.reported || vehicle.boot_id != report.boot_id) {
    vehicle.reported = true;
    vehicle.boot_id = report.boot_id;

    vehicle.highest_epoch = 0;
    vehicle.source.clear();
    vehicle.sequence = 0;
    vehicle.without_plan_since_s = -1.0;
    vehicle.going_on.clear();
  }

  if (report.command_agv_id.empty()) return;

  judge(vehicle, report, Kind::kForeignVehicle, report.command_agv_id != report.agv_id,
        fmt::format("obeys a command for {}", report.command_agv_id));
  check_order(vehicle, report);
  check_plan(vehicle, report);
}

/// Within one sender, start and epoch, numbers must not fall; a new sender begins anew.
void AuthorityWatch::check_order(Followed& vehicle, const VehicleReport& report) {
  judge(vehicle, report, Kind::kEpochWentBack, report.command_epoch < vehicle.highest_epoch,
        fmt::format("obeys epoch {} of {} after epoch {}", report.command_epoch, report.command_source,
                    vehicle.highest_epoch));

  vehicle.highest_epoch = std::max(vehicle.highest_epoch, report.command_epoch);

  const bool same_sender = vehicle.source == report.command_source && vehicle.source_boot == report.command_boot &&
                           vehicle.epoch == report.command_epoch;
  judge(vehicle, report, Kind::kSequenceWentBack, same_sender && report.command_sequence < vehicle.sequence,
        fmt::format("obeys command {} of {} after command {}", report.command_sequence, report.command_source,
                    vehicle.sequence));

  vehicle.sequence = same_sender ? std::max(vehicle.sequence, report.command_sequence) : report.command_sequence;
  vehicle.source = report.command_source;
  vehicle.source_boot = report.command_boot;
  vehicle.epoch = report.command_epoch;
}

/// A vehicle may go on by its old plan for a moment, and longer where it has to brake.
void AuthorityWatch::check_plan(Followed& vehicle, const VehicleReport& report) {
  const bool moves = report.speed_mps > kMoving_mps && !report.holds;
  const bool planless = report.command_plan_id == 0;

  if (!moves || !planless) vehicle.without_plan_since_s = -1.0;
  if (moves && planless && vehicle.without_plan_since_s < 0.0) vehicle.without_plan_since_s = report.t_s;

  bool violated = false;
  if (moves && planless) {
    violated = report.t_s - vehicle.without_plan_since_s > kBrakingGrace_s;
  } else if (moves && vehicle.plan_seen && report.command_plan_id != vehicle.plan_id &&
             vehicle.named_plan_id == vehicle.plan_id) {
    const double heard_s = std::max(vehicle.plan_since_s, vehicle.named_since_s);
    violated = report.t_s - heard_s > (vehicle.plan_drivable ? kGrace_s : kBrakingGrace_s);
  }

  judge(vehicle, report, Kind::kStalePlan, violated,
        fmt::format("drives {:.2f} m/s by plan {} while {} is the newest", report.speed_mps, report.command_plan_id,
                    vehicle.plan_id));
}

void AuthorityWatch::judge(Followed& vehicle, const VehicleReport& report, Kind kind, bool violated,
                           const std::string& text) {
  bool& going_on = vehicle.going_on[kind];
  if (violated && !going_on) violations_.push_back({kind, report.agv_id, report.t_s, text});
  going_on = violated;
}

}  // namespace aisle::referee
