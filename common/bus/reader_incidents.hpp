#pragma once

// What a reader tells of its topic, in one voice for every bus.

#include <cstdint>
#include <map>
#include <string>

#include "common/bus/sample_info.hpp"

namespace aisle::bus {

/// `participant`: name and host of the writer's.
Incident malformed_sample(const std::string& topic, const std::string& type, const std::string& participant);

/// A writer has been silent for longer than its lease.
Incident liveliness_lost(const std::string& topic, const Qos& qos, const std::string& participant);

/// `total`: how often, since the reader was made.
Incident deadline_missed(const std::string& topic, const Qos& qos, std::int64_t total);

/// `total`: how many, since the reader was made.
Incident samples_rejected(const std::string& topic, std::int64_t total);

/// Lets one incident of each kind through in five seconds.
class QuietTime {
 public:
  /// @returns true, and begins the five seconds, when the kind may be reported now.
  bool allows(Incident::Kind kind, time::Stamp now);

 private:
  std::map<Incident::Kind, time::Stamp> reported_;
};

}  // namespace aisle::bus
