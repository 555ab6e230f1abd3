#pragma once

#include <cstdint>

namespace aisle::fleet {

/// A planner that leads, or did: the epoch that it leads with, and the start of its process.
struct Claim {
  std::uint32_t epoch{0};    // 0: none
  std::uint64_t boot_id{0};  // see Origin
};

inline bool operator==(const Claim& a, const Claim& b) { return a.epoch == b.epoch && a.boot_id == b.boot_id; }
inline bool operator!=(const Claim& a, const Claim& b) { return !(a == b); }

/// Is `a` obeyed rather than `b`? The higher epoch is; of two planners with one epoch, each of which led its side of a
/// network that was split, the one that started first.
inline bool outranks(const Claim& a, const Claim& b) {
  return a.epoch != b.epoch ? a.epoch > b.epoch : a.boot_id < b.boot_id;
}

}  // namespace aisle::fleet
