#include "common/bus/dds/discovery.hpp"

#include <algorithm>
#include <cstdlib>
#include <sstream>
#include <utility>

namespace aisle::bus {
namespace {

/// By its stream operator.
template <class Anything>
std::string text_of(const Anything& value) {
  std::ostringstream text;
  text << value;
  return text.str();
}

/// Of "key=value;..." in a participant's user data; empty when the key is not there.
std::string value_of(const std::string& text, const std::string& key) {
  const std::size_t at = text.find(key + "=");
  if (at == std::string::npos) return {};
  const std::size_t start = at + key.size() + 1;
  return text.substr(start, text.find(';', start) - start);
}

/// An announcement of the middleware in our own terms.
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

}  // namespace

Discovery::Discovery(std::string partition, std::function<void()> wake)
    : partition_(std::move(partition)), wake_(std::move(wake)) {}

void Discovery::writer_seen(fast::WriterInfo info, bool gone) {
  endpoint_seen(remote_endpoint<fast::WriterInfo>(info, true), gone);
}

void Discovery::reader_seen(fast::ReaderInfo info, bool gone) {
  endpoint_seen(remote_endpoint<fast::ReaderInfo>(info, false), gone);
}

/// Reports of an endpoint begin with its GUID and a blank; '!' is the character after the blank. So the
/// range from one to the other holds them all.
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

/// A participant that goes takes its endpoints with it.
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

void Discovery::add_local(const Announced& endpoint) {
  const std::lock_guard<std::mutex> lock(mutex_);
  locals_.push_back(endpoint);
  changed_ = true;
}

/// Every pair of ours and theirs on one topic; only after something changed.
std::vector<Incident> Discovery::new_conflicts() {
  const std::lock_guard<std::mutex> lock(mutex_);
  std::vector<Incident> found;
  if (!changed_) return found;

  changed_ = false;

  for (const Announced& ours : locals_) {
    for (const auto& [guid, theirs] : remotes_) {
      if (ours.topic != theirs.topic || !same_partition(partition_, theirs.partitions)) continue;
      std::optional<Incident> incident = mismatch(ours, theirs, name_of(theirs.participant_prefix));
      if (incident && reported_.insert(guid + " " + incident->text).second) found.push_back(std::move(*incident));
    }
  }

  return found;
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
