#include "tools/cli/network_probe.hpp"

#include <arpa/inet.h>
#include <ifaddrs.h>
#include <net/if.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <memory>

namespace aisle::cli {
namespace {

constexpr const char* kGroup = "239.255.0.1";  // the one that RTPS discovery uses
constexpr int kPatienceMs = 300;

/// A datagram socket that closes itself.
class Socket {
 public:
  Socket() : fd_(socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0)) {}

  ~Socket() {
    if (fd_ >= 0) close(fd_);
  }

  Socket(const Socket&) = delete;
  Socket& operator=(const Socket&) = delete;
  int fd() const { return fd_; }

  template <class T>
  bool set(int option, const T& value) {
    return setsockopt(fd_, IPPROTO_IP, option, &value, sizeof value) == 0;
  }

 private:
  int fd_;
};

/// Joins the group on this interface, sends one datagram to it that must not leave the host (0 hops),
/// and waits for it to come back.
bool multicast_works(in_addr address) {
  Socket socket;
  ip_mreq membership{};

  inet_pton(AF_INET, kGroup, &membership.imr_multiaddr);
  membership.imr_interface = address;

  const unsigned char nowhere = 0;  // hops
  if (!socket.set(IP_ADD_MEMBERSHIP, membership) || !socket.set(IP_MULTICAST_IF, address) ||
      !socket.set(IP_MULTICAST_TTL, nowhere))
    return false;

  // Any free port, to which the datagram is sent.
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_addr.s_addr = htonl(INADDR_ANY);

  socklen_t length = sizeof here;
  if (bind(socket.fd(), reinterpret_cast<sockaddr*>(&here), sizeof here) != 0) return false;
  if (getsockname(socket.fd(), reinterpret_cast<sockaddr*>(&here), &length) != 0) return false;

  here.sin_addr = membership.imr_multiaddr;

  const char word[] = "aisle doctor";
  if (sendto(socket.fd(), word, sizeof word, 0, reinterpret_cast<sockaddr*>(&here), sizeof here) < 0) return false;

  pollfd waiting{socket.fd(), POLLIN, 0};
  return poll(&waiting, 1, kPatienceMs) == 1;
}

}  // namespace

/// By getifaddrs(3); each address is tried in turn.
std::vector<NetworkInterface> probe_interfaces() {
  std::vector<NetworkInterface> interfaces;
  ifaddrs* first = nullptr;
  if (getifaddrs(&first) != 0) return interfaces;

  const std::unique_ptr<ifaddrs, void (*)(ifaddrs*)> owner(first, &freeifaddrs);
  for (const ifaddrs* entry = first; entry != nullptr; entry = entry->ifa_next) {
    const bool is_up = (entry->ifa_flags & IFF_UP) != 0;
    if (!is_up || entry->ifa_addr == nullptr || entry->ifa_addr->sa_family != AF_INET) continue;

    const in_addr address = reinterpret_cast<const sockaddr_in*>(entry->ifa_addr)->sin_addr;
    char text[INET_ADDRSTRLEN] = {};

    inet_ntop(AF_INET, &address, text, sizeof text);
    interfaces.push_back({entry->ifa_name, text, (entry->ifa_flags & IFF_LOOPBACK) != 0, multicast_works(address)});
  }

  return interfaces;
}

}  // namespace aisle::cli
