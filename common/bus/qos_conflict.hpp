#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/bus/qos.hpp"
#include "common/bus/sample_info.hpp"

namespace aisle::bus {

/// Why a writer and a reader of one topic do not match, by the rules of DDS (a writer must offer at
/// least what a reader asks for): the policy, what is offered and what is asked for. Empty when they
/// match.
std::string qos_conflict(const Qos& offered, bool offers_manual_liveliness, const Qos& requested,
                         bool asks_manual_liveliness);

/// A reader or writer as its participant announces it.
struct Announced {
  std::string topic, type;
  bool is_writer{false};
  Qos qos;
  bool manual_liveliness{false};
};

/// What a person must know when `theirs` appears on the topic of `ours`: another type, or a QoS that
/// does not fit. None when they fit, or never meet (both write, both read). `participant`: name and
/// host of theirs.
std::optional<Incident> mismatch(const Announced& ours, const Announced& theirs, const std::string& participant);

/// Do the partitions have a name in common? Names may be patterns (fnmatch), on either side; an empty
/// list is the default partition, as is the empty name.
bool same_partition(const std::string& ours, const std::vector<std::string>& theirs);

}  // namespace aisle::bus
