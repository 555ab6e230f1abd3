#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

#include "common/bus/bus.hpp"
#include "common/service/health.hpp"
#include "common/service/inbox.hpp"
#include "common/service/map_client.hpp"
#include "common/service/outbox.hpp"
#include "common/time/stamp.hpp"

namespace spdlog {
class logger;
}

namespace aisle::service {

/// The identity under which a service speaks on the bus.
struct Identity {
  std::string service;       // "global-planner"
  std::string instance_id;   // unique on the site, "local-planner-agv-1"
  std::string agv_id;        // of a service for one vehicle, else empty
  std::uint64_t boot_id{0};  // of this start; a later start has a higher one
  std::string host;          // for people
  std::uint32_t process_id{0};
};

/// What a shell gets from the process around it; in a simulation all of it is missing.
struct Surroundings {
  /// Of this shell's share of the process.
  struct Usage {
    double cpu_percent{0.0};  // of one core, since the call before
    double resident_mb{0.0};
  };

  std::shared_ptr<spdlog::logger> log;              // none: the default logger's sinks, named after the instance
  std::function<Usage()> usage;                     // none: zeros
  std::function<void(const Health&)> on_published;  // after each `service_health`
};

/// What a service stands in: its inboxes and outboxes, timers, log lines and health. Needs a bus and an identity, no
/// command line, no signals: see run_service.hpp for those. Everything happens in the loop of the bus.
///
///   MapService::MapService(service::Shell& shell, ...) : info_(shell.outbox<topics::MapInfo>()) {
///     shell.inbox<topics::MapEdit>([this](const grid::MapEdit& edit, const service::Sender& from) { ... });
///     shell.every(1s, [this] { ... });
///     shell.report([this](service::Health& health) { if (...) health.wait_for("vehicle_info"); });
///   }
///
/// `service_health` goes out once a second, soon after state, waits_for or last_error change, and its 2 s manual lease
/// is asserted every 500 ms from the loop, so that a hang shows.
///
/// Several shells may stand on one bus, one for each vehicle of a process. They share readers, decoding and the map,
/// and nothing else: when a handler of one of them throws, that one falls silent, with its health degraded, and the
/// others go on. Alone, or the last, it lets the exception pass: the process ends.
///
/// Keep the shell and its service as long as the bus runs.
class Shell final : private detail::InboxOwner, private detail::OutboxOwner {
 public:
  /// The first shell on this bus. @pre `bus` outlives it
  Shell(bus::Bus& bus, Identity identity, Surroundings surroundings = {});

  /// On the bus of `first`, which must live as long.
  Shell(Shell& first, Identity identity, Surroundings surroundings = {});
  ~Shell() override;
  Shell(const Shell&) = delete;
  Shell& operator=(const Shell&) = delete;

  /// As given to the constructor.
  const Identity& identity() const;
  const std::string& instance_id() const { return identity().instance_id; }
  const std::string& agv_id() const { return identity().agv_id; }
  std::uint64_t boot_id() const { return identity().boot_id; }
  bus::Bus& bus();

  /// The bus's monotonic clock: what cores get as `now`.
  time::Stamp now() const;

  /// Nanoseconds since the Unix epoch, of the bus's wall clock. May jump: for stamps and files, never for ages.
  std::int64_t wall_clock_ns() const;

  /// Calls `handler(value)` or `handler(value, sender)` for each sample that its codec accepts. What it refuses is
  /// counted as `dropped_<topic>` and warned of. What an instance's end means is on_gone()'s; by default, nothing.
  template <class Topic, class Handler>
  Inbox<Topic> inbox(Handler handler) {
    detail::Subscription<Topic> subscription{*this, {}, {}, {}};
    if constexpr (std::is_invocable_v<Handler, const ValueOf<Topic>&, const Sender&>) {
      subscription.take = std::move(handler);
    } else {
      subscription.take = [handler = std::move(handler)](const ValueOf<Topic>& value, const Sender&) mutable {
        handler(value);
      };
    }

    return {bus(), channel<Topic>().add(std::move(subscription))};
  }

  /// Writes values of the topic; see Outbox.
  template <class Topic>
  Outbox<Topic> outbox() {
    return {bus(), *this};
  }

  /// The site's map, one for all shells of a process that want the same of it. Its id, revision and hash are in the
  /// health from then on. `on_map`, `on_zones`: see MapClient::on_map() and on_zones().
  MapClient& map(const MapClient::Options& options, MapClient::OnMap on_map = {}, MapClient::OnZones on_zones = {});

  /// Calls `work` once each `period`, for the first time after one period. A loop that is late skips
  /// ticks.
  void every(std::chrono::nanoseconds period, std::function<void()> work);

  /// Runs `work` in the loop, soon. May be called from any thread.
  void post(std::function<void()> work);

  /// A function that posts `work`; several calls before it ran count as one.
  std::function<void()> soon(std::function<void()> work);

  /// `fill` is called four times a second, with waits_for empty and is_degraded false: it says what the service waits
  /// for and sets its counters. The state follows: degraded, else waiting, else ready.
  void report(std::function<void(Health&)> fill);

  /// Reports and publishes what changed at once, not at the next quarter of a second.
  void report_now();

  /// To set counters and last_error at any time.
  Health& health();
  void count(const std::string& name, std::uint64_t by = 1) { health().count(name, by); }

  /// Lines carry this instance's name, also when several share the process.
  spdlog::logger& log() const;

  /// At most one line in ten seconds for each `kind`; it says how many were kept back.
  void warn(const std::string& kind, const std::string& text);

  /// Publishes when state, waits_for or last_error changed since the last time.
  void publish_changes();

  /// Publishes its last word: ServiceState::kStopping.
  void say_goodbye();

  /// Waits until the last word was acknowledged, at most until `latest` on the bus's clock. Of several
  /// shells, all say goodbye before one waits.
  void wait_for_goodbye(time::Stamp latest);

  /// Did a handler throw? Then this shell is silent.
  bool has_failed() const;

  /// Is this the only shell on its bus?
  bool is_alone() const;

 private:
  struct State;

  /// What the shells of one bus share.
  struct Shared;

  /// Starts its own inbox, reports and timers.
  void begin();

  /// The topic's channel on this bus, made at its first use.
  template <class Topic>
  detail::Channel<Topic>& channel() {
    std::shared_ptr<void>& slot = channel_slot(Topic::kName);
    if (!slot) slot = std::make_shared<detail::Channel<Topic>>(bus());
    return *static_cast<detail::Channel<Topic>*>(slot.get());
  }

  std::shared_ptr<void>& channel_slot(const std::string& topic);

  void guarded(const std::function<void()>& work) override;
  void note_dropped(const std::string& topic, const std::string& reason) override;
  fleet::Origin origin() override;
  bool may_write() const override;
  void note_not_written(const std::string& topic) override;

  std::unique_ptr<State> state_;
};

}  // namespace aisle::service
