#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>

#include "common/bus/settings.hpp"
#include "common/bus/simulated/link.hpp"
#include "common/bus/simulated/simulated_bus.hpp"
#include "common/time/stamp.hpp"

namespace aisle::bus::simulated {

class Core;

/// Times of the protocol, as the DDS bus sets them. Those of discovery are on links like `link`; slower ones add what
/// they take longer.
struct Options {
  Link link;                                           // every link until set_link() says otherwise
  std::chrono::nanoseconds discovery{20'000'000};      // from joining to knowing each other
  std::chrono::nanoseconds matching{2'000'000};        // of a new writer or reader with participants already known
  std::chrono::nanoseconds announcement{500'000'000};  // participants that could not meet try again this often
  std::chrono::nanoseconds participant_lease{5'000'000'000};    // a participant silent for longer is forgotten
  std::chrono::nanoseconds heartbeat{50'000'000};               // of reliable writers with unacknowledged samples
  std::size_t socket_buffer_bytes{4U << 20};                    // what is kept for a process that stands
  time::Stamp start{std::chrono::hours(1)};                     // Bus::now() at the beginning
  std::int64_t wall_clock_start_ns{1'767'225'600'000'000'000};  // Bus::wall_clock_ns() at the beginning: 2026-01-01 UTC
};

/// A network of hosts with processes on it, in one thread, in virtual time. Time passes only in
/// advance_to(), in step(), and while a bus waits (run_once, wait_until_acknowledged). Everything
/// random comes from one generator with the given seed: the same calls give the same run, on every
/// machine.
///
///     Network network(7);
///     auto planner = network.join(settings("planner"), "server");
///     auto vehicle = network.join(settings("vehicle"), "agv-1");
///     planner->drive();  vehicle->drive();          // the network runs their loops
///     network.set_link("server", "agv-1", lossy);
///     network.advance_to(network.now() + 10s);
class Network {
 public:
  explicit Network(std::uint64_t seed, const Options& options = {});
  ~Network();
  Network(const Network&) = delete;
  Network& operator=(const Network&) = delete;

  /// A process on `host` joins. It may outlive the network, and is silent then.
  std::unique_ptr<SimulatedBus> join(const Settings& settings, const std::string& host);

  time::Stamp now() const;

  /// Lets everything that is due until `time` happen, in order of time, then of creation. Afterwards
  /// now() is `time`, or later when a handler waited beyond it.
  void advance_to(time::Stamp time);

  /// Goes to the next moment at which something is due, and lets it happen. False when nothing is.
  bool step();

  /// Calls `action` at `time` between the turns of buses, or in the next step when `time` is past: for
  /// faults, and for what people do.
  void at(time::Stamp time, std::function<void()> action);

  /// The link from one host to the other (or within one); the opposite direction is another link.
  void set_link(const std::string& from, const std::string& to, const Link& link);
  const Link& link(const std::string& from, const std::string& to) const;

  /// Sets both directions between all different hosts, known now or later, and drops what set_link()
  /// said of them.
  void set_all_links(const Link& link);

  /// Stops everything in this direction; what is under way still arrives. heal() ends it.
  void cut(const std::string& from, const std::string& to) { set_cut(from, to, true); }
  void heal(const std::string& from, const std::string& to) { set_cut(from, to, false); }

  /// The wall clock of `host` from now on shows `offset` more than at the beginning.
  void set_wall_clock_offset(const std::string& host, std::chrono::nanoseconds offset);

  /// Packets and samples so far.
  const Tally& tally() const;
  const Options& options() const;

 private:
  void set_cut(const std::string& from, const std::string& to, bool cut);

  std::shared_ptr<Core> core_;
};

}  // namespace aisle::bus::simulated
