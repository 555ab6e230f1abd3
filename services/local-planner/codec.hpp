#pragma once
// Samples to and from the local planner's own types. What is decoded is safe to compute with.
#include <cstdint>
#include <string>
#include <vector>

#include "common/wire/checks.hpp"
#include "idl/planning.hpp"
#include "idl/tracking.hpp"
#include "idl/vehicle.hpp"
#include "services/local-planner/core/inputs.hpp"

namespace aisle::local_planner {

wire::Decoded<Vehicle> decode(const aisle::VehicleInfo& sample);

/// What a vehicle says of itself, and whom it obeys.
struct StateReport {
  VehicleState state;
  std::uint32_t accepted_epoch{0};
};
wire::Decoded<StateReport> decode(const aisle::VehicleState& sample);

wire::Decoded<Plan> decode(const aisle::Plan& sample);
wire::Decoded<obstacle_tracker::Track> decode(const aisle::Track& sample);

/// What a peer says of its own navigation.
struct Announcement {
  Phase phase{Phase::kWaiting};
  Reason reason{Reason::kNone};
  std::vector<IntentPoint> intent;
};
wire::Decoded<Announcement> decode(const aisle::NavigationStatus& sample);

/// Key, `by` and the ids are left to the writer.
aisle::VelocityCommand encode_command(const Output& output);
aisle::NavigationStatus encode_status(const Output& output);

}  // namespace aisle::local_planner
