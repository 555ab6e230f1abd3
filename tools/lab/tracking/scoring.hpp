#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "common/fleet/track.hpp"
#include "common/geometry/pose.hpp"

namespace aisle::tracking {

/// The true state of one person at one moment.
struct Person {
  int id{0};
  geometry::Point2 position_in_map;
  geometry::Point2 velocity_in_map;
  bool is_counted{true};  // false: no ray met the person; a track of it is neither right nor wrong, and none is no miss
};

/// A tracker's claim that a person is there. A covariance of zeros: the tracker does not say how sure
/// it is.
using fleet::Track;

/// How honest the covariances are: squared errors over what they should be (normalised estimation error squared), of
/// matched tracks older than 1 s; chi-square with 2 degrees of freedom when they are.
struct Honesty {
  double mean{0.0};    // 2 when honest; more: too sure
  double inside{0.0};  // share within the 95 % quantile
};

/// Figures over all moments so far; shares in [0, 1] but for mota, which is negative where errors outnumber people.
struct Score {
  double mota{0.0};                  // 1 - (misses + false claims + switches) / people
  double motp_m{0.0};                // mean distance of matched pairs
  double idf1{0.0};                  // share of claims and people that one lasting pairing of ids explains
  int id_switches{0};                // a person's track is another than last time
  int fragments{0};                  // a person is lost while counted, and found again
  double velocity_rms_mps{0.0};      // of the velocity vector's error, matched tracks older than 1 s
  Honesty place, velocity;           // of those that say how sure they are
  double latency_scans{0.0};         // moments from the first at which a person counts to the first with a track
  double false_tracks_per_min{0.0};  // ids that were claimed and never matched
  double longest_false_s{0.0};
  std::int64_t people{0};  // of all moments
  std::int64_t misses{0};
  std::int64_t false_claims{0};
};

/// The standard measures of multiple-object tracking: CLEAR MOT (Bernardin, Stiefelhagen 2008) and IDF1 (Ristani et al.
/// 2016), moment by moment. A pair may match within `gate_m`; a pair that still does is kept, the rest is matched with
/// the least total distance.
class Scorer {
 public:
  /// `gate_m`: the farthest that a claim may be from its person.
  explicit Scorer(double period_s, double gate_m = 0.5) : period_s_(period_s), gate_m_(gate_m) {}

  /// The next moment, `period_s` after the one before.
  void look(const std::vector<Person>& people, const std::vector<Track>& claims);

  /// Of all moments so far.
  Score score() const;

 private:
  /// What is known of one person.
  struct History {
    bool has_track{false};
    std::uint64_t track{0};  // the last one matched
    bool is_lost{false};     // missed since
    int waited{0};           // moments it counted before it first had a track
  };

  /// Sums of normalised errors.
  struct Weighing {
    double sum{0.0};
    std::int64_t inside{0}, count{0};

    void add(double nees);
    Honesty honesty() const;
  };

  /// Of one id that a tracker said.
  struct Life {
    int claimed{0};  // moments
    int right{0};    // matched with a person, counted or not
  };

  /// Pairs of this moment, see scoring.cpp.
  std::vector<int> match(const std::vector<Person>& people, const std::vector<Track>& claims) const;

  /// One person with its claim, or with none.
  void judge(const Person& person, const Track* claim);
  void weigh(const Person& person, const Track& claim);
  void note_ids(const std::vector<Person>& people, const std::vector<Track>& claims, const std::vector<int>& claim_of);

  /// For IDF1, see scoring.cpp.
  std::int64_t ids_explained() const;

  double period_s_;
  double gate_m_;
  int moments_{0};
  std::map<int, History> histories_;
  std::map<std::uint64_t, Life> lives_;
  std::map<std::pair<int, std::uint64_t>, std::int64_t> together_;  // moments within the gate
  std::int64_t people_{0}, claims_{0}, misses_{0}, false_claims_{0};
  int switches_{0}, fragments_{0};
  double distance_sum_m_{0.0};
  std::int64_t matches_{0};
  double velocity_squares_{0.0};
  std::int64_t velocities_{0};
  Weighing place_, velocity_;
};

}  // namespace aisle::tracking
