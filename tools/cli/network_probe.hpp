#pragma once

#include <vector>

#include "tools/cli/diagnosis.hpp"

namespace aisle::cli {

/// The IPv4 addresses of this host that are up. Each is tried with one multicast datagram to itself, which does not
/// leave the host.
std::vector<NetworkInterface> probe_interfaces();

}  // namespace aisle::cli
