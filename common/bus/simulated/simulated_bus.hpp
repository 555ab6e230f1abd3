#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"

namespace aisle::bus::simulated {

class Core;
class Process;

/// A process's bus on a simulated network; made by Network::join(). Its destructor leaves as an orderly
/// process does; crash() before it is `kill -9`.
///
/// Its loop runs when run_once() is called, or, after drive(), whenever the network has something for
/// it.
class SimulatedBus final : public Bus {
 public:
  SimulatedBus(std::shared_ptr<Core> core, std::shared_ptr<Process> process);
  ~SimulatedBus() override;

  /// Virtual time of the network.
  time::Stamp now() const override;

  /// Of its host, which faults may set to any time.
  std::int64_t wall_clock_ns() const override;
  void every(std::chrono::nanoseconds period, std::function<void()> handler) override;
  void on_incident(std::function<void(const Incident&)> handler) override;

  /// From the network's thread only.
  void post(std::function<void()> work) override;

  /// Virtual time passes while it waits; other buses that are driven have their turns meanwhile.
  bool run_once(std::chrono::nanoseconds limit) override;
  int matched_writers(const std::string& topic) const override;
  std::vector<Endpoint> endpoints() const override;
  std::vector<Participant> peers() const override;
  const Settings& settings() const override;

  /// From now on the network calls `turn` whenever something is due for this bus; without one, `run_once(0)`. A turn
  /// that is given must call run_once(0).
  void drive(std::function<void()> turn = {});

  /// How long a turn takes: the next one begins no earlier than that after it.
  void set_turn_time(std::chrono::nanoseconds time);

  /// While hung its loop does not run, as in a deadlock. The middleware's threads go on (they
  /// acknowledge, answer, renew the participant's lease); manual liveliness is lost.
  void hang(bool hung);

  /// While frozen the whole process stands, as under SIGSTOP: nothing of it goes on; what arrives is
  /// taken when it continues.
  void freeze(bool frozen);

  /// Ends it without a word, as `kill -9` does: others notice by leases. Afterwards the bus can only be
  /// destroyed, and its handlers are not called again. Not to be called within its own turn, nor while
  /// it waits in one.
  void crash();
  bool has_crashed() const;

  /// Writers and readers of `topic` made from now on announce this instead: another release, or a foreign peer.
  void announce_as(const std::string& topic, const Qos& qos, const std::string& type_name);

 private:
  std::shared_ptr<detail::RawWriter> raw_writer(const char* topic, int strength) override;
  void raw_on(const char* topic, detail::RawHandler handler) override;

  std::shared_ptr<Core> core_;
  std::shared_ptr<Process> process_;
};

}  // namespace aisle::bus::simulated
