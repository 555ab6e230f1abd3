#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <set>
#include <string>
#include <vector>

#include "common/bus/bus.hpp"
#include "common/bus/dds/fastdds_compat.hpp"
#include "common/bus/qos_conflict.hpp"

namespace aisle::bus {

/// A reader or writer of someone else, as announced.
struct RemoteEndpoint : Announced {
  std::string guid, participant_prefix;
  std::vector<std::string> partitions;
};

/// The endpoints and participants of others, and what of them does not fit ours. The middleware's
/// threads call *_seen(); everything else is for the loop's thread.
class Discovery final : public fast::DiscoveryListener {
 public:
  /// `wake` ends the loop's wait; it is called on a thread of the middleware.
  Discovery(std::string partition, std::function<void()> wake);

  void writer_seen(fast::WriterInfo info, bool gone) override;
  void reader_seen(fast::ReaderInfo info, bool gone) override;
  void participant_seen(fast::ParticipantInfo info, bool gone) override;

  /// One of our own readers or writers, to be compared with those of others.
  void add_local(const Announced& endpoint);

  /// Mismatches that were not reported before, each once.
  std::vector<Incident> new_conflicts();

  /// Those of others whose participants are known.
  std::vector<Endpoint> endpoints() const;
  std::vector<Participant> participants() const;

  /// Name of the participant with this GUID prefix, with its host, for incidents.
  std::string describe(const std::string& participant_prefix) const;

 private:
  /// What a participant says of itself.
  struct Peer {
    std::string name, host;
    int process_id{0};
  };

  void endpoint_seen(RemoteEndpoint endpoint, bool gone);

  /// As describe(). @pre mutex_ is locked
  std::string name_of(const std::string& prefix) const;

  const std::string partition_;
  const std::function<void()> wake_;
  mutable std::mutex mutex_;                       // guards what follows
  std::map<std::string, Peer> peers_;              // by GUID prefix
  std::map<std::string, RemoteEndpoint> remotes_;  // by GUID
  std::vector<Announced> locals_;
  std::set<std::string> reported_;  // GUID and conflict
  bool changed_{false};
};

}  // namespace aisle::bus
