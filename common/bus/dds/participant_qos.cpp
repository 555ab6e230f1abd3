#include "common/bus/dds/participant_qos.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <netdb.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <memory>

#include "common/config/reader.hpp"

namespace aisle::bus {
namespace {

constexpr std::uint32_t kSocketBufferBytes = 4 * 1024 * 1024;
constexpr std::uint32_t kLoopbackMessageBytes = 65500;
constexpr std::uint32_t kNetworkMessageBytes = 1400;
constexpr std::uint32_t kParticipantsPerHost = 250;
constexpr std::uint32_t kPeersPerHost = 32;
constexpr std::size_t kSendBuffers = 2;

/// All IPv4 addresses of this host's interfaces.
std::vector<std::string> addresses_of_host() {
  std::vector<std::string> found;
  ifaddrs* list = nullptr;
  if (getifaddrs(&list) != 0) return found;

  for (const ifaddrs* entry = list; entry != nullptr; entry = entry->ifa_next) {
    if (entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;
    char text[INET_ADDRSTRLEN] = {};
    const auto* address = reinterpret_cast<const sockaddr_in*>(entry->ifa_addr);
    if (inet_ntop(AF_INET, &address->sin_addr, text, sizeof text) != nullptr) found.emplace_back(text);
  }

  freeifaddrs(list);
  return found;
}

bool is_loopback(const std::string& address) { return address.rfind("127.", 0) == 0; }

/// Nothing but addresses 127.x: nothing of the site is on another host.
bool loopback_only(const Settings& settings) {
  return !settings.interfaces.empty() &&
         std::all_of(settings.interfaces.begin(), settings.interfaces.end(), is_loopback);
}

/// @throws config::BadInput
void check_address(const std::string& address, const char* what) {
  in_addr parsed{};
  if (inet_pton(AF_INET, address.c_str(), &parsed) == 1) return;
  throw config::BadInput(std::string(what) + " '" + address + "' is not an IPv4 address; write it like 192.168.1.20");
}

/// @throws config::BadInput, config::BadEnvironment
void check_interfaces(const Settings& settings) {
  const std::vector<std::string> available = addresses_of_host();
  for (const std::string& wanted : settings.interfaces) {
    check_address(wanted, "interface");

    const bool found = std::find(available.begin(), available.end(), wanted) != available.end() || is_loopback(wanted);
    if (found) continue;

    std::string names;
    for (const std::string& address : available) names += " " + address;
    throw config::BadEnvironment("interface " + wanted + " is none of this host; it has" + names);
  }
}

/// UDP over IPv4 always; shared memory on request. Over a network, messages fit into one Ethernet
/// frame, so that one lost frame costs one message.
void use_transports(const Settings& settings, fast::dds::DomainParticipantQos& qos) {
  const auto bytes = settings.max_message_bytes > 0 ? static_cast<std::uint32_t>(settings.max_message_bytes)
                     : loopback_only(settings)      ? kLoopbackMessageBytes
                                                    : kNetworkMessageBytes;

  // UDP, on the site's interfaces only.
  auto udp = std::make_shared<fast::UdpTransport>();

  udp->maxMessageSize = bytes;
  udp->sendBufferSize = kSocketBufferBytes;
  udp->receiveBufferSize = kSocketBufferBytes;
  udp->maxInitialPeersRange = kPeersPerHost;
  udp->interfaceWhiteList = settings.interfaces;
  qos.transport().use_builtin_transports = false;
  qos.transport().send_socket_buffer_size = kSocketBufferBytes;
  qos.transport().listen_socket_buffer_size = kSocketBufferBytes;
  qos.transport().user_transports.push_back(udp);

  if (!settings.shared_memory) return;

  // Shared memory beside it.
  auto shared = std::make_shared<fast::SharedMemoryTransport>();
  shared->segment_size(kSharedMemoryBytes);
  shared->max_message_size(kLoopbackMessageBytes);
  qos.transport().user_transports.push_back(shared);
}

void add_peer(fast::dds::DomainParticipantQos& qos, const std::string& address) {
  fast::rtps::Locator_t locator;
  locator.kind = LOCATOR_KIND_UDPv4;
  fast::rtps::IPLocator::setIPv4(locator, address);
  qos.wire_protocol().builtin.initialPeersList.push_back(locator);
}

/// Peers replace multicast, so this host's own processes must be among them.
void use_peers(const Settings& settings, fast::dds::DomainParticipantQos& qos) {
  if (settings.peers.empty()) return;

  std::vector<std::string> addresses = settings.peers;
  if (settings.interfaces.empty()) addresses.emplace_back("127.0.0.1");
  addresses.insert(addresses.end(), settings.interfaces.begin(), settings.interfaces.end());
  std::sort(addresses.begin(), addresses.end());
  addresses.erase(std::unique(addresses.begin(), addresses.end()), addresses.end());

  for (const std::string& address : addresses) {
    check_address(address, "peer");
    add_peer(qos, address);
  }
}

/// The first IPv4 address of a host's name (or of an address written out).
std::string resolve(const std::string& host) {
  addrinfo wanted{};
  wanted.ai_family = AF_INET;
  wanted.ai_socktype = SOCK_DGRAM;

  addrinfo* list = nullptr;
  const int code = getaddrinfo(host.c_str(), nullptr, &wanted, &list);

  if (code != 0) {
    throw config::BadEnvironment("discovery server '" + host + "': " + gai_strerror(code) +
                                 "; write a host's name or an address like 192.168.1.20");
  }

  char text[INET_ADDRSTRLEN] = {};
  inet_ntop(AF_INET, &reinterpret_cast<const sockaddr_in*>(list->ai_addr)->sin_addr, text, sizeof text);
  freeaddrinfo(list);

  return text;
}

/// "ADDRESS" or "ADDRESS:PORT"; the port is 11811 by default, as in Fast DDS.
void use_discovery_server(const Settings& settings, fast::dds::DomainParticipantQos& qos) {
  if (settings.discovery_server.empty()) return;

  const std::size_t colon = settings.discovery_server.find(':');
  const std::string address = settings.discovery_server.substr(0, colon);
  const int port = colon == std::string::npos ? 11811 : std::atoi(settings.discovery_server.c_str() + colon + 1);

  if (port < 1 || port > 65535) {
    throw config::BadInput("discovery server '" + settings.discovery_server +
                           "': the port must be 1 to 65535; write it like 192.168.1.20:11811");
  }

  fast::join_discovery_server(qos, resolve(address), static_cast<std::uint16_t>(port), settings.super_client);
}

/// The security plugins want URIs.
std::string file_uri(const std::string& file) {
  return file.find("://") == std::string::npos && file.rfind("file:", 0) != 0 ? "file://" + file : file;
}

/// The three builtin plugins of DDS Security 1.1: authentication, access control, cryptography.
void use_security(const Security& security, fast::dds::DomainParticipantQos& qos) {
  if (!security.enabled()) return;

  auto& properties = qos.properties().properties();
  const auto set = [&](const char* name, const std::string& value) { properties.emplace_back(name, value); };

  set("dds.sec.auth.plugin", "builtin.PKI-DH");
  set("dds.sec.auth.builtin.PKI-DH.identity_ca", file_uri(security.identity_ca));
  set("dds.sec.auth.builtin.PKI-DH.identity_certificate", file_uri(security.certificate));
  set("dds.sec.auth.builtin.PKI-DH.private_key", file_uri(security.private_key));
  set("dds.sec.access.plugin", "builtin.Access-Permissions");
  set("dds.sec.access.builtin.Access-Permissions.permissions_ca", file_uri(security.permissions_ca));
  set("dds.sec.access.builtin.Access-Permissions.governance", file_uri(security.governance));
  set("dds.sec.access.builtin.Access-Permissions.permissions", file_uri(security.permissions));
  set("dds.sec.crypto.plugin", "builtin.AES-GCM-GMAC");
}

/// Host and process, for `aisle doctor` and for incidents: "host=...;pid=..." in the participant's user data.
void introduce(fast::dds::DomainParticipantQos& qos) {
  char host[256] = {};
  gethostname(host, sizeof host - 1);
  const std::string text = "host=" + std::string(host) + ";pid=" + std::to_string(getpid());
  qos.user_data().data_vec(std::vector<unsigned char>(text.begin(), text.end()));
}

}  // namespace

/// The settings are checked before they are used: a wrong one would only show as silence on the bus.
fast::dds::DomainParticipantQos participant_qos(const Settings& settings) {
  if (settings.domain < 0 || settings.domain > 230) {
    throw config::BadInput("domain " + std::to_string(settings.domain) + " is not within 0 and 230");
  }

  check_interfaces(settings);

  fast::dds::DomainParticipantQos qos = fast::dds::PARTICIPANT_QOS_DEFAULT;
  if (!settings.participant_name.empty()) qos.name(settings.participant_name.c_str());

  auto& discovery = qos.wire_protocol().builtin.discovery_config;

  // Longer than a healthcheck lives: see docs/decisions/0006.
  discovery.leaseDuration = fast::duration(std::chrono::seconds(5));
  discovery.leaseDuration_announcementperiod = fast::duration(std::chrono::milliseconds(500));
  qos.allocation().send_buffers.preallocated_number = kSendBuffers;  // by default ten, of the largest message each
  qos.allocation().send_buffers.dynamic = true;
  qos.wire_protocol().builtin.mutation_tries = kParticipantsPerHost;
  use_transports(settings, qos);
  use_peers(settings, qos);
  use_discovery_server(settings, qos);
  use_security(settings.security, qos);
  fast::keep_types_off_the_wire(qos);
  introduce(qos);

  return qos;
}

}  // namespace aisle::bus
