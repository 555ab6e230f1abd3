#include "common/service/run_service.hpp"

#include <spdlog/spdlog.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "common/bus/dds/dds_bus.hpp"
#include "common/process/exit_code.hpp"
#include "common/process/leaving.hpp"
#include "common/process/log.hpp"
#include "common/process/memory.hpp"
#include "common/process/own_usage.hpp"
#include "common/process/signals.hpp"
#include "common/process/version.hpp"
#include "common/service/agv_ids.hpp"
#include "common/service/arguments.hpp"
#include "common/service/health_file.hpp"
#include "common/service/site_options.hpp"
#include "common/service/versions.hpp"

namespace aisle::service {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Describe = std::function<void(config::YamlReader&)>;

constexpr milliseconds kUsagePeriod{500};
constexpr milliseconds kLongestWait{100};  // until a signal is noticed
constexpr milliseconds kGoodbye{200};      // for all shells together
constexpr seconds kTidyPeriod{5};  // a map or a crowd of peers came: what they needed for a moment is given back

thread_local std::vector<Describe>* config_bindings = nullptr;

/// At most 64 characters.
std::string host_name() {
  char name[65] = {};
  return gethostname(name, sizeof name - 1) == 0 ? name : "unknown";
}

/// What every process takes from flags, environment and file.
struct Common {
  bus::Settings settings;
  std::string config_file;
  std::string instance_id;
  std::string agv_ids;  // separated by commas
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

/// Flags that every program has.
void add_common_options(CLI::App& app, const About& about, Common& common) {
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
    app.add_option(about.agv_id_flag, common.agv_ids,
                   "id of the vehicle that this process works for; of several: with commas")
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

/// One file for the common keys and those of the program; a key that neither names is an error.
void read_config(const std::string& file, const About& about, Common& common, const std::vector<Describe>& bindings) {
  config::YamlReader reader = config::open_yaml_file(file);
  common.describe(reader);
  if (!about.agv_id_flag.empty()) reader.field("agv", common.agv_ids);
  for (const Describe& describe : bindings) describe(reader);
  reader.finish();
}

/// One identity for each vehicle, or the one of a process without vehicles. @throws config::BadInput
std::vector<Identity> identities_of(const About& about, const Common& common) {
  Identity process;
  process.service = about.service;
  process.host = host_name();
  process.process_id = static_cast<std::uint32_t>(getpid());
  process.instance_id = common.instance_id;
  if (!common.instance_id.empty()) check_id("--instance", common.instance_id);

  if (about.agv_id_flag.empty()) {
    if (process.instance_id.empty()) process.instance_id = about.service;
    return {process};
  }

  // One for each vehicle, named after it.
  const std::vector<std::string> agv_ids = split_ids(about.agv_id_flag, common.agv_ids);
  std::vector<Identity> identities;

  for (const std::string& agv_id : agv_ids) {
    Identity identity = process;
    identity.agv_id = agv_id;

    if (process.instance_id.empty()) {
      identity.instance_id = about.service + "-" + agv_id;
    } else if (agv_ids.size() > 1) {
      identity.instance_id += "-" + agv_id;
    }

    check_id("--instance", identity.instance_id);
    identities.push_back(identity);
  }

  return identities;
}

/// Of the process, for its own log lines, its participant and its health file.
std::string process_name(const About& about, const Common& common, const std::vector<Identity>& identities) {
  if (identities.size() == 1) return identities.front().instance_id;
  return common.instance_id.empty() ? about.service : common.instance_id;
}

/// For the line that is logged at the start.
std::string site_text(const bus::Settings& settings) {
  std::string text = "domain " + std::to_string(settings.domain);
  if (!settings.partition.empty()) text += ", partition " + settings.partition;
  for (const std::string& interface : settings.interfaces) text += ", interface " + interface;
  for (const std::string& peer : settings.peers) text += ", peer " + peer;
  if (!settings.discovery_server.empty()) text += ", discovery server " + settings.discovery_server;

  return text;
}

/// Returns memory to the system, see common/process/memory.hpp.
void tidy() {
  process::give_back_free_memory();
  process::give_back_unused_code();
}

}  // namespace

/// The bus with one shell for each identity, the loop, and the health file.
struct Process::State {
  /// The first shell makes what all share; the others stand on it.
  State(const About& about, const Common& common_options, const std::vector<Identity>& identities)
      : common(common_options), name(process_name(about, common, identities)), bus(settings_of(common, name)) {
    for (Identity identity : identities) {
      identity.boot_id = static_cast<std::uint64_t>(bus.wall_clock_ns()) / 1000;

      const std::size_t index = shells.size();
      notes.push_back({identity.instance_id, fleet::ServiceState::kStarting, "", "", 0});

      const Surroundings surroundings{nullptr, [this] { return usage(); },
                                      [this, index](const Health& health) { keep_health_file(index, health); }};
      shells.push_back(shells.empty() ? std::make_unique<Shell>(bus, identity, surroundings)
                                      : std::make_unique<Shell>(*shells.front(), identity, surroundings));
    }

    bus.every(kTidyPeriod, tidy);
  }

  static bus::Settings settings_of(const Common& common, const std::string& name) {
    bus::Settings settings = common.settings;
    settings.participant_name = name;
    return settings;
  }

  /// An equal share for each shell, so that the rows of `service_health` add up to the process.
  Surroundings::Usage usage() {
    const time::Stamp now = bus.now();
    if (now - measured_at >= kUsagePeriod) {
      measured_at = now;
      cpu_percent = cpu.percent_since_last(now, process::cpu_time());
    }

    const auto sharers = static_cast<double>(std::max<std::size_t>(shells.size(), 1));
    return {cpu_percent / sharers, process::resident_mb() / sharers};
  }

  /// The file has one row: of several shells, that of the first that is not ready.
  void keep_health_file(std::size_t index, const Health& health) {
    if (common.health_file.empty()) return;

    HealthNote& own = notes[index];
    own = {own.instance_id, health.state, health.waits_for, health.last_error, health.wall_clock_ns};

    const auto unready = std::find_if(notes.begin(), notes.end(),
                                      [](const HealthNote& note) { return note.state != fleet::ServiceState::kReady; });
    HealthNote note = unready == notes.end() ? own : *unready;

    if (notes.size() > 1 && !note.waits_for.empty()) note.waits_for = note.instance_id + ": " + note.waits_for;
    note.instance_id = name;
    note.wall_clock_ns = health.wall_clock_ns;

    if (keep(common.health_file, note)) return;

    shells[index]->warn("health_file",
                        "cannot write " + common.health_file + "; a healthcheck that reads it will fail");
  }

  /// Until a signal: then all shells say goodbye, and it is waited a little until that was heard.
  void run(const std::atomic<bool>& stop) {
    tidy();  // of what only the start needed

    while (!stop.load()) {
      bus.run_once(kLongestWait);
      for (const auto& shell : shells) shell->publish_changes();
    }

    spdlog::info("stopped by a signal");
    for (const auto& shell : shells) shell->say_goodbye();

    const time::Stamp latest = bus.now() + kGoodbye;
    for (const auto& shell : shells) shell->wait_for_goodbye(latest);
    process::take_an_abort_for_the_end();
  }

  Common common;
  std::string name;
  bus::DdsBus bus;
  std::vector<std::unique_ptr<Shell>> shells;
  std::vector<HealthNote> notes;  // one for each shell
  process::CpuMeter cpu;
  time::Stamp measured_at{};
  double cpu_percent{0.0};
};

Process::Process(std::unique_ptr<State> state) : state_(std::move(state)) {}
Process::~Process() = default;
bus::Bus& Process::bus() { return state_->bus; }
const std::vector<std::unique_ptr<Shell>>& Process::shells() const { return state_->shells; }
void Process::run() { state_->run(process::stop_on_signals()); }

void bind_config(Describe describe) {
  if (config_bindings != nullptr) config_bindings->push_back(std::move(describe));
}

/// The order matters: flags are declared, then the file is read, then flags and environment are parsed
/// over it.
int run_process(int argc, char** argv, const About& about, const std::function<void(CLI::App&)>& options,
                const std::function<void(Process&)>& body) {
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

    const std::vector<Identity> identities = identities_of(about, common);
    process::start_logging(process_name(about, common, identities), common.log_level);

    Process process(std::make_unique<Process::State>(about, common, identities));
    spdlog::info("{} {} started on {}", program, process::software_version(), site_text(common.settings));
    body(process);

    return process::kDone;
  });
}

}  // namespace aisle::service
