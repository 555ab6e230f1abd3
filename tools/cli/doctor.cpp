// aisle doctor: looks for what keeps a fleet from working, and says it in words.

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "common/bus/topics.hpp"
#include "common/process/clock.hpp"
#include "common/process/exit_code.hpp"
#include "common/service/hear.hpp"
#include "common/service/peer_watch.hpp"
#include "common/service/versions.hpp"
#include "tools/cli/cli.hpp"
#include "tools/cli/diagnosis.hpp"
#include "tools/cli/json.hpp"
#include "tools/cli/network_probe.hpp"
#include "tools/cli/shared_memory_probe.hpp"
#include "tools/cli/text.hpp"

namespace aisle::cli {
namespace {

constexpr int kLastDomainToScan = 20;
constexpr int kDomainsAtOnce = 7;
constexpr Seconds kScan{1.0};

/// Everything that the site says within the time of looking.
class Examination {
 public:
  explicit Examination(const Cli& cli) : bus_(join(cli, "aisle-doctor")) {
    using service::Sender;
    service::hear<topics::ServiceHealth>(
        *bus_, {[this](const fleet::ServiceHealth& health, const Sender& from) { take(health, from); },
                [this](const std::string& id, service::End) { lose(id); },
                {}});

    service::hear<topics::VehicleState>(
        *bus_,
        {[this](const fleet::VehicleState& state, const Sender& from) { vehicles_.take(state, from.by); }, {}, {}});
  }

  /// Listens for that long.
  void look(Seconds time) {
    run_until(*bus_, time, [] { return false; });
  }

  std::size_t participants() const { return bus_->participants().size(); }
  std::size_t services() const { return health_.size(); }
  std::size_t vehicles() const { return vehicles_.vehicles(); }

  /// Everything that does not fit, of all that was heard.
  std::vector<Problem> problems(const bus::Settings& settings) const {
    std::vector<bus::Endpoint> others = bus_->endpoints();
    const std::string& own_name = bus_->settings().participant_name;

    others.erase(std::remove_if(others.begin(), others.end(),
                                [&](const bus::Endpoint& end) { return end.participant == own_name; }),
                 others.end());

    std::vector<Problem> all = judge_endpoints(settings, others);
    for (const service::Finding& finding : findings_) all.push_back({about(finding.kind), finding.text});
    for (Problem& problem : judge_services(health_, gone_)) all.push_back(std::move(problem));
    for (Problem& problem : vehicles_.judge()) all.push_back(std::move(problem));

    return all;
  }

 private:
  /// The word under which doctor reports it.
  static std::string about(service::Finding::Kind kind) {
    switch (kind) {
      case service::Finding::Kind::kClockSkew:
        return "clock";
      case service::Finding::Kind::kOtherIdlVersion:
        return "version";
      default:
        return "service";
    }
  }

  /// A service that said goodbye is no problem; one that fell silent is.
  void lose(const std::string& id) {
    const auto known = health_.find(id);
    const bool said_goodbye = known == health_.end() || known->second.state == fleet::ServiceState::kStopping;

    if (said_goodbye) {
      health_.erase(id);
    } else {
      gone_.insert(id);
    }
  }

  /// A service that speaks again is not gone.
  void take(const fleet::ServiceHealth& health, const service::Sender& from) {
    gone_.erase(health.instance_id);
    health_[health.instance_id] = health;

    const service::PeerHealth peer{health.instance_id,   health.host,
                                   health.process_id,    from.by.boot_id,
                                   health.idl_version,   health.software_version,
                                   health.wall_clock_ns, health.state == fleet::ServiceState::kStopping};
    for (service::Finding& finding : peers_.take(peer, bus_->now(), process::wall_clock_ns()))
      findings_.push_back(std::move(finding));
  }

  service::PeerWatch peers_{"", 0, service::kIdlVersion};
  std::map<std::string, fleet::ServiceHealth> health_;
  std::set<std::string> gone_;
  std::vector<service::Finding> findings_;
  VehicleWatch vehicles_;
  std::unique_ptr<bus::Bus> bus_;
};

/// Other domains in which a participant was seen.
std::set<int> scan_domains(const Cli& cli) {
  std::set<int> found;
  for (int first = 0; first <= kLastDomainToScan && !is_interrupted(); first += kDomainsAtOnce) {
    std::map<int, std::unique_ptr<bus::Bus>> buses;
    for (int domain = first; domain < first + kDomainsAtOnce && domain <= kLastDomainToScan; ++domain) {
      Cli there;
      there.settings = cli.settings;
      there.settings.domain = domain;
      if (domain != cli.settings.domain) buses[domain] = join(there, "aisle-doctor");
    }

    if (buses.empty()) continue;

    run_until(*buses.begin()->second, kScan, [] { return false; });

    for (const auto& [domain, bus] : buses) {
      if (!bus->participants().empty()) found.insert(domain);
    }
  }

  return found;
}

/// Looks at this host first, then at the site, and at other domains when nothing is there.
int doctor(const Cli& cli, double wait_s) {
  std::vector<Problem> problems = judge_network(cli.settings, probe_interfaces());
  if (cli.settings.shared_memory) {
    for (Problem& problem : judge_shared_memory(cli.settings, probe_shared_memory()))
      problems.push_back(std::move(problem));
  }

  // The site: everything that is said for a while.
  Examination examination(cli);
  examination.look(Seconds(wait_s));

  const std::set<int> other_domains =
      examination.participants() == 0 && cli.settings.discovery_server.empty() ? scan_domains(cli) : std::set<int>{};
  for (Problem& problem : judge_discovery(cli.settings, examination.participants(), other_domains))
    problems.push_back(std::move(problem));

  for (Problem& problem : examination.problems(cli.settings)) problems.push_back(std::move(problem));

  // What was over before it was seen is no reason for a bad exit code.
  const bool is_well =
      std::all_of(problems.begin(), problems.end(), [](const Problem& problem) { return problem.is_past; });
  const std::string seen = fmt::format("{} other processes, {} services, {} vehicles", examination.participants(),
                                       examination.services(), examination.vehicles());

  if (cli.json) {
    Json list = Json::array();
    for (const Problem& problem : problems)
      list.push_back({{"about", problem.about}, {"text", problem.text}, {"past", problem.is_past}});

    std::printf("%s\n", write_json(Json{{"place", place_of(cli.settings)},
                                        {"participants", examination.participants()},
                                        {"services", examination.services()},
                                        {"vehicles", examination.vehicles()},
                                        {"problems", std::move(list)}})
                            .c_str());
  } else {
    std::printf("looked in %s for %g s: %s\n", place_of(cli.settings).c_str(), wait_s, seen.c_str());

    for (const Problem& problem : problems)
      std::printf("%s%s: %s\n", problem.is_past ? "note: " : "", problem.about.c_str(),
                  printable(problem.text).c_str());

    if (is_well) std::printf("nothing wrong\n");
  }

  return is_well ? process::kDone : process::kNegative;
}

}  // namespace

void add_doctor(CLI::App& parent, Cli& cli) {
  auto wait_s = std::make_shared<double>(4.0);
  Verb(parent, cli, "doctor", "look for what keeps the fleet from working; exit code 1 when something is wrong")
      .option("--wait", *wait_s, 0.5, 3600.0, "seconds to look; clocks need 3")
      .runs([&cli, wait_s] { return doctor(cli, *wait_s); });
}

}  // namespace aisle::cli
