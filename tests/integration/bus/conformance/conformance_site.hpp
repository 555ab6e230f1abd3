#pragma once
// Where the cases of the conformance suite run: on DDS, in real time, or on a simulated network, in virtual time.
#include <chrono>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>

#include "common/bus/bus.hpp"

namespace aisle::bus_test {

using namespace std::chrono_literals;
using bus::Bus;

/// A process of its own with a bus, playing one of the roles of roles.hpp.
class Peer {
 public:
  virtual ~Peer() = default;
  /// kill -9.
  virtual void kill() = 0;
  /// SIGSTOP, and SIGCONT.
  virtual void freeze(bool frozen) = 0;
  /// SIGTERM: it leaves in order.
  virtual void leave() = 0;
};

class ConformanceSite {
 public:
  virtual ~ConformanceSite() = default;
  /// A bus of this process, whose loop runs when the case runs it.
  virtual std::unique_ptr<Bus> join(const std::string& name, const std::string& partition = "",
                                    bool other_domain = false) = 0;
  virtual std::unique_ptr<Peer> start(const std::string& name, const std::string& role, int strength = 0) = 0;
  /// A foreign writer of `topic` that announces another contract: `qos`, and the type of topic `type_of`.
  virtual std::shared_ptr<void> foreign_writer(const std::string& topic, const bus::Qos& qos,
                                               const std::string& type_of) = 0;
  virtual time::Stamp now() const = 0;
  /// Time passes, and no loop runs but those of peers.
  virtual void idle(std::chrono::milliseconds time) = 0;

  /// Runs the loops in turn until `done`, at most `limit`.
  bool run_until(std::initializer_list<Bus*> buses, const std::function<bool()>& done,
                 std::chrono::milliseconds limit = 10s) {
    const time::Stamp end = now() + limit;
    while (!done()) {
      if (now() >= end) return false;
      for (Bus* bus : buses) bus->run_once(2ms);
    }
    return true;
  }
  void run_for(std::initializer_list<Bus*> buses, std::chrono::milliseconds time) {
    run_until(
        buses, [] { return false; }, time);
  }
};

std::unique_ptr<ConformanceSite> dds_site();
std::unique_ptr<ConformanceSite> simulated_site();

}  // namespace aisle::bus_test
