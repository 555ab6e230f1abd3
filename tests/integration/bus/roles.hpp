#pragma once
#include <string>

#include "common/bus/bus.hpp"

namespace aisle::bus_test {

/// What a peer does on its bus; see peer.cpp. False for a role of no such name.
bool play_role(bus::Bus& bus, const std::string& role, const std::string& name, int strength);

}  // namespace aisle::bus_test
