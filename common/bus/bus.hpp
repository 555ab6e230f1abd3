#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "common/bus/sample_info.hpp"
#include "common/bus/settings.hpp"
#include "common/bus/topics.hpp"
#include "common/time/stamp.hpp"

namespace aisle::bus {

namespace detail {
/// A writer without its type, so that callers do not compile the middleware's headers. `sample` is
/// always of the topic's type. The functions are those of Writer.
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

/// Writes samples of one topic. Copies share one writer of the bus. Write from the loop's thread only.
/// A default-constructed writer, and one whose bus is gone, write nothing.
template <class Topic>
class Writer {
 public:
  Writer() = default;

  /// False when the bus did not take the sample (history full of unacknowledged samples, or out of
  /// memory).
  bool write(const typename Topic::Sample& sample) { return raw_ && raw_->write(&sample); }

  /// Tells readers that the instance with these key fields is gone. False when it was never written.
  bool dispose(const typename Topic::Sample& sample) { return raw_ && raw_->dispose(&sample); }

  /// Renews the manual lease of a topic that has one, when there is nothing new to write.
  void assert_liveliness() {
    if (raw_) raw_->assert_liveliness();
  }

  /// Readers of others and our own that this writer reaches.
  int matched_readers() const { return raw_ ? raw_->matched_readers() : 0; }

  /// True when every matched reader has acknowledged everything; false after `limit`.
  bool wait_until_acknowledged(std::chrono::milliseconds limit) { return raw_ && raw_->wait_until_acknowledged(limit); }

 private:
  friend class Bus;

  explicit Writer(std::shared_ptr<detail::RawWriter> raw) : raw_(std::move(raw)) {}

  std::shared_ptr<detail::RawWriter> raw_;
};

/// A process's place on its site's bus: typed topics, one event loop, one clock. Implementations:
/// DdsBus (common/bus/dds), and the buses of a simulated network (common/bus/simulated).
///
/// Handlers and timers run in the loop, on the thread that calls run_*: they need no locks and must not
/// block. Readers, writers and timers may be added at any time, also from a handler. All functions
/// except post() and the clock may be called on the loop's thread only.
class Bus {
 public:
  Bus() = default;
  virtual ~Bus();
  Bus(const Bus&) = delete;
  Bus& operator=(const Bus&) = delete;

  /// `strength`: of this writer on topics with exclusive ownership. Each call makes one writer.
  template <class Topic>
  Writer<Topic> writer(int strength = 0) {
    return Writer<Topic>(raw_writer(Topic::kName, strength));
  }

  /// Calls `handler` for each sample, disposal and loss of writers, in order of arrival within a key. Handlers of one
  /// topic share a reader.
  template <class Topic>
  void on(std::function<void(const typename Topic::Sample&, const SampleInfo&)> handler) {
    raw_on(Topic::kName, [handler = std::move(handler)](const void* sample, const SampleInfo& info) {
      handler(*static_cast<const typename Topic::Sample*>(sample), info);
    });
  }

  /// Monotonic: never jumps, says nothing about the date. Ages, periods and leases are differences of it.
  virtual time::Stamp now() const = 0;

  /// Nanoseconds since the Unix epoch, as this host believes: it may jump. For stamps of samples and files.
  virtual std::int64_t wall_clock_ns() const = 0;

  /// Calls `handler` once each `period`, for the first time after one period. A loop that is late skips
  /// ticks, so that they never pile up.
  virtual void every(std::chrono::nanoseconds period, std::function<void()> handler) = 0;

  /// Calls `handler` for each Incident: endpoints that do not fit, lost leases, missed deadlines.
  virtual void on_incident(std::function<void(const Incident&)> handler) = 0;

  /// Runs `work` in the loop, soon. From any thread: for workers that hand back a result.
  virtual void post(std::function<void()> work) = 0;

  /// Waits until something happens, at most `limit`, then handles everything that has come. False when
  /// `limit` passed and nothing came.
  virtual bool run_once(std::chrono::nanoseconds limit) = 0;

  /// Runs the loop until `stop` is true; looks at it after each event and at least every 100 ms.
  void run_until(const std::atomic<bool>& stop);

  /// Writers of others and our own that reach our reader of `topic`; 0 without a reader.
  virtual int matched_writers(const std::string& topic) const = 0;

  /// Our readers and writers, and those of others that discovery has found.
  virtual std::vector<Endpoint> endpoints() const = 0;

  /// The other participants of the domain, in every partition.
  virtual std::vector<Participant> peers() const = 0;

  /// Names of peers().
  std::vector<std::string> participants() const;
  virtual const Settings& settings() const = 0;

 private:
  /// @pre `topic` is in topics.hpp; the same for raw_on()
  virtual std::shared_ptr<detail::RawWriter> raw_writer(const char* topic, int strength) = 0;
  virtual void raw_on(const char* topic, detail::RawHandler handler) = 0;
};

}  // namespace aisle::bus
