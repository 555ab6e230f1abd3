#pragma once

// Writers, readers and what stands between a pair of them. None of these is ever deleted while the network lives, since
// events hold references; `gone` says that the process let go of it.

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/bus/heard_instances.hpp"
#include "common/bus/qos_conflict.hpp"
#include "common/bus/reader_incidents.hpp"
#include "common/bus/sample_codec.hpp"
#include "common/bus/simulated/change.hpp"

namespace aisle::bus::simulated {

class Core;
class Process;
class ReaderEnd;
class WriterEnd;

/// A topic of the network: its codec, and small numbers for its keys.
class Topic {
 public:
  explicit Topic(const SampleCodec& topic_codec) : codec(topic_codec) {}

  /// The instance that `sample` belongs to, a new one for a new key.
  InstanceId instance_of(const void* sample);

  const SampleCodec& codec;

 private:
  std::map<std::string, int> instances_;  // by key
  std::string key_;                       // scratch
};

/// A writer and a reader that found each other. Each side forgets the other by itself.
struct Match {
  Match(WriterEnd& its_writer, ReaderEnd& its_reader) : writer(its_writer), reader(its_reader) {}

  WriterEnd& writer;
  ReaderEnd& reader;
  bool reliable{false}, transient_local{false};

  // The writer's side. Each match has a stream of numbered messages; a new stream begins when one side forgot the
  // other.
  struct Message {
    ChangePtr change;  // null: of no interest any more, the reader is told to go on
    time::Stamp sent{};
  };

  bool at_writer{false};
  std::uint64_t stream{0}, next{1};
  std::map<std::uint64_t, Message> unacknowledged;
  bool heartbeats{false};

  // The reader's side.
  bool at_reader{false};
  std::uint64_t heard_stream{0}, expected{1}, announced{0};
  std::map<std::uint64_t, ChangePtr> early;  // messages behind a missing one
  std::uint64_t newest{0};                   // sequence of the writer's newest change that was taken
  bool alive{true}, lease_watched{false};
  time::Stamp asserted{};
};

/// A writer of a process: keeps what late joiners need and sends to its matches.
///
/// How a reliable match works, after the RTPS protocol (OMG, Real-Time Publish-Subscribe 2.2, chapter
/// 8.4): messages are numbered; the reader answers with the next number it expects and the numbers that
/// it misses; the writer sends missing ones again, and heartbeats as long as something is not
/// acknowledged.
class WriterEnd {
 public:
  WriterEnd(Core& core, Process& process, Topic& topic, Announced announced, int strength, std::string guid);

  /// As in RawWriter.
  bool write(const void* sample);
  bool dispose(const void* sample);

  /// The writer of this match is alive now.
  void assert_liveliness();
  int matched_readers() const;
  bool is_acknowledged() const;

  /// The writer's side of `match` begins (anew): late joiners get what is kept, or what is still owed to them.
  void begin_stream(Match& match);

  /// The reader is forgotten.
  void forget(Match& match);

  /// Let go by its process: readers are told.
  void close();

  /// Its process is gone; nobody is told.
  void stop();

  Process& process;
  Topic& topic;
  const Announced announced;
  const int strength;  // 0 on topics with shared ownership
  const std::string guid;
  std::vector<Match*> matches;
  bool gone{false};

 private:
  /// Encodes the sample, keeps and sends it. False when the queue is full or the sample cannot be
  /// encoded.
  bool say(const void* sample, const InstanceId& instance, bool disposed);

  /// Forgets how much was written once all readers have acknowledged all of it.
  void end_acknowledged();
  bool is_full() const;

  /// Keeps the change for late joiners, the newest `depth` of its instance.
  void keep(const ChangePtr& change);

  /// To all matches.
  void publish(const ChangePtr& change);

  /// On a reliable match.
  void send(Match& match, const ChangePtr& change);

  /// Sends message `number` of the stream, for the first time or again.
  void transmit(Match& match, std::uint64_t number);

  /// Heartbeats go on until everything is acknowledged.
  void begin_heartbeats(Match& match);
  void heartbeat(Match& match);

  /// What the reader sends back on a message or a heartbeat.
  void answer(Match& match);

  /// What the writer does with that answer.
  void acknowledged(Match& match, std::uint64_t stream, std::uint64_t expected,
                    const std::vector<std::uint64_t>& missing);

  Core& core_;
  std::uint64_t sequence_{0};
  int unended_{0};                                    // samples written since all were acknowledged
  std::map<InstanceId, std::deque<ChangePtr>> kept_;  // of a transient-local writer, by instance, the newest `depth`
  std::set<InstanceId> written_;                      // instances that were not disposed
};

/// A reader of a process: puts streams back into order, decides ownership, watches leases and
/// deadlines, and keeps what came until the process's loop takes it.
class ReaderEnd {
 public:
  ReaderEnd(Core& core, Process& process, Topic& topic, Announced announced);

  /// A further handler; it is called after those before it.
  void add(detail::RawHandler handler) { handlers_.push_back(std::move(handler)); }
  int matched_writers() const;

  // The middleware's part: runs whether or not the process's loop does.
  /// A best-effort sample, or the next one of a reliable stream.
  void accept(Match& match, const ChangePtr& change);
  void assert_liveliness(Match& match);

  /// The reader's side of `match` begins (anew).
  void begin(Match& match);

  /// The writer is gone, or forgotten.
  void forget(Match& match);

  /// Its process is gone; nobody is told.
  void stop();

  // The loop's part.
  using Report = std::function<void(const Incident&)>;

  /// Hands what has arrived to the handlers. False when there was nothing.
  bool drain(const Report& report);

  /// Would drain() find something?
  bool has_work() const { return !waiting_.empty() || !events_.empty() || missed_ > 0; }

  Process& process;
  Topic& topic;
  const Announced announced;
  std::vector<Match*> matches;
  bool gone{false};

 private:
  /// A change that came, and from whom.
  struct Cached {
    ChangePtr change;
    WriterEnd* writer;

    const InstanceId& instance() const { return change->instance; }
  };

  /// A writer came back, fell silent or went.
  struct WriterEvent {
    WriterEnd* writer;
    bool gone;
    bool silent;  // beyond its lease, rather than closed
  };

  /// Decides by strength and id among the writers of an instance that are alive.
  bool is_owner(const WriterEnd& writer, const InstanceId& instance);

  /// The writer owns no instance any more.
  void lose_ownership(const WriterEnd& writer);

  /// Asks for a turn of the process.
  void wake();
  void note(const WriterEvent& event);

  /// Looks at the end of the lease whether the writer spoke meanwhile.
  void watch_lease(Match& match);

  /// Looks at the next deadline of any instance.
  void watch_deadlines();
  void check_deadlines();

  /// Among those that wait: the newest `depth` of the instance stay.
  void put(const ChangePtr& change, WriterEnd& writer);

  bool drain_samples(const Report& report);

  /// The same steps as TopicReader's.
  void take(const Cached& cached, const Report& report);
  void end(const InstanceId& instance, const WriterEnd& writer, bool disposed);
  void lose(const WriterEvent& event, const Report& report);
  void hand_over(const void* sample, SampleKind kind, const WriterEnd& writer);

  Core& core_;
  const Qos& qos_;
  std::vector<Cached> waiting_;  // not yet taken; the last one is next: instances fall, of each the oldest is last
  std::vector<WriterEvent> events_;
  std::map<InstanceId, std::vector<const WriterEnd*>> claims_;  // by instance: alive writers, of exclusive ownership
  std::map<InstanceId, time::Stamp> deadlines_;                 // by instance
  bool deadlines_watched_{false};
  std::int64_t missed_{0}, missed_total_{0};

  std::vector<detail::RawHandler> handlers_;
  HeardInstances<InstanceId, const WriterEnd*, AnySample> instances_;
  QuietTime quiet_;
};

}  // namespace aisle::bus::simulated
