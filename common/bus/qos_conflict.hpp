#pragma once
#include <optional>
#include <string>
#include <vector>

#include "common/bus/qos.hpp"
#include "common/bus/sample_info.hpp"

namespace aisle::bus {

/// Why a writer and a reader of one topic do not meet: the policy, what is offered and what is asked for; empty when
/// they do.
std::string qos_conflict(const Qos& offered, bool offers_manual_liveliness, const Qos& requested,
                         bool asks_manual_liveliness);

/// A reader or writer as its participant announces it.
struct Announced {
  std::string topic, type;
  bool is_writer{false};
  Qos qos;
  bool manual_liveliness{false};
};

/// What a person must know when `theirs` appears on the topic of `ours`; empty when they fit, or never meet (both
/// write, both read). `participant`: name and host of theirs.
std::optional<Incident> mismatch(const Announced& ours, const Announced& theirs, const std::string& participant);

/// Names may be patterns, on either side; no name is the default partition.
bool same_partition(const std::string& ours, const std::vector<std::string>& theirs);

}  // namespace aisle::bus
