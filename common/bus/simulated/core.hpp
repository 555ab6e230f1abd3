#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/bus/simulated/endpoints.hpp"
#include "common/bus/simulated/event_queue.hpp"
#include "common/bus/simulated/links.hpp"
#include "common/bus/simulated/network.hpp"
#include "common/bus/simulated/process.hpp"

namespace aisle::bus::simulated {

/// What Network and its buses share: virtual time, the turns of processes, packets, discovery.
///
/// How: a queue of events in order of time. Each step goes to the next time, runs all events of it,
/// then gives a turn to each process that has work, in the order of their ids. Nothing depends on
/// addresses or on real time, so that the same calls give the same run.
class Core : public std::enable_shared_from_this<Core> {
 public:
  Core(std::uint64_t seed, const Options& options);

  // Time.
  time::Stamp now() const { return now_; }

  /// Calls `action` at that time, or at once when it is past; after(): that much later than now.
  void at(time::Stamp time, std::function<void()> action) { events_.push(std::max(time, now_), std::move(action)); }
  void after(time::Stamp delay, std::function<void()> action) { at(now_ + delay, std::move(action)); }

  /// Goes to the next moment and lets it happen: all its events, then the turns. False when nothing is
  /// due at any time.
  bool step();

  /// Steps until `time`, see Network::advance_to().
  void advance_to(time::Stamp time);

  /// Lets time pass until `done`; false when `limit` came first.
  bool wait(time::Stamp limit, const std::function<bool()>& done);

  /// Notes that the process has work; its turn comes at the end of this step.
  void give_turn(Process& process) {
    if (process.driven && !process.gone) ready_.insert(process.id);
  }

  // Packets.
  /// Calls `arrival` when the packet arrives, as often as it does.
  template <class Arrival>
  void send(const Process& from, Process& to, std::size_t bytes, const Arrival& arrival) {
    const Links::Fate fate = links_.send(from.host, to.host);
    for (int i = 0; i < fate.copies; ++i) {
      after(fate.after[i], [this, &to, bytes, arrival] { take_in(to, bytes, arrival); });
    }
  }

  /// A packet has arrived. A process that stands takes it when it goes on, if its socket's buffer could hold it.
  template <class Arrival>
  void take_in(Process& to, std::size_t bytes, const Arrival& arrival) {
    if (to.gone) return;
    if (!to.frozen_since) return arrival();

    if (to.held_bytes + bytes > options_.socket_buffer_bytes) {
      ++links_.tally().lost;
      return;
    }

    to.held_bytes += bytes;
    to.held.emplace_back(arrival);
  }

  /// As send(), but once, and sent again until it arrives: what discovery's reliable endpoints say. A process that is
  /// gone sends nothing again.
  void tell(Process& from, Process& to, std::function<void()> arrival);

  /// Can a packet get through now: neither process frozen, the link not cut?
  bool passes(const Process& from, const Process& to) const;

  /// By how much the slower way between them takes longer than a link of the network's own does.
  time::Stamp extra_latency(const Process& a, const Process& b) const;
  Links& links() { return links_; }

  // Discovery.
  /// A new process, which the others of its domain come to know after Options::discovery.
  std::shared_ptr<Process> join(const Settings& settings, const std::string& host);

  /// A new writer or reader meets those of all participants that its own knows.
  void introduce(WriterEnd& writer);
  void introduce(ReaderEnd& reader);

  /// A process that ends in order (others are told), one killed, and one stopped or continued.
  void leave(Process& process);
  void crash(Process& process);
  void freeze(Process& process, bool frozen);

  /// See Network. Participants that cannot hear each other any more forget each other after their
  /// lease.
  void set_link(const std::string& from, const std::string& to, const Link& link);
  void set_all_links(const Link& link);

  /// Made at its first use.
  Topic& topic(const char* name);
  const Process& process(int id) const { return *processes_[static_cast<std::size_t>(id)]; }
  std::int64_t wall_clock_ns(int host) const;
  void set_wall_clock_offset(int host, time::Stamp offset) { wall_offsets_[host] = offset; }
  const Options& options() const { return options_; }

 private:
  bool is_idle() const { return events_.empty() && ready_.empty(); }
  time::Stamp next_time() const { return ready_.empty() ? std::max(now_, events_.next_time()) : now_; }

  /// Of all processes that are ready, in the order of their ids.
  void give_turns();

  /// Lets two processes try to meet after `delay`, once at a time.
  void meet_soon(Process& a, Process& b, time::Stamp delay);

  /// They know each other from now on, if packets pass in both directions; else they try again.
  void meet(Process& a, Process& b);

  /// Matches each writer of one process with the reader of its topic of the other.
  void match_all(Process& writers, Process& readers);
  void match_soon(WriterEnd& writer, ReaderEnd& reader);

  /// Connects the two when they fit, or renews their connection. Reports a misfit once to both sides.
  void match(WriterEnd& writer, ReaderEnd& reader);
  bool fit(WriterEnd& writer, ReaderEnd& reader);

  /// See discovery.cpp.
  void establish(Match& match);

  /// From now on nothing comes from the process; others forget it after its lease.
  void fall_silent(Process& process);

  /// One side's lease of the other ran out: its matches with it end.
  void forget(Process& forgetful, Process& other);
  void watch_cuts();

  /// After the lease, if `other` has been silent since `silent_since` without a break.
  void forget_when_still(Process& forgetful, Process& other, time::Stamp silent_since);
  std::optional<time::Stamp> silent_since(const Process& speaker, const Process& listener) const;

  Options options_;
  time::Stamp now_;
  EventQueue events_;
  Links links_;
  std::map<std::string, Topic> topics_;
  std::vector<std::shared_ptr<Process>> processes_;  // by id
  std::set<int> ready_;                              // processes with work
  std::set<std::pair<int, int>> meeting_;            // pairs with a try to come
  std::vector<std::unique_ptr<Match>> matches_;
  std::set<std::pair<const WriterEnd*, const ReaderEnd*>> refused_;  // told of already; never iterated
  std::map<int, time::Stamp> wall_offsets_;                          // by host
};

}  // namespace aisle::bus::simulated
