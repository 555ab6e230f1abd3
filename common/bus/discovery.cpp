#include "common/bus/discovery.hpp"

#include <fnmatch.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <utility>

namespace aisle::bus {
namespace {

template <class Anything>
std::string text_of(const Anything& value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

std::string value_of(const std::string& text, const std::string& key) {
  const std::size_t at = text.find(key + "=");
  if (at == std::string::npos) return {};
  const std::size_t start = at + key.size() + 1;
  return text.substr(start, text.find(';', start) - start);
}

template <class Info>
RemoteEndpoint remote_endpoint(Info info, bool is_writer) {
  RemoteEndpoint seen;
  seen.guid = text_of(fast::guid_of(info));
  seen.participant_prefix = text_of(fast::guid_of(info).guidPrefix);
  seen.topic = fast::topic_of(info);
  seen.type = fast::type_of(info);
  seen.is_writer = is_writer;
  const bool reliable = fast::reliability_of(info).kind == fast::dds::RELIABLE_RELIABILITY_QOS;
  seen.qos.reliability = reliable ? Reliability::kReliable : Reliability::kBestEffort;
  const bool kept = fast::durability_of(info).kind >= fast::dds::TRANSIENT_LOCAL_DURABILITY_QOS;
  seen.qos.durability = kept ? Durability::kTransientLocal : Durability::kVolatile;
  seen.qos.depth = 0;
  seen.qos.deadline = fast::milliseconds(fast::deadline_of(info).period);
  const bool exclusive = fast::ownership_of(info).kind == fast::dds::EXCLUSIVE_OWNERSHIP_QOS;
  seen.qos.ownership = exclusive ? Ownership::kExclusive : Ownership::kShared;
  seen.qos.liveliness_lease = fast::milliseconds(fast::liveliness_of(info).lease_duration);
  seen.manual_liveliness = fast::liveliness_of(info).kind == fast::dds::MANUAL_BY_TOPIC_LIVELINESS_QOS;
  seen.partitions = fast::partition_of(info).getNames();
  return seen;
}

std::string period(std::chrono::milliseconds t) { return t.count() == 0 ? "none" : std::to_string(t.count()) + " ms"; }

/// Is what is offered at least as tight? 0 means infinite.
bool covers(std::chrono::milliseconds offered, std::chrono::milliseconds requested) {
  return requested.count() == 0 || (offered.count() > 0 && offered <= requested);
}

}  // namespace

std::string qos_conflict(const Qos& offered, bool offers_manual_liveliness, const Qos& requested,
                         bool asks_manual_liveliness) {
  if (offered.reliability == Reliability::kBestEffort && requested.reliability == Reliability::kReliable) {
    return "reliability: best effort is offered, reliable is asked for";
  }
  if (offered.durability == Durability::kVolatile && requested.durability == Durability::kTransientLocal) {
    return "durability: volatile is offered, transient local is asked for";
  }
  if (offered.ownership != requested.ownership) {
    const bool exclusive = offered.ownership == Ownership::kExclusive;
    return std::string("ownership: ") + (exclusive ? "exclusive is offered, shared" : "shared is offered, exclusive") +
           " is asked for";
  }
  if (!covers(offered.deadline, requested.deadline)) {
    return "deadline: " + period(offered.deadline) + " is offered, " + period(requested.deadline) + " is asked for";
  }
  if (asks_manual_liveliness && !offers_manual_liveliness) {
    return "liveliness: automatic is offered, manual by topic is asked for";
  }
  if (!covers(offered.liveliness_lease, requested.liveliness_lease)) {
    return "liveliness lease: " + period(offered.liveliness_lease) + " is offered, " +
           period(requested.liveliness_lease) + " is asked for";
  }
  return {};
}

Discovery::Discovery(std::string partition, std::function<void()> wake)
    : partition_(std::move(partition)), wake_(std::move(wake)) {}

void Discovery::writer_seen(fast::WriterInfo info, bool gone) {
  endpoint_seen(remote_endpoint<fast::WriterInfo>(info, true), gone);
}
void Discovery::reader_seen(fast::ReaderInfo info, bool gone) {
  endpoint_seen(remote_endpoint<fast::ReaderInfo>(info, false), gone);
}

void Discovery::endpoint_seen(RemoteEndpoint endpoint, bool gone) {
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (gone) {
      remotes_.erase(endpoint.guid);
      const auto first = reported_.lower_bound(endpoint.guid + " ");
      reported_.erase(first, reported_.lower_bound(endpoint.guid + "!"));
    } else {
      std::string guid = endpoint.guid;
      remotes_[std::move(guid)] = std::move(endpoint);
    }
    changed_ = true;
  }
  wake_();
}

void Discovery::participant_seen(fast::ParticipantInfo info, bool gone) {
  const std::string prefix = text_of(fast::guid_of(info).guidPrefix);
  const std::lock_guard<std::mutex> lock(mutex_);
  if (gone) {
    peers_.erase(prefix);
    for (auto entry = remotes_.begin(); entry != remotes_.end();) {
      entry = entry->second.participant_prefix == prefix ? remotes_.erase(entry) : std::next(entry);
    }
    return;
  }
  const std::string data = fast::user_data_of(info);
  peers_[prefix] = {fast::name_of(info), value_of(data, "host"), std::atoi(value_of(data, "pid").c_str())};
}

void Discovery::add_local(const LocalEndpoint& endpoint) {
  const std::lock_guard<std::mutex> lock(mutex_);
  locals_.push_back(endpoint);
  changed_ = true;
}

std::vector<Incident> Discovery::new_conflicts() {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<Incident> found;
  if (!changed_) return found;
  changed_ = false;
  for (const LocalEndpoint& ours : locals_) {
    for (const auto& [guid, theirs] : remotes_) {
      if (ours.topic == theirs.topic && same_partition(theirs.partitions)) compare(ours, theirs, found);
    }
  }
  return found;
}

void Discovery::compare(const LocalEndpoint& ours, const RemoteEndpoint& theirs, std::vector<Incident>& found) {
  const std::string who = std::string(theirs.is_writer ? "writer " : "reader ") + name_of(theirs.participant_prefix);
  if (ours.type != theirs.type) {
    report(theirs,
           {Incident::Kind::kTypeMismatch, ours.topic,
            ours.topic + ": " + who + " uses type " + theirs.type + ", ours is " + ours.type + "; no samples pass"},
           found);
    return;
  }
  if (ours.is_writer == theirs.is_writer) return;
  const bool ours_manual = ours.qos.liveliness_lease.count() > 0;
  const std::string conflict = ours.is_writer
                                   ? qos_conflict(ours.qos, ours_manual, theirs.qos, theirs.manual_liveliness)
                                   : qos_conflict(theirs.qos, theirs.manual_liveliness, ours.qos, ours_manual);
  if (conflict.empty()) return;
  report(theirs,
         {Incident::Kind::kIncompatibleQos, ours.topic,
          ours.topic + ": " + who + " does not fit our QoS: " + conflict + "; no samples pass"},
         found);
}

void Discovery::report(const RemoteEndpoint& theirs, Incident incident, std::vector<Incident>& found) {
  if (reported_.insert(theirs.guid + " " + incident.text).second) found.push_back(std::move(incident));
}

/// Names may be patterns, on either side; no name is the default partition.
bool Discovery::same_partition(const std::vector<std::string>& theirs) const {
  if (theirs.empty()) return partition_.empty();
  return std::any_of(theirs.begin(), theirs.end(), [&](const std::string& name) {
    return name == partition_ || fnmatch(name.c_str(), partition_.c_str(), 0) == 0 ||
           fnmatch(partition_.c_str(), name.c_str(), 0) == 0;
  });
}

std::string Discovery::name_of(const std::string& prefix) const {
  const auto peer = peers_.find(prefix);
  if (peer == peers_.end()) return "of participant " + prefix;
  const std::string name = peer->second.name.empty() ? "of participant " + prefix : peer->second.name;
  return peer->second.host.empty() ? name : name + " on host " + peer->second.host;
}

std::string Discovery::describe(const std::string& participant_prefix) const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return name_of(participant_prefix);
}

std::vector<Endpoint> Discovery::endpoints() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<Endpoint> all;
  for (const auto& [guid, seen] : remotes_) {
    const auto peer = peers_.find(seen.participant_prefix);
    if (peer == peers_.end()) continue;  // our own: the middleware tells of them too, and Bus lists them
    all.push_back(
        {seen.topic, seen.type, peer->second.name, peer->second.host, seen.is_writer, seen.qos, seen.partitions});
  }
  return all;
}

std::vector<Participant> Discovery::participants() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<Participant> all;
  for (const auto& [prefix, peer] : peers_) all.push_back({peer.name, peer.host, peer.process_id});
  return all;
}

}  // namespace aisle::bus
