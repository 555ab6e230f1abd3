#pragma once
#include <any>
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
  kDisposed,      // the writer says that this instance is gone; only the key fields of the sample hold
  kNoWriters,     // every writer of this instance is gone or silent beyond its lease; only the key fields hold
};

struct SampleInfo {
  SampleKind kind{SampleKind::kData};
  std::string writer;                                     // GUID, for logs
  std::chrono::steady_clock::time_point arrived;          // when it was taken, on this host's monotonic clock
};

/// Something about our site that a person must know, by name: topic, the peer, what does not fit.
struct Incident {
  enum class Kind { kIncompatibleQos, kTypeMismatch, kDeadlineMissed, kLivelinessLost, kSampleRejected, kMalformedSample };
  Kind kind;
  std::string topic;
  std::string text;   // one line
};

/// An endpoint seen on the wire (our own too), for inspection.
struct Endpoint {
  std::string topic, type, participant, host;
  bool is_writer{false};
  Qos qos;
};

class Bus;

/// Writes samples of one topic. Copies share the one DDS writer. Write from the loop's thread only.
template <class Topic>
class Writer {
 public:
  Writer() = default;
  /// False when the middleware took nothing (history full of unacknowledged samples, or out of memory).
  bool write(const typename Topic::Sample& sample) { return raw_write(&sample); }
  /// Tells readers that the instance with these key fields is gone.
  bool dispose(const typename Topic::Sample& sample) { return raw_dispose(&sample); }
  /// For topics with a manual lease, when there is nothing new to write.
  void assert_liveliness();
  int matched_readers() const;
  /// True when every matched reader has acknowledged everything, or after `limit`.
  bool wait_until_acknowledged(std::chrono::milliseconds limit);

 private:
  friend class Bus;
  struct Raw;
  bool raw_write(const void* sample);
  bool raw_dispose(const void* sample);
  std::shared_ptr<void> raw_;
};

/// One DDS participant and one event loop. Handlers and timers run in the loop, on the thread that calls run_*: no locks are
/// needed, no work is done on threads of the middleware. Create everything before the loop or from within a handler of a timer.
class Bus {
 public:
  /// @throws config::BadEnvironment when the participant cannot be made (no such interface, ports taken, bad certificate)
  explicit Bus(const Settings& settings);
  ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// `strength`: of this writer on topics with exclusive ownership.
  template <class Topic>
  Writer<Topic> writer(int strength = 0);

  /// Calls `handler` for each sample, disposal and loss of writers, in order of arrival.
  template <class Topic>
  void on(std::function<void(const typename Topic::Sample&, const SampleInfo&)> handler);

  void every(std::chrono::nanoseconds period, std::function<void()> handler);
  void on_incident(std::function<void(const Incident&)> handler);

  /// Waits until something happens, at most `limit`, and handles all there is. False when `limit` passed with nothing.
  bool run_once(std::chrono::nanoseconds limit);
  void run_until(const std::atomic<bool>& stop);

  int matched_writers(const std::string& topic) const;
  std::vector<Endpoint> endpoints() const;
  /// Names of other participants in the domain.
  std::vector<std::string> participants() const;
  const Settings& settings() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace aisle::bus
