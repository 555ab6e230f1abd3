#include "common/service/shell.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <exception>
#include <string_view>
#include <vector>

#include "common/process/log.hpp"
#include "common/process/version.hpp"
#include "common/service/peer_watch.hpp"
#include "common/service/versions.hpp"

namespace aisle::service {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr milliseconds kHealthPeriod{1000};
constexpr milliseconds kReportPeriod{250};
constexpr milliseconds kLivelinessPeriod{500};  // of a lease of 2 s
constexpr seconds kWarningPeriod{10};

/// The part that PeerWatch judges.
PeerHealth peer_of(const fleet::ServiceHealth& health, const Sender& from) {
  PeerHealth peer;
  peer.instance_id = health.instance_id;
  peer.host = health.host;
  peer.process_id = health.process_id;

  peer.boot_id = from.by.boot_id;
  peer.idl_version = health.idl_version;
  peer.software_version = health.software_version;

  peer.wall_clock_ns = health.wall_clock_ns;
  peer.is_stopping = health.state == fleet::ServiceState::kStopping;

  peer.service = health.service;
  peer.agv_id = health.agv_id;

  return peer;
}

/// The part that stays the same.
Health health_of(const Identity& identity) {
  Health health;
  health.instance_id = identity.instance_id;
  health.service = identity.service;

  health.software_version = process::software_version();
  health.idl_version = kIdlVersion;

  health.host = identity.host;
  health.process_id = identity.process_id;
  health.agv_id = identity.agv_id;

  return health;
}

}  // namespace

struct Shell::Shared {
  explicit Shared(bus::Bus& of) : bus(of) {}

  bool only_failed_are_left() const;
  void start();

  /// Of what all shells of the process notice alike, one logs: the first that noticed something of this kind, until it
  /// fails or is gone.
  bool logs(const std::string& kind, State& shell);

  bus::Bus& bus;
  std::vector<State*> shells;
  std::map<std::string, std::shared_ptr<void>> channels;  // by topic
  std::map<std::string, State*> loggers;                  // by kind of what is logged
  std::vector<std::pair<MapClient::Options, std::unique_ptr<MapClient>>> maps;
};

/// What one shell has of its own; see Shared for the rest.
struct Shell::State {
  State(std::shared_ptr<Shared> with, Identity who, Surroundings around)
      : shared(std::move(with)),
        identity(std::move(who)),
        surroundings(std::move(around)),
        log(surroundings.log ? surroundings.log : spdlog::default_logger()->clone(identity.instance_id)),
        writer(shared->bus.writer<topics::ServiceHealth>()),
        peers(identity.instance_id, identity.boot_id, kIdlVersion, identity.service, identity.agv_id),
        warnings(kWarningPeriod),
        health(health_of(identity)) {}

  time::Stamp now() const { return shared->bus.now(); }
  std::int64_t wall_clock_ns() const { return shared->bus.wall_clock_ns(); }

  /// At most one line of a kind in kWarningPeriod.
  void warn(const std::string& kind, const std::string& text) {
    const process::RateLimit::Pass pass = warnings.ask(kind, now());
    if (!pass.allowed) return;

    if (pass.kept_back == 0) {
      log->warn("{}", text);
    } else {
      log->warn("{} (and {} more)", text, pass.kept_back);
    }
  }

  /// Counted by every shell, logged by one: the bus is the same.
  void take(const bus::Incident& incident) {
    health.count("incidents");

    if (shared->logs("incident", *this))
      warn(std::to_string(static_cast<int>(incident.kind)) + incident.topic, incident.text);

    const bool passes_by_itself =
        incident.kind == bus::Incident::Kind::kDeadlineMissed || incident.kind == bus::Incident::Kind::kLivelinessLost;
    if (!passes_by_itself) health.last_error = incident.text;
  }

  /// Contradictions with other processes become warnings; all but a clock that is off also last_error.
  void take(const PeerHealth& peer) {
    for (const Finding& finding : peers.take(peer, now(), wall_clock_ns())) {
      const bool concerns_this_shell =
          finding.kind == Finding::Kind::kDuplicateVehicle || finding.instance_id == identity.instance_id;
      if (concerns_this_shell || shared->logs("peer", *this)) log->warn("{}", finding.text);

      if (finding.kind != Finding::Kind::kClockSkew) health.last_error = finding.text;
    }
  }

  fleet::Origin origin() const { return {identity.instance_id, identity.boot_id, 1, 0, wall_clock_ns()}; }

  /// Asks the service how it is.
  void fill_report() {
    if (map != nullptr) health.tell_map(map->map_id(), map->revision(), map->hash());

    if (!fill || has_failed) return;

    health.waits_for.clear();
    health.is_degraded = false;
    fill(health);

    health.state = health.is_degraded         ? fleet::ServiceState::kDegraded
                   : health.waits_for.empty() ? fleet::ServiceState::kReady
                                              : fleet::ServiceState::kWaiting;
  }

  /// Something that others must hear at once.
  bool has_changed() const {
    return !was_published || health.state != said.state || health.waits_for != said.waits_for ||
           health.last_error != said.last_error;
  }

  /// Writes `service_health` with the newest usage and stamp.
  void publish() {
    const Surroundings::Usage usage = surroundings.usage ? surroundings.usage() : Surroundings::Usage{};
    health.cpu_percent = usage.cpu_percent;
    health.resident_mb = usage.resident_mb;

    fleet::Origin by = origin();
    by.sequence_number = ++sequence_number;
    health.wall_clock_ns = by.stamp_ns;

    aisle::ServiceHealth sample = wire::encode(health);
    wire::stamp(sample, by);
    writer.write(sample);
    said = health;
    was_published = true;
    if (surroundings.on_published) surroundings.on_published(health);
  }

  void publish_changes() {
    if (has_changed()) publish();
  }

  /// Runs where an exception was caught.
  void fail(const std::string& why) {
    has_failed = true;

    if (shared->only_failed_are_left()) throw;

    health.state = fleet::ServiceState::kDegraded;
    health.waits_for.clear();
    health.last_error = "failed: " + why + "; silent until its process is restarted";
    log->error("{}", health.last_error);
    publish();
  }

  /// See Shell: a handler that throws silences this shell and no other.
  void guarded(const std::function<void()>& work) {
    if (has_failed) return;

    try {
      work();
    } catch (const std::exception& error) {
      fail(error.what());
    }
  }

  std::shared_ptr<Shared> shared;
  Identity identity;
  Surroundings surroundings;
  std::shared_ptr<spdlog::logger> log;
  bus::Writer<topics::ServiceHealth> writer;
  std::uint64_t sequence_number{0};
  PeerWatch peers;
  process::RateLimit warnings;
  MapClient* map{nullptr};
  std::function<void(Health&)> fill;
  Health health;
  Health said;
  bool was_published{false};
  bool has_failed{false};
};

bool Shell::Shared::only_failed_are_left() const {
  return std::all_of(shells.begin(), shells.end(), [](const State* shell) { return shell->has_failed; });
}

bool Shell::Shared::logs(const std::string& kind, State& shell) {
  if (shell.has_failed) return false;

  State*& logger = loggers[kind];
  if (logger == nullptr || logger->has_failed) logger = &shell;

  return logger == &shell;
}

/// What is done once a bus, for all its shells.
void Shell::Shared::start() {
  bus.on_incident([this](const bus::Incident& incident) {
    for (State* shell : shells) shell->take(incident);
  });
  bus.every(kLivelinessPeriod, [this] {
    for (State* shell : shells) shell->writer.assert_liveliness();
  });
}

Shell::Shell(bus::Bus& bus, Identity identity, Surroundings surroundings) {
  auto shared = std::make_shared<Shared>(bus);
  state_ = std::make_unique<State>(shared, std::move(identity), std::move(surroundings));
  shared->shells.push_back(state_.get());
  shared->start();
  begin();
}

Shell::Shell(Shell& first, Identity identity, Surroundings surroundings)
    : state_(std::make_unique<State>(first.state_->shared, std::move(identity), std::move(surroundings))) {
  state_->shared->shells.push_back(state_.get());
  begin();
}

Shell::~Shell() {
  std::vector<State*>& shells = state_->shared->shells;
  shells.erase(std::remove(shells.begin(), shells.end(), state_.get()), shells.end());

  for (auto& [kind, logger] : state_->shared->loggers) {
    if (logger == state_.get()) logger = nullptr;
  }
}

void Shell::begin() {
  inbox<topics::ServiceHealth>(
      [this](const fleet::ServiceHealth& health, const Sender& from) { state_->take(peer_of(health, from)); });
  post([this] { report_now(); });  // after the service's constructor
  bus().every(kReportPeriod, [this] { report_now(); });
  bus().every(kHealthPeriod, [this] { state_->publish(); });
}

const Identity& Shell::identity() const { return state_->identity; }
bus::Bus& Shell::bus() { return state_->shared->bus; }
time::Stamp Shell::now() const { return state_->now(); }
std::int64_t Shell::wall_clock_ns() const { return state_->wall_clock_ns(); }
Health& Shell::health() { return state_->health; }
spdlog::logger& Shell::log() const { return *state_->log; }
bool Shell::has_failed() const { return state_->has_failed; }
bool Shell::is_alone() const { return state_->shared->shells.size() == 1; }
void Shell::warn(const std::string& kind, const std::string& text) { state_->warn(kind, text); }

/// Shells that want the same of the map share one client.
MapClient& Shell::map(const MapClient::Options& options, MapClient::OnMap on_map, MapClient::OnZones on_zones) {
  auto& maps = state_->shared->maps;
  auto found = std::find_if(maps.begin(), maps.end(), [&](const auto& entry) { return entry.first == options; });

  if (found == maps.end()) {
    maps.emplace_back(options, std::make_unique<MapClient>(bus(), instance_id(), options));
    found = std::prev(maps.end());
  }

  state_->map = found->second.get();

  if (on_map) {
    state_->map->on_map([this, on_map = std::move(on_map)](
                            const grid::OccupancyGrid& grid, const grid::ClearanceField& clearance, grid::Cell low,
                            grid::Cell high) { guarded([&] { on_map(grid, clearance, low, high); }); });
  }

  if (on_zones) {
    state_->map->on_zones([this, on_zones = std::move(on_zones)](const std::vector<fleet::Zone>& zones) {
      guarded([&] { on_zones(zones); });
    });
  }

  return *found->second;
}

void Shell::every(std::chrono::nanoseconds period, std::function<void()> work) {
  bus().every(period, [this, work = std::move(work)] { guarded(work); });
}

void Shell::post(std::function<void()> work) {
  bus().post([this, work = std::move(work)] { guarded(work); });
}

/// The flag is cleared before the work runs: a call from within it posts again.
std::function<void()> Shell::soon(std::function<void()> work) {
  auto is_posted = std::make_shared<bool>(false);

  auto run = [is_posted, work = std::move(work)] {
    *is_posted = false;
    work();
  };

  return [this, is_posted, run = std::move(run)] {
    if (!std::exchange(*is_posted, true)) post(run);
  };
}

void Shell::report(std::function<void(Health&)> fill) { state_->fill = std::move(fill); }

void Shell::report_now() {
  guarded([this] { state_->fill_report(); });
  state_->publish_changes();
}

void Shell::publish_changes() { state_->publish_changes(); }

void Shell::say_goodbye() {
  state_->health.state = fleet::ServiceState::kStopping;
  state_->publish();
}

void Shell::wait_for_goodbye(time::Stamp latest) {
  const time::Stamp left = std::max(latest - now(), time::Stamp{0});
  state_->writer.wait_until_acknowledged(std::chrono::duration_cast<milliseconds>(left));
}

std::shared_ptr<void>& Shell::channel_slot(const std::string& topic) { return state_->shared->channels[topic]; }

void Shell::guarded(const std::function<void()>& work) { state_->guarded(work); }

void Shell::note_dropped(const std::string& topic, const std::string& reason) {
  count("dropped_" + topic);
  if (state_->shared->logs(topic, *state_)) warn(topic, topic + ": a sample was dropped: " + reason);
}

fleet::Origin Shell::origin() { return state_->origin(); }
bool Shell::may_write() const { return !state_->has_failed; }
void Shell::note_not_written(const std::string& topic) { count(topic + "_not_written"); }

}  // namespace aisle::service
