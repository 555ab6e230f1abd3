#include "common/bus/dds/type_table.hpp"

#include <cassert>
#include <cstdlib>
#include <tuple>
#include <type_traits>

#include "common/bus/topics.hpp"
#include "idl/map_support.hpp"
#include "idl/planning_support.hpp"
#include "idl/service_support.hpp"
#include "idl/tracking_support.hpp"
#include "idl/vehicle_support.hpp"

namespace aisle::bus {
namespace {

/// A key field as bytes that tell where it ends.
template <class Field>
void append_field(const Field& field, std::string& bytes) {
  if constexpr (std::is_arithmetic_v<Field>) {
    bytes.append(reinterpret_cast<const char*>(&field), sizeof field);
  } else {
    bytes.append(field.c_str()).push_back('\0');
  }
}

template <class Topic, class Generated>
TopicType row() {
  static_assert(std::is_same_v<typename Topic::Sample, typename Generated::type>);
  using Sample = typename Topic::Sample;
  return {Topic::kName, Topic::kQos, [] { return fast::dds::TypeSupport(new fast::Guarded<Generated>); },
          [](void* to, void* from) { Topic::key(*static_cast<Sample*>(to)) = Topic::key(*static_cast<Sample*>(from)); },
          [](void* sample, std::string& bytes) {
            std::apply([&](const auto&... fields) { (append_field(fields, bytes), ...); },
                       Topic::key(*static_cast<Sample*>(sample)));
          }};
}

template <class... Topics, class... Rows>
auto complete(topics::List<Topics...>, Rows... rows) {
  static_assert(sizeof...(Topics) == sizeof...(Rows), "each topic of topics.hpp needs its row here");
  return std::vector<TopicType>{rows...};
}

const std::vector<TopicType>& table() {
  static const auto rows = complete(
      topics::All{}, row<topics::MapInfo, MapInfoPubSubType>(), row<topics::MapTile, MapTilePubSubType>(),
      row<topics::MapRequest, MapRequestPubSubType>(), row<topics::MapEdit, MapEditPubSubType>(),
      row<topics::MapEditResult, MapEditResultPubSubType>(), row<topics::VehicleInfo, VehicleInfoPubSubType>(),
      row<topics::VehicleState, VehicleStatePubSubType>(), row<topics::Scan, ScanPubSubType>(),
      row<topics::Goal, GoalPubSubType>(), row<topics::Plan, PlanPubSubType>(), row<topics::Track, TrackPubSubType>(),
      row<topics::TrackingStatus, TrackingStatusPubSubType>(), row<topics::Coverage, CoveragePubSubType>(),
      row<topics::VelocityCommand, VelocityCommandPubSubType>(),
      row<topics::NavigationStatus, NavigationStatusPubSubType>(),
      row<topics::WorldObstacle, WorldObstaclePubSubType>(), row<topics::ServiceHealth, ServiceHealthPubSubType>());
  return rows;
}

}  // namespace

const std::vector<TopicType>& all_topic_types() { return table(); }

const TopicType& topic_type(const std::string& topic) {
  for (const TopicType& row : table()) {
    if (topic == row.name) return row;
  }
  assert(false && "not in topics.hpp");
  std::abort();
}

}  // namespace aisle::bus
