#pragma once

#include <chrono>

namespace aisle::bus {

enum class Reliability { kBestEffort, kReliable };
enum class Durability { kVolatile, kTransientLocal };
enum class Ownership { kShared, kExclusive };

/// The contract of a topic, the same for its writers and its readers (DDS 1.4, section 2.2.3, names the
/// policies). What belongs to the site (interfaces, discovery, shared memory) is in Settings instead.
///
/// depth: samples that are kept for each instance, the newest; 0: all, at most `max_kept` of a writer
/// that were not acknowledged.
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
