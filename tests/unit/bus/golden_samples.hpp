#pragma once
#include "common/bus/topics.hpp"

namespace aisle::bus_test {

// One sample of each type with every field set to something of its own.
void fill(MapInfo& sample);
void fill(MapTile& sample);
void fill(MapRequest& sample);
void fill(MapEdit& sample);
void fill(MapEditResult& sample);
void fill(VehicleInfo& sample);
void fill(VehicleState& sample);
void fill(Scan& sample);
void fill(Goal& sample);
void fill(Plan& sample);
void fill(Track& sample);
void fill(TrackingStatus& sample);
void fill(Coverage& sample);
void fill(VelocityCommand& sample);
void fill(NavigationStatus& sample);
void fill(WorldObstacle& sample);
void fill(ServiceHealth& sample);

}  // namespace aisle::bus_test
