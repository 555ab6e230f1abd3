#pragma once

#include <cstdint>
#include <string>

namespace aisle::fleet {

/// The source of a value. A receiver refuses an epoch lower than the one it accepted, and uses a
/// sequence number once.
struct Origin {
  std::string source_id;             // instance of the service, e.g. "global-planner-1"; empty: not said
  std::uint64_t boot_id{0};          // differs at every start of that process; a later start has a higher one
  std::uint32_t epoch{0};            // raised by whoever takes over; 0: authority does not change hands on this topic
  std::uint64_t sequence_number{0};  // counts the writer's values from 1; 0: not said
  std::int64_t stamp_ns{0};          // Unix epoch, the writer's wall clock: for people and figures, never for safety
};

inline bool operator==(const Origin& a, const Origin& b) {
  return a.source_id == b.source_id && a.boot_id == b.boot_id && a.epoch == b.epoch &&
         a.sequence_number == b.sequence_number && a.stamp_ns == b.stamp_ns;
}

inline bool operator!=(const Origin& a, const Origin& b) { return !(a == b); }

}  // namespace aisle::fleet
