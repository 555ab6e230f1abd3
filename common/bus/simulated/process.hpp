#pragma once

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/bus/simulated/endpoints.hpp"
#include "common/bus/timers.hpp"

namespace aisle::bus::simulated {

/// A process on the network: its event loop, its writers and readers, and the participants that it
/// knows.
class Process {
 public:
  Process(Core& core, int id, int host, const Settings& settings);
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  // The event loop; see Bus.
  void every(std::chrono::nanoseconds period, std::function<void()> handler);
  void post(std::function<void()> work);
  bool run_once(std::chrono::nanoseconds limit);

  /// Would run_once(0) find something?
  bool has_work() const;

  /// Of a process that is driven: runs its loop, unless it hangs or is not back from its last turn.
  void take_turn();

  /// See Bus::writer(); reader() makes one at the topic's first use.
  std::shared_ptr<WriterEnd> add_writer(const char* topic, int strength);
  ReaderEnd& reader(const char* topic);

  /// Ends all its endpoints and forgets its handlers, without a word to others.
  void stop();

  /// See Bus.
  std::vector<Endpoint> endpoints() const;
  std::vector<Participant> peers() const;

  /// Name and host, for incidents of others.
  std::string described() const;

  Core& core;
  const int id, host;
  const Settings settings;
  std::deque<std::function<void(const Incident&)>> incident_handlers;
  std::vector<Incident> incidents;  // to be told
  std::map<std::string, Announced> announced_as;
  std::vector<std::shared_ptr<WriterEnd>> writers;
  std::map<std::string, std::unique_ptr<ReaderEnd>> readers;  // by topic
  bool samples_wait{false};                                   // some reader has something to hand over
  std::set<int> known;                                        // participants, by id
  bool driven{false}, hung{false}, gone{false}, crashed{false};
  std::optional<time::Stamp> frozen_since, gone_at;
  std::vector<std::function<void()>> held;  // packets for a process that stands
  std::size_t held_bytes{0};
  std::function<void()> turn;
  time::Stamp turn_time{};

 private:
  /// Each handles one kind of work; true when there was some.
  bool handle_posted();
  bool handle_incidents();
  bool handle_readers();
  bool handle_all();
  void report(const Incident& incident) const;

  /// Asks for a turn at the next tick.
  void wake_for_timers();

  /// What an endpoint of this process announces; see SimulatedBus::announce_as().
  Announced announce(const SampleCodec& codec, bool is_writer) const;

  Timers timers_;
  std::vector<std::function<void()>> posted_;
  std::optional<time::Stamp> wake_;
  time::Stamp busy_until_{};
  bool in_turn_{false}, waits_{false};
};

}  // namespace aisle::bus::simulated
