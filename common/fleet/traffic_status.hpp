#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::fleet {

/// A vehicle that has a goal and no road granted ahead.
struct WaitingVehicle {
  std::string agv_id;
  std::string waits_for;  // the vehicle that must pass first; empty: no vehicle
  std::string reason;     // for people, at most 256 characters
  double since_s{0.0};    // it has waited for so long, 0 or more
};

/// A vehicle that says nothing, and was not signed off. What it held stays held.
struct SilentVehicle {
  std::string agv_id;
  geometry::Point2 place_in_map;  // where it was heard last; the origin where it was never heard
};

/// What the leading global planner says of the traffic, 10 times a second.
struct TrafficStatus {
  std::string source_id;              // instance of the planner
  std::uint64_t beat{0};              // counts up with each status of a leader; vehicles repeat it in their status
  std::uint64_t register_version{0};  // of the list of vehicles that count; 0: there is none
  std::uint32_t vehicles{0};          // in the traffic
  std::uint32_t with_goal{0};
  std::vector<WaitingVehicle> waiting;  // at most 128
  std::vector<SilentVehicle> silent;    // at most 128
  double slice_ms_p99{0.0};             // computing time of a turn, 99 of 100 are shorter
  std::uint64_t refused{0};             // steps refused by the lock although their order was right: a fault when not 0
  std::uint64_t circles{0};             // found in the order: a fault when not 0
  double share_of_places{0.0};          // of the roadmap's places that vehicles take, 0 to 1
  std::vector<SilentVehicle> signed_off;  // by a person, and the place that each holds; at most 128
};

}  // namespace aisle::fleet
