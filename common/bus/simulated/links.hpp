#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "common/bus/simulated/link.hpp"
#include "common/time/stamp.hpp"

namespace aisle::bus::simulated {

/// The hosts and the links between them; draws the fate of each packet.
class Links {
 public:
  /// `base`: of every link until it is changed.
  Links(std::uint64_t seed, const Link& base) : base_(base), between_(base), random_(seed) {}

  /// Number of the host with this name, a new one for a new name.
  int host(const std::string& name);
  const std::string& host_name(int host) const { return hosts_[static_cast<std::size_t>(host)]; }

  /// Settings of one direction; `from` and `to` are numbers of host().
  const Link& link(int from, int to) const;
  void set_link(int from, int to, const Link& link, time::Stamp now);

  /// Sets every link between different hosts, and drops the settings of their own.
  void set_all_between(const Link& link, time::Stamp now);

  /// Since when nothing passes; empty when something does.
  std::optional<time::Stamp> cut_since(int from, int to) const;

  /// After how long the copies of a packet arrive: none when it is lost, two when it is duplicated.
  struct Fate {
    int copies{0};
    time::Stamp after[2]{};
  };

  /// Draws the fate of one packet and counts it in tally().
  Fate send(int from, int to);

  Tally& tally() { return tally_; }

 private:
  /// A number in [0, 1); and how long one copy of a packet takes.
  double chance();
  time::Stamp delay(const Link& link);

  Link base_;     // within a host, and what "delayed" is measured by
  Link between_;  // of different hosts
  std::vector<std::string> hosts_;
  std::map<std::pair<int, int>, Link> own_;  // links with settings of their own
  std::map<std::pair<int, int>, time::Stamp> cut_since_;
  time::Stamp all_cut_since_{};
  std::mt19937_64 random_;
  Tally tally_;
};

}  // namespace aisle::bus::simulated
