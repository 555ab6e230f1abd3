#include "tools/cli/diagnosis.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/cli/cli.hpp"
#include "tools/cli/text.hpp"

namespace aisle::cli {
namespace {

/// The endpoint for a person: role, participant, host.
std::string who(const bus::Endpoint& endpoint) {
  return fmt::format("{} in '{}' on host {}", endpoint.is_writer ? "writer" : "reader",
                     endpoint.participant.empty() ? "?" : endpoint.participant,
                     endpoint.host.empty() ? "?" : endpoint.host);
}

/// Everything that is announced; the depth of the history is not.
bool same_contract(const bus::Qos& a, const bus::Qos& b) {
  return a.reliability == b.reliability && a.durability == b.durability && a.ownership == b.ownership &&
         a.deadline == b.deadline && a.liveliness_lease == b.liveliness_lease;
}

/// No partitions: the default one, whose name is empty.
bool is_in(const std::string& partition, const std::vector<std::string>& partitions) {
  if (partitions.empty()) return partition.empty();
  return std::find(partitions.begin(), partitions.end(), partition) != partitions.end();
}

constexpr std::uint64_t kProcessesWithRoom = 4;  // less is soon too little

std::string quoted(const std::string& text) { return "'" + text + "'"; }

}  // namespace

/// Nothing is wrong as soon as one other process is seen.
std::vector<Problem> judge_discovery(const bus::Settings& settings, std::size_t participants,
                                     const std::set<int>& other_domains) {
  if (participants > 0) return {};

  std::string text = "nobody seen in " + place_of(settings) + "; ";
  if (!other_domains.empty()) {
    std::string domains;
    for (const int domain : other_domains) domains += (domains.empty() ? "" : ", ") + std::to_string(domain);
    text += "but somebody is in domain " + domains + ": use --domain or AISLE_DOMAIN";
  } else if (!settings.discovery_server.empty()) {
    text +=
        "check that the discovery server runs at " + settings.discovery_server + " and that the services use it too";
  } else {
    text +=
        "nor in domains 0 to 20. Is a service running? On another host without multicast, name it with --peer ADDRESS "
        "(both sides) or use "
        "--discovery-server ADDRESS:PORT";
  }

  return {{"discovery", text}};
}

std::vector<Problem> judge_network(const bus::Settings& settings, const std::vector<NetworkInterface>& interfaces) {
  std::vector<Problem> problems;
  std::string known;

  for (const NetworkInterface& interface : interfaces)
    known += (known.empty() ? "" : ", ") + interface.address + " (" + interface.name + ")";

  // Addresses that were asked for and are not there.
  for (const std::string& address : settings.interfaces) {
    const bool is_ours =
        std::any_of(interfaces.begin(), interfaces.end(), [&](const auto& i) { return i.address == address; });
    if (!is_ours)
      problems.push_back({"network", "no interface of this host has the address " + address + "; it has " + known});
  }

  // Interfaces on which discovery needs multicast.
  const bool needs_multicast = settings.peers.empty() && settings.discovery_server.empty();
  for (const NetworkInterface& interface : interfaces) {
    const bool is_used = settings.interfaces.empty() ? !interface.is_loopback
                                                     : std::find(settings.interfaces.begin(), settings.interfaces.end(),
                                                                 interface.address) != settings.interfaces.end();
    if (needs_multicast && is_used && !interface.multicast_works) {
      problems.push_back(
          {"network",
           fmt::format(
               "multicast does not work on {} ({}): services there are not found; use --peer ADDRESS on both sides, "
               "or --discovery-server ADDRESS:PORT",
               interface.address, interface.name)});
    }
  }

  return problems;
}

std::vector<Problem> judge_shared_memory(const bus::Settings& settings, const SharedMemory& memory) {
  if (!settings.shared_memory) return {};

  const std::string remedy = "or leave --shared-memory away: UDP works without it";
  const auto problem = [](const std::string& text) { return std::vector<Problem>{{"shared memory", text}}; };
  if (!memory.exists) return problem("there is no " + memory.folder + " on this host; mount a tmpfs there, " + remedy);
  if (!memory.is_writable)
    return problem(memory.folder + " cannot be written by this user; correct its mode (1777), " + remedy);

  std::vector<Problem> problems;
  const auto mb = [](std::uint64_t bytes) { return fmt::format("{:.0f} MB", static_cast<double>(bytes) / 1048576.0); };

  if (memory.available_bytes < kProcessesWithRoom * bus::kSharedMemoryBytes) {
    problems.push_back(
        {"shared memory",
         fmt::format("{} has {} of {} left; each process takes {}, and a process that finds less dies at its start: "
                     "enlarge it (docker: --shm-size 1g; else mount -o remount,size=1g {}), {}",
                     memory.folder, mb(memory.available_bytes), mb(memory.capacity_bytes), mb(bus::kSharedMemoryBytes),
                     memory.folder, remedy)});
  }

  if (memory.left_over_files > 0) {
    problems.push_back(
        {"shared memory",
         fmt::format("{} holds {} segments ({}) of processes that were killed; remove them with: fastdds shm clean",
                     memory.folder, memory.left_over_files, mb(memory.left_over_bytes))});
  }

  return problems;
}

/// Endpoints in other partitions are reported only when nobody is in ours.
std::vector<Problem> judge_endpoints(const bus::Settings& settings, const std::vector<bus::Endpoint>& endpoints) {
  std::vector<Problem> problems;
  std::set<std::string> other_partitions;
  bool is_anybody_in_ours = false;

  for (const bus::Endpoint& endpoint : endpoints) {
    const auto topic = std::find_if(topic_table().begin(), topic_table().end(),
                                    [&](const TopicRow& row) { return row.name == endpoint.topic; });
    if (topic == topic_table().end()) continue;

    if (endpoint.type != topic->type) {
      problems.push_back(
          {"type", fmt::format("topic '{}': the {} uses the type {}, Aisle {}; it hears and says nothing here",
                               topic->name, who(endpoint), endpoint.type, topic->type)});
    } else if (!is_in(settings.partition, endpoint.partitions)) {
      other_partitions.insert(endpoint.partitions.empty() ? "" : endpoint.partitions.front());
      continue;
    } else if (!same_contract(endpoint.qos, topic->qos)) {
      problems.push_back({"qos", fmt::format("topic '{}': the {} has other QoS: {}; Aisle has: {}", topic->name,
                                             who(endpoint), text_of(endpoint.qos, History::kNotAnnounced),
                                             text_of(topic->qos, History::kNotAnnounced))});
    }

    is_anybody_in_ours = true;
  }

  // Only other partitions are used.
  if (!is_anybody_in_ours && !other_partitions.empty()) {
    std::string names;
    for (const std::string& name : other_partitions) names += (names.empty() ? "" : ", ") + quoted(name);
    problems.push_back({"partition", "nobody uses partition " + quoted(settings.partition) + "; others use " + names +
                                         ": set --partition or AISLE_PARTITION"});
  }

  return problems;
}

/// What a service waits for is the most useful word about it.
std::vector<Problem> judge_services(const std::map<std::string, fleet::ServiceHealth>& newest,
                                    const std::set<std::string>& gone) {
  std::vector<Problem> problems;
  for (const auto& [id, health] : newest) {
    const std::string waits_for = health.waits_for;
    const std::string last_error = health.last_error;

    if (gone.count(id) > 0) {
      problems.push_back(
          {"service", id + " on host " + health.host + " has fallen silent: it crashed, hangs, or cannot be reached"});
    } else if (health.state != fleet::ServiceState::kReady) {
      problems.push_back({"service", id + " is " + name(health.state) +
                                         (waits_for.empty() ? "" : ", waits for " + waits_for) +
                                         (last_error.empty() ? "" : "; last error: " + last_error)});
    } else if (!last_error.empty()) {
      problems.push_back({"service", id + " is ready, but had an error: " + last_error, true});
    }
  }

  return problems;
}

void VehicleWatch::take(const fleet::VehicleState& state, const fleet::Origin& by) {
  Writer& writer = writers_[state.agv_id][by.boot_id];
  writer.source_id = by.source_id;
  ++writer.samples;

  const bool is_held = state.hold != fleet::Hold::kNone && state.hold != fleet::Hold::kNoCommand;
  holds_[state.agv_id] = is_held ? word_of(name(state.hold)) : "";
}

/// Several starts that each wrote more than one sample are several processes.
std::vector<Problem> VehicleWatch::judge() const {
  std::vector<Problem> problems;
  for (const auto& [agv_id, writers] : writers_) {
    std::string sources;
    int speaking = 0;

    for (const auto& [boot_id, writer] : writers) {
      if (writer.samples < 2) continue;  // one sample may be the last of a process that was restarted
      sources += (speaking == 0 ? "" : " and ") + writer.source_id + fmt::format(" (boot {})", boot_id);
      ++speaking;
    }

    if (speaking > 1)
      problems.push_back(
          {"vehicle", "two vehicles call themselves '" + agv_id + "': " + sources + "; give one another id"});
  }

  for (const auto& [agv_id, hold] : holds_) {
    if (!hold.empty()) problems.push_back({"vehicle", agv_id + " holds: " + hold});
  }

  return problems;
}

}  // namespace aisle::cli
