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

/// Who else is there, and what of it does not fit ours. The middleware's threads fill it; everything else is for the
/// loop.
class Discovery final : public fast::DiscoveryListener {
 public:
  /// `wake` is called on a thread of the middleware.
  Discovery(std::string partition, std::function<void()> wake);

  void writer_seen(fast::WriterInfo info, bool gone) override;
  void reader_seen(fast::ReaderInfo info, bool gone) override;
  void participant_seen(fast::ParticipantInfo info, bool gone) override;

  void add_local(const Announced& endpoint);
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
