#pragma once
#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/bus/fastdds_compat.hpp"

namespace aisle::bus {

/// A reader or writer of someone else, as announced.
struct RemoteEndpoint {
  std::string guid, participant_prefix, topic, type;
  bool is_writer{false};
  bool manual_liveliness{false};
  Qos qos;
  std::vector<std::string> partitions;
};

/// One of ours.
struct LocalEndpoint {
  std::string topic, type;
  bool is_writer{false};
  Qos qos;
};

/// Why a writer and a reader of one topic do not meet: the policy, what is offered and what is asked for; empty when
/// they do.
std::string qos_conflict(const Qos& offered, bool offers_manual_liveliness, const Qos& requested,
                         bool asks_manual_liveliness);

/// Who else is there, and what of it does not fit ours. The middleware's threads fill it; everything else is for the
/// loop.
class Discovery final : public fast::DiscoveryListener {
 public:
  /// `wake` is called on a thread of the middleware.
  Discovery(std::string partition, std::function<void()> wake);

  void writer_seen(fast::WriterInfo info, bool gone) override;
  void reader_seen(fast::ReaderInfo info, bool gone) override;
  void participant_seen(fast::ParticipantInfo info, bool gone) override;

  void add_local(const LocalEndpoint& endpoint);
  /// What does not fit, each once.
  std::vector<Incident> new_conflicts();

  std::vector<Endpoint> endpoints() const;
  std::vector<Participant> participants() const;
  /// Name of the participant with this GUID prefix, with its host, for incidents.
  std::string describe(const std::string& participant_prefix) const;

 private:
  struct Peer {
    std::string name, host;
    int process_id{0};
  };
  void endpoint_seen(RemoteEndpoint endpoint, bool gone);
  std::string name_of(const std::string& prefix) const;
  void compare(const LocalEndpoint& ours, const RemoteEndpoint& theirs, std::vector<Incident>& found);
  void report(const RemoteEndpoint& theirs, Incident incident, std::vector<Incident>& found);
  bool same_partition(const std::vector<std::string>& theirs) const;

  const std::string partition_;
  const std::function<void()> wake_;
  mutable std::mutex mutex_;                       // guards what follows
  std::map<std::string, Peer> peers_;              // by GUID prefix
  std::map<std::string, RemoteEndpoint> remotes_;  // by GUID
  std::vector<LocalEndpoint> locals_;
  std::set<std::string> reported_;  // GUID and conflict
  bool changed_{false};
};

}  // namespace aisle::bus
