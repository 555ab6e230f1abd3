#pragma once

#include <cstddef>
#include <deque>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "common/fleet/zone.hpp"
#include "tools/referee/core/authority_watch.hpp"
#include "tools/referee/core/contact_watch.hpp"

namespace aisle::referee {

/// Checks from ground truth that vehicles keep to the zones of the map. Breaches are, of the outline less kTouch_m:
///
///   - keep-out: it enters the zone;
///   - speed: in the zone the base drives more than kFaster_mps above the zone's speed for kFast_s;
///   - one-way: in the zone the base comes back by kBack_m against the direction;
///   - no stopping: it stands in the zone for kStands_s, and no person or thing is within kBefore_m of it;
///   - one vehicle: two outlines are in the zone at a time.
///
/// What a vehicle does in a zone in which it was first seen, or that was made round it, is no breach until it has left.
/// Each breach is told once until the vehicle leaves the zone. Shares no code with the planners but what a zone is.
class ZoneWatch {
 public:
  /// All zones of the map from now on.
  void zones_seen(const std::vector<fleet::Zone>& zones);

  /// Ground truth; of one body in order of time.
  void body_seen(const BodySample& sample);
  void body_gone(const std::string& id) { others_.erase(id); }

  /// In the order in which they began.
  const std::vector<AuthorityViolation>& violations() const { return violations_; }

  static constexpr double kTouch_m = 0.02;
  static constexpr double kFaster_mps = 0.05;
  static constexpr double kFast_s = 0.4;
  static constexpr double kBack_m = 0.15;
  static constexpr double kStands_s = 1.5;
  static constexpr double kBefore_m = 1.5;

 private:
  /// A vehicle's stay in one zone.
  struct Stay {
    bool is_excused{false};     // it was there before the watch, or the zone
    bool is_told{false};        // the breach of this stay
    double farthest_m{-1e9};    // along the direction of a one-way zone
    double fast_since_s{-1.0};  // negative: it is not too fast
  };

  struct Watched {
    std::deque<BodySample> past;  // of the last second or so
    double stands_since_s{0.0};
    std::set<std::string> known;        // zones that it was looked at for
    std::map<std::string, Stay> stays;  // by zone, while its outline is in it
  };

  /// Does the outline, less kTouch_m, lie in the zone?
  static bool is_in(const fleet::Zone& zone, const BodySample& sample);

  /// Of the base over the last samples.
  static double speed_mps(const Watched& vehicle);

  void judge(const fleet::Zone& zone, const std::string& agv_id, Watched& vehicle, Stay& stay);
  bool is_before_something(const BodySample& sample) const;

  /// What is wrong with the stay now; empty: nothing.
  std::string breach_of(const fleet::Zone& zone, const std::string& agv_id, const Watched& vehicle, Stay& stay) const;

  std::vector<fleet::Zone> zones_;
  std::map<std::string, Watched> vehicles_;
  std::map<std::string, BodySample> others_;  // people and things
  std::vector<AuthorityViolation> violations_;
};

}  // namespace aisle::referee
