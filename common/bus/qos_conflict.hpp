#pragma once
#include <string>

#include "common/bus/qos.hpp"

namespace aisle::bus {

/// Why a writer and a reader of one topic do not meet: the policy, what is offered and what is asked for; empty when
/// they do.
std::string qos_conflict(const Qos& offered, bool offers_manual_liveliness, const Qos& requested,
                         bool asks_manual_liveliness);

}  // namespace aisle::bus
