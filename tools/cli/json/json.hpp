#pragma once
// One to_json for each type of idl/, with the field names of the IDL; enumerators in lower case without their prefix,
// hashes as hexadecimal text (a JSON number would lose digits). Numbers that are not finite become null when written.
#include <nlohmann/json.hpp>
#include <string>

#include "idl/geometry.hpp"
#include "idl/map.hpp"
#include "idl/planning.hpp"
#include "idl/service.hpp"
#include "idl/tracking.hpp"
#include "idl/vehicle.hpp"

namespace aisle::cli {

/// Keeps the order of the fields.
using Json = nlohmann::ordered_json;

Json to_json(const aisle::Point& sample);
Json to_json(const aisle::Pose& sample);
Json to_json(const aisle::Twist& sample);
Json to_json(const aisle::Origin& sample);
Json to_json(const aisle::MapInfo& sample);
Json to_json(const aisle::MapTile& sample);
Json to_json(const aisle::MapRequest& sample);
Json to_json(const aisle::MapEdit& sample);
Json to_json(const aisle::MapEditResult& sample);
Json to_json(const aisle::Goal& sample);
Json to_json(const aisle::Plan& sample);
Json to_json(const aisle::NavigationStatus& sample);
Json to_json(const aisle::ServiceHealth& sample);
Json to_json(const aisle::Track& sample);
Json to_json(const aisle::TrackingStatus& sample);
Json to_json(const aisle::Coverage& sample);
Json to_json(const aisle::VehicleInfo& sample);
Json to_json(const aisle::VehicleState& sample);
Json to_json(const aisle::Scan& sample);
Json to_json(const aisle::VelocityCommand& sample);
Json to_json(const aisle::WorldObstacle& sample);

std::string name_of(aisle::EditOutcome outcome);
std::string name_of(aisle::PlanOutcome outcome);
std::string name_of(aisle::NavigationPhase phase);
std::string name_of(aisle::NavigationReason reason);
std::string name_of(aisle::HoldReason reason);
std::string name_of(aisle::ServiceState state);

/// One line. What came over the wire may not be UTF-8; such bytes are replaced.
std::string write_json(const Json& json);

}  // namespace aisle::cli
