#pragma once
// Buses of one domain in one process, on loopback, driven in turn until something holds.
#include <unistd.h>

#include <chrono>
#include <functional>
#include <initializer_list>
#include <string>

#include "common/bus/dds/dds_bus.hpp"

namespace aisle::bus_test {

using namespace std::chrono_literals;
using bus::Bus;
using bus::DdsBus;

/// Domains 200 to 219: one a test of this program; tests of a program run one after another.
inline bus::Settings loopback(int domain, const std::string& name = "test") {
  bus::Settings settings;
  settings.domain = domain;
  settings.interfaces = {"127.0.0.1"};
  settings.participant_name = name;
  return settings;
}

/// Runs the loops until `done`, at most `limit`.
inline bool run_until(std::initializer_list<Bus*> buses, const std::function<bool()>& done,
                      std::chrono::milliseconds limit = 10s) {
  const auto end = std::chrono::steady_clock::now() + limit;
  while (!done()) {
    if (std::chrono::steady_clock::now() >= end) return false;
    for (Bus* bus : buses) bus->run_once(2ms);
  }
  return true;
}

}  // namespace aisle::bus_test
