#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace aisle::bus {

/// Bytes that a process with shared memory takes of /dev/shm, nearly all of them for its segment.
inline constexpr std::uint32_t kSharedMemoryBytes = 16U << 20;

/// PKI files of a secured site; all empty: no security.
struct Security {
  std::string identity_ca, certificate, private_key, permissions_ca, governance, permissions;

  /// Security is on as soon as an identity authority is named.
  bool enabled() const { return !identity_ca.empty(); }
};

/// Where and how a process joins its site. Flags win over environment (AISLE_DOMAIN, AISLE_PARTITION, AISLE_INTERFACES,
/// AISLE_PEERS, AISLE_DISCOVERY_SERVER, AISLE_SHARED_MEMORY), environment over YAML.
struct Settings {
  int domain{0};                        // 0..230
  std::string partition;                // empty: the default partition
  std::vector<std::string> interfaces;  // IPv4 addresses to bind to; empty: all
  std::vector<std::string> peers;       // ADDRESS where multicast is missing
  std::string discovery_server;         // ADDRESS:PORT or NAME:PORT; then no multicast is used at all
  bool super_client{false};             // inspection tools behind a discovery server
  bool shared_memory{false};
  int max_message_bytes{0};  // 0: 65500 on loopback only, else 1400
  Security security;
  std::string participant_name;
};

}  // namespace aisle::bus
