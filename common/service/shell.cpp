#include "common/service/shell.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

#include "common/process/clock.hpp"
#include "common/process/exit_code.hpp"
#include "common/process/leaving.hpp"
#include "common/process/log.hpp"
#include "common/process/memory.hpp"
#include "common/process/own_usage.hpp"
#include "common/process/signals.hpp"
#include "common/process/version.hpp"
#include "common/service/arguments.hpp"
#include "common/service/health_file.hpp"
#include "common/service/peer_watch.hpp"
#include "common/service/site_options.hpp"
#include "common/service/versions.hpp"

namespace aisle::service {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Describe = std::function<void(config::YamlReader&)>;

constexpr std::size_t kMostCounters = 32;
constexpr std::size_t kLongestId = 64;
constexpr milliseconds kHealthPeriod{1000};
constexpr milliseconds kLivelinessPeriod{500};  // of a lease of 2 s
constexpr milliseconds kLongestWait{100};       // until a signal is noticed
constexpr seconds kWarningPeriod{10};
constexpr seconds kTidyPeriod{5};  // a map or a crowd of peers came: what they needed for a moment is given back

thread_local std::vector<Describe>* config_bindings = nullptr;

std::string host_name() {
  char name[65] = {};
  return gethostname(name, sizeof name - 1) == 0 ? name : "unknown";
}

void check_id(const std::string& flag, const std::string& id) {
  const auto is_fit = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '-' || c == '_' || c == '.';
  };
  if (id.empty() || id.size() > kLongestId || !std::all_of(id.begin(), id.end(), is_fit)) {
    throw config::BadInput(flag + ": '" + id + "' is not an id; use 1 to 64 letters, digits, '-', '_' and '.'");
  }
}

/// What every process takes from flags, environment and file.
struct Common {
  bus::Settings settings;
  std::string config_file;
  std::string instance_id;
  std::string agv_id;
  std::string log_level{"info"};
  std::string health_file;

  template <class Reader>
  void describe(Reader& r) {
    SiteConfig site{settings};
    r.field("instance", instance_id)
        .field("log_level", log_level)
        .field("health_file", health_file)
        .section("site", site);
  }
};

void add_common_options(CLI::App& app, const Shell::About& about, Common& common) {
  app.set_version_flag("--version", "aisle-" + about.service + " " + process::software_version() + " (IDL " +
                                        std::to_string(kIdlVersion) + ", Fast DDS " +
                                        std::to_string(AISLE_FASTDDS_MAJOR) + ")");
  app.add_option("--config", common.config_file, "YAML file; flags and environment win over it")
      ->envname("AISLE_CONFIG");
  app.add_option("--instance", common.instance_id, "name of this process, unique on the site")
      ->envname("AISLE_INSTANCE");
  app.add_option("--log-level", common.log_level, "debug, info, warning, error or off")->envname("AISLE_LOG_LEVEL");
  app.add_option("--health-file", common.health_file,
                 "keeps the last word on service_health there, for `aisle health --file`")
      ->envname("AISLE_HEALTH_FILE");
  if (!about.agv_id_flag.empty()) {
    app.add_option(about.agv_id_flag, common.agv_id, "id of the vehicle that this process works for")
        ->envname("AISLE_AGV");
  }
  add_site_options(app, common.settings);
}

/// --config (or AISLE_CONFIG) before anything else is parsed, so that flags can win over the file.
std::string find_config_file(int argc, const char* const* argv) {
  CLI::App only_config;
  only_config.set_help_flag();
  only_config.allow_extras();
  std::string file;
  only_config.add_option("--config", file)->envname("AISLE_CONFIG");
  try {
    only_config.parse(argc, argv);
  } catch (const CLI::ParseError&) {
    return {};  // parsed again, and reported, with all the flags
  }
  return file;
}

void read_config(const std::string& file, const Shell::About& about, Common& common,
                 const std::vector<Describe>& bindings) {
  config::YamlReader reader = config::open_yaml_file(file);
  common.describe(reader);
  if (!about.agv_id_flag.empty()) reader.field("agv", common.agv_id);
  for (const Describe& describe : bindings) describe(reader);
  reader.finish();
}

void complete_ids(const Shell::About& about, Common& common) {
  if (!about.agv_id_flag.empty()) {
    if (common.agv_id.empty())
      throw config::BadInput(about.agv_id_flag + " is missing: the id of the vehicle, e.g. agv-1 (or AISLE_AGV)");
    check_id(about.agv_id_flag, common.agv_id);
  }
  if (common.instance_id.empty())
    common.instance_id = about.service + (common.agv_id.empty() ? "" : "-" + common.agv_id);
  check_id("--instance", common.instance_id);
  common.settings.participant_name = common.instance_id;
}

std::string site_text(const bus::Settings& settings) {
  std::string text = "domain " + std::to_string(settings.domain);
  if (!settings.partition.empty()) text += ", partition " + settings.partition;
  for (const std::string& interface : settings.interfaces) text += ", interface " + interface;
  for (const std::string& peer : settings.peers) text += ", peer " + peer;
  if (!settings.discovery_server.empty()) text += ", discovery server " + settings.discovery_server;
  return text;
}

PeerHealth peer_of(const aisle::ServiceHealth& sample) {
  PeerHealth peer;
  peer.instance_id = sample.instance_id().to_string();
  peer.host = sample.host().to_string();
  peer.process_id = sample.process_id();
  peer.boot_id = sample.by().boot_id();
  peer.idl_version = sample.idl_version();
  peer.software_version = sample.software_version().to_string();
  peer.wall_clock_ns = sample.wall_clock_ns();
  peer.is_stopping = sample.state() == ServiceState::SERVICE_STOPPING;
  peer.service = sample.service().to_string();
  peer.agv_id = sample.agv_id().to_string();
  return peer;
}

}  // namespace

void Health::count(const std::string& name, std::uint64_t by) {
  const auto position = counters.find(name);
  if (position != counters.end()) {
    position->second += by;
  } else if (counters.size() < kMostCounters) {
    counters.emplace(name, by);
  }
}

struct Shell::State {
  State(const About& about, const Common& common_settings)
      : service(about.service),
        common(common_settings),
        boot_id(static_cast<std::uint64_t>(process::wall_clock_ns()) / 1000),
        bus(common.settings),
        writer(bus.writer<topics::ServiceHealth>()),
        stamper(common.instance_id, boot_id),
        peers(common.instance_id, boot_id, kIdlVersion, service, common.agv_id),
        warnings(kWarningPeriod) {
    bus.on_incident([this](const bus::Incident& incident) { take(incident); });
    bus.on<topics::ServiceHealth>(
        [this](const aisle::ServiceHealth& sample, const bus::SampleInfo& info) { take(sample, info); });
    bus.every(kHealthPeriod, [this] { publish(); });
    bus.every(kLivelinessPeriod, [this] { writer.assert_liveliness(); });
    bus.every(kTidyPeriod, tidy);
  }

  static void tidy() {
    process::give_back_free_memory();
    process::give_back_unused_code();
  }

  void take(const bus::Incident& incident) {
    health.count("incidents");
    warnings.warn(std::to_string(static_cast<int>(incident.kind)) + incident.topic, incident.text);
    const bool passes_by_itself =
        incident.kind == bus::Incident::Kind::kDeadlineMissed || incident.kind == bus::Incident::Kind::kLivelinessLost;
    if (!passes_by_itself) health.last_error = incident.text;
  }

  void take(const aisle::ServiceHealth& sample, const bus::SampleInfo& info) {
    if (info.kind != bus::SampleKind::kData) return;
    for (const Finding& finding : peers.take(peer_of(sample), process::monotonic_now(), process::wall_clock_ns())) {
      spdlog::warn("{}", finding.text);
      if (finding.kind != Finding::Kind::kClockSkew) health.last_error = finding.text;
    }
  }

  bool has_changed() const {
    return health.state != said.state || health.waits_for != said.waits_for || health.last_error != said.last_error;
  }

  void publish() {
    aisle::ServiceHealth sample;
    sample.instance_id(common.instance_id);
    sample.by(stamper.next());
    sample.service(service);
    sample.software_version(std::string(process::software_version()));
    sample.idl_version(kIdlVersion);
    sample.host(host);
    sample.process_id(static_cast<std::uint32_t>(getpid()));
    sample.agv_id(common.agv_id);
    sample.map_id(health.map_id);
    sample.map_revision(health.map_revision);
    sample.map_hash(health.map_hash);
    sample.state(health.state);
    sample.waits_for(health.waits_for);
    sample.last_error(health.last_error);
    sample.wall_clock_ns(process::wall_clock_ns());
    add_usage(sample);
    for (const auto& [name, value] : health.counters) {
      aisle::Counter counter;
      counter.name(name);
      counter.value(value);
      sample.counters().push_back(counter);
    }
    writer.write(sample);
    said = health;
    keep_health_file(sample.wall_clock_ns());
  }

  void keep_health_file(std::int64_t said_at_ns) {
    if (common.health_file.empty()) return;
    if (!keep(common.health_file, {common.instance_id, said.state, said.waits_for, said.last_error, said_at_ns})) {
      warnings.warn("health_file", "cannot write " + common.health_file + "; a healthcheck that reads it will fail");
    }
  }

  void add_usage(aisle::ServiceHealth& sample) {
    const time::Stamp now = process::monotonic_now();
    if (now - measured_at >= kHealthPeriod / 2) {
      measured_at = now;
      cpu_percent = cpu.percent_since_last(now, process::cpu_time());
    }
    sample.cpu_percent(cpu_percent);
    sample.resident_mb(process::resident_mb());
  }

  void run(const std::atomic<bool>& stop) {
    tidy();  // of what only the start needed
    publish();
    while (!stop.load()) {
      bus.run_once(kLongestWait);
      if (has_changed()) publish();
    }
    spdlog::info("stopped by a signal");
    health.state = ServiceState::SERVICE_STOPPING;
    publish();
    writer.wait_until_acknowledged(milliseconds(200));
    process::take_an_abort_for_the_end();
  }

  std::string service;
  Common common;
  std::uint64_t boot_id;
  std::string host{host_name()};
  bus::Bus bus;
  bus::Writer<topics::ServiceHealth> writer;
  OriginStamper stamper;
  PeerWatch peers;
  process::LimitedWarnings warnings;
  process::CpuMeter cpu;
  time::Stamp measured_at{};
  double cpu_percent{0.0};
  Health health;
  Health said;
};

Shell::Shell(std::unique_ptr<State> state) : state_(std::move(state)) {}
Shell::~Shell() = default;

const std::string& Shell::instance_id() const { return state_->common.instance_id; }
const std::string& Shell::agv_id() const { return state_->common.agv_id; }
std::uint64_t Shell::boot_id() const { return state_->boot_id; }
bus::Bus& Shell::bus() { return state_->bus; }
Health& Shell::health() { return state_->health; }
OriginStamper Shell::stamper() const { return OriginStamper(state_->common.instance_id, state_->boot_id); }
void Shell::run() { state_->run(process::stop_on_signals()); }

void Shell::bind_config(CLI::App&, Describe describe) {
  if (config_bindings != nullptr) config_bindings->push_back(std::move(describe));
}

int run_service(int argc, char** argv, const Shell::About& about, const std::function<void(CLI::App&)>& options,
                const std::function<void(Shell&)>& body) {
  const std::string program = "aisle-" + about.service;
  return process::run_guarded(program, [&]() -> int {
    process::stop_on_signals();
    process::keep_no_large_blocks();
    Common common;
    std::vector<Describe> bindings;
    CLI::App app(about.purpose, program);
    add_common_options(app, about, common);
    config_bindings = &bindings;
    options(app);
    config_bindings = nullptr;
    const std::string config_file = find_config_file(argc, argv);
    if (!config_file.empty()) read_config(config_file, about, common, bindings);
    if (const std::optional<int> code = parse_arguments(app, argc, argv)) return *code;
    complete_ids(about, common);
    process::start_logging(common.instance_id, common.log_level);
    Shell shell(std::make_unique<Shell::State>(about, common));
    spdlog::info("{} {} started on {}", program, process::software_version(), site_text(common.settings));
    body(shell);
    return process::kDone;
  });
}

}  // namespace aisle::service
