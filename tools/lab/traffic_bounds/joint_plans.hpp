#pragma once

#include <cstddef>

#include "common/scenario/scenario.hpp"
#include "tools/lab/traffic_bounds/fleet_case.hpp"

namespace aisle::lab {

/// Plans of a whole fleet made from nothing, each vehicle to its first goal; nobody drives.
struct JointPlans {
  std::size_t planned{0};  // vehicles with a plan to their goals
  double ends_s{0.0};      // sum of the forecast ends of those
  double alone_s{0.0};     // the same, each of them planned alone
  double cpu_s{0.0};       // of all plans together; the only figure that depends on the machine

  /// How much longer all together take than each alone.
  double stretch() const { return alone_s > 0.0 ? ends_s / alone_s : 1.0; }
};

/// One vehicle after the other, then with those in its way, then all together, as the coordinator does; no own ways.
JointPlans plan_from_nothing(const FloorModel& model, const scenario::Scenario& fleet);

}  // namespace aisle::lab
