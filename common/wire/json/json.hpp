#pragma once
// Samples as they came, for people and scripts: one to_json for each type of idl/, with the field names of the IDL;
// enumerators in lower case without their prefix, hashes as hexadecimal text (a JSON number would lose digits). Numbers
// that are not finite become null when written.
#include <nlohmann/json.hpp>
#include <string>

#include "common/wire/codecs.hpp"
#include "common/wire/geometry.hpp"

namespace aisle::wire {

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

inline Json to_json(const geometry::Pose2& pose_in_map) { return to_json(encode(pose_in_map)); }

/// A value as `aisle topic echo` shows it: as JSON of the sample that it is written as, with its origin.
template <class Value>
Json json_of(const Value& value, const fleet::Origin& by) {
  auto sample = encode(value);
  stamp(sample, by);
  return to_json(sample);
}

/// One line. What came over the wire may not be UTF-8; such bytes are replaced.
std::string write_json(const Json& json);

}  // namespace aisle::wire
