#pragma once
// Samples to and from the fleet planner's own types. What is decoded is safe to compute with.
#include <optional>
#include <string>

#include "common/wire/checks.hpp"
#include "idl/planning.hpp"
#include "idl/tracking.hpp"
#include "idl/vehicle.hpp"
#include "services/global-planner/core/fleet_types.hpp"
#include "services/global-planner/core/stamped_discs.hpp"

namespace aisle::global_planner {

wire::Decoded<VehicleShape> decode(const aisle::VehicleInfo& sample);
wire::Decoded<geometry::Pose2> decode(const aisle::VehicleState& sample);
wire::Decoded<Goal> decode(const aisle::Goal& sample);
wire::Decoded<Navigation> decode(const aisle::NavigationStatus& sample);
/// Of a static track; a moving one has none.
wire::Decoded<std::optional<Disc>> decode(const aisle::Track& sample);
wire::Decoded<FleetPlan> decode(const aisle::Plan& sample);

/// `by` is left to the writer. @pre at most 4096 waypoints
aisle::Plan encode(const FleetPlan& plan, const std::string& planner, double planning_ms);

}  // namespace aisle::global_planner
