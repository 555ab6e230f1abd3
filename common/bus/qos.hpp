#pragma once
#include <chrono>

namespace aisle::bus {

enum class Reliability { kBestEffort, kReliable };
enum class Durability { kVolatile, kTransientLocal };
enum class Ownership { kShared, kExclusive };

/// The contract of a topic, the same for its writers and its readers. What belongs to the site (interfaces, discovery,
/// shared memory) is in Settings instead. depth 0: keep all, bounded by `max_kept`.
struct Qos {
  Reliability reliability{Reliability::kReliable};
  Durability durability{Durability::kVolatile};
  int depth{1};
  int max_kept{0};
  std::chrono::milliseconds deadline{0};  // 0: none
  Ownership ownership{Ownership::kShared};
  std::chrono::milliseconds liveliness_lease{0};  // 0: automatic, infinite; else manual by topic
};

}  // namespace aisle::bus
