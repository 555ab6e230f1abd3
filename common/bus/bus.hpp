#pragma once
#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/bus/settings.hpp"
#include "common/bus/topics.hpp"

namespace aisle::bus {

enum class SampleKind {
  kData,
  kDisposed,   // the writer says that this instance is gone; only the key fields of the sample hold
  kNoWriters,  // every writer of this instance is gone or silent beyond its lease; only the key fields hold
};

/// kDisposed and kNoWriters come for instances of which data came before, and not on queues (depth 0).
struct SampleInfo {
  SampleKind kind{SampleKind::kData};
  std::string writer;                             // GUID, for logs
  std::chrono::steady_clock::time_point arrived;  // when it was taken, on this host's monotonic clock
};

/// Something about our site that a person must know, by name: topic, the peer, what does not fit.
struct Incident {
  enum class Kind {
    kIncompatibleQos,
    kTypeMismatch,
    kDeadlineMissed,
    kLivelinessLost,
    kSampleRejected,
    kMalformedSample
  };
  Kind kind;
  std::string topic;
  std::string text;  // one line
};

/// An endpoint seen on the wire (our own too), for inspection.
struct Endpoint {
  std::string topic, type, participant, host;
  bool is_writer{false};
  Qos qos;  // history is not announced: depth is 0 for those of others
  std::vector<std::string> partitions;
};

/// Another participant of the domain, whatever its partition.
struct Participant {
  std::string name, host;
  int process_id{0};  // 0: unknown
};

namespace detail {
/// A writer without its type, so that who writes does not compile the middleware's headers.
class RawWriter {
 public:
  virtual ~RawWriter() = default;
  virtual bool write(const void* sample) = 0;
  virtual bool dispose(const void* sample) = 0;
  virtual void assert_liveliness() = 0;
  virtual int matched_readers() const = 0;
  virtual bool wait_until_acknowledged(std::chrono::milliseconds limit) = 0;
};
using RawHandler = std::function<void(const void* sample, const SampleInfo&)>;
}  // namespace detail

/// Writes samples of one topic. Copies share the one DDS writer. Write from the loop's thread only. A default-made
/// writer, and one whose bus is gone, write nothing.
template <class Topic>
class Writer {
 public:
  Writer() = default;
  /// False when the middleware took nothing (history full of unacknowledged samples, or out of memory).
  bool write(const typename Topic::Sample& sample) { return raw_ && raw_->write(&sample); }
  /// Tells readers that the instance with these key fields is gone. False when it was never written.
  bool dispose(const typename Topic::Sample& sample) { return raw_ && raw_->dispose(&sample); }
  /// For topics with a manual lease, when there is nothing new to write.
  void assert_liveliness() {
    if (raw_) raw_->assert_liveliness();
  }
  int matched_readers() const { return raw_ ? raw_->matched_readers() : 0; }
  /// True when every matched reader has acknowledged everything; false after `limit`.
  bool wait_until_acknowledged(std::chrono::milliseconds limit) { return raw_ && raw_->wait_until_acknowledged(limit); }

 private:
  friend class Bus;
  explicit Writer(std::shared_ptr<detail::RawWriter> raw) : raw_(std::move(raw)) {}
  std::shared_ptr<detail::RawWriter> raw_;
};

/// One DDS participant and one event loop. Handlers and timers run in the loop, on the thread that calls run_*: no
/// locks are needed, no work is done on threads of the middleware. Readers, writers and timers may be added at any
/// time, also from a handler. All functions but post() belong to the loop's thread.
class Bus {
 public:
  /// @throws config::BadEnvironment when the participant cannot be made (no such interface, ports taken, bad
  /// certificate), config::BadInput for settings that fit no site
  explicit Bus(const Settings& settings);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// `strength`: of this writer on topics with exclusive ownership. Each call makes one DDS writer.
  template <class Topic>
  Writer<Topic> writer(int strength = 0) {
    return Writer<Topic>(raw_writer(Topic::kName, strength));
  }

  /// Calls `handler` for each sample, disposal and loss of writers, in order of arrival. Handlers of one topic share a
  /// reader.
  template <class Topic>
  void on(std::function<void(const typename Topic::Sample&, const SampleInfo&)> handler) {
    raw_on(Topic::kName, [handler = std::move(handler)](const void* sample, const SampleInfo& info) {
      handler(*static_cast<const typename Topic::Sample*>(sample), info);
    });
  }

  /// First after one period. A loop that is late skips ticks, so that they never pile up.
  void every(std::chrono::nanoseconds period, std::function<void()> handler);
  void on_incident(std::function<void(const Incident&)> handler);
  /// Runs `work` in the loop, soon. From any thread: for workers that hand back a result.
  void post(std::function<void()> work);

  /// Waits until something happens, at most `limit`, and handles all there is. False when `limit` passed with nothing.
  bool run_once(std::chrono::nanoseconds limit);
  /// Looks at `stop` after each event and at least every 100 ms.
  void run_until(const std::atomic<bool>& stop);

  int matched_writers(const std::string& topic) const;
  std::vector<Endpoint> endpoints() const;
  /// Names of other participants in the domain.
  std::vector<std::string> participants() const;
  std::vector<Participant> peers() const;
  const Settings& settings() const;

 private:
  std::shared_ptr<detail::RawWriter> raw_writer(const char* topic, int strength);
  void raw_on(const char* topic, detail::RawHandler handler);

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace aisle::bus
