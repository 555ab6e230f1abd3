#pragma once

#include <chrono>
#include <cstdint>

namespace aisle::bus::simulated {

/// One direction between two hosts (or within one). A packet carries one sample, or one message of the protocol
/// (heartbeat, acknowledgement, assertion of liveliness).
struct Link {
  std::chrono::nanoseconds latency{std::chrono::microseconds(100)};  // at least 1 us
  std::chrono::nanoseconds jitter{0};  // added to the latency, uniformly from 0 to this: packets overtake each other
  double loss{0.0};                    // probability of a packet, 0..1; at 1 nothing passes, as on a cut
  double duplicate{0.0};               // probability that a packet arrives twice, 0..1
  double reorder{0.0};                 // probability that a packet is held back by `hold_back`, 0..1
  std::chrono::nanoseconds hold_back{std::chrono::milliseconds(50)};
  bool cut{false};  // nothing passes; what is under way still arrives

  /// Cut, or a loss of everything.
  bool passes_nothing() const { return cut || loss >= 1.0; }
};

/// What was done to packets, since the network began.
struct Tally {
  std::uint64_t sent{0};        // packets handed to a link
  std::uint64_t lost{0};        // by Link::loss, or at the full socket of a process that stands
  std::uint64_t duplicated{0};  // by Link::duplicate
  std::uint64_t reordered{0};   // held back by Link::reorder
  std::uint64_t delayed{0};     // took longer than the network's default link takes
  std::uint64_t cut{0};         // stopped by Link::cut
  std::uint64_t samples{0};     // handed to handlers
  std::uint64_t resent{0};      // samples sent again by reliable writers
};

}  // namespace aisle::bus::simulated
