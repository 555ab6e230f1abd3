#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace aisle::fleet {

/// Floor beside a granted step that the vehicle may use as well, to either side of its tube.
struct ExtraWidth {
  std::uint64_t step{0};
  double left_m{0.0};   // 0 to 100
  double right_m{0.0};  // 0 to 100
};

/// How far one vehicle may drive on which plan, from the leading global planner. A vehicle obeys the grant with the
/// highest number of its epoch; a lower number changes nothing.
struct Grant {
  std::string agv_id;
  std::uint64_t number{0};      // counts the vehicle's grants within an epoch, from 1
  std::uint64_t plan_id{0};     // Plan::id
  double limit_m{0.0};          // along that plan's waypoints, 0 to 1e9
  std::uint64_t limit_step{0};  // the first step that is not granted, counted from the vehicle's registration; it wins
                                // over limit_m when a newer plan repeats a granted part
  bool gives_back{false};       // asks to give back what lies beyond limit_step: the vehicle's status answers with the
                                // lowest limit that it can still stop at
  std::vector<ExtraWidth> extra;       // at most 32, by step: the steps do not fall
  std::vector<std::string> waits_for;  // ids of vehicles that must pass first, at most 16
  std::string reason;                  // why it ends there, for people, at most 256 characters
};

}  // namespace aisle::fleet
