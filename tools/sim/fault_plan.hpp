#pragma once

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "common/config/reader.hpp"

namespace aisle::sim {

// What goes wrong at a simulated site, and when. Times are seconds since the start of the run. Processes are named as
// in `aisle health` ("map", "local-planner-agv-1"); '*' in a name stands for any text. See docs/simulation.md.

/// Harms the messages that `from` sends to `to` while the plan runs.
struct LinkFault {
  std::string from{"*"};
  std::string to{"*"};
  double begin_s{0.0};
  double for_s{kLongestS};
  double loss{0.0};        // share of packets that are lost
  double delay_ms{0.0};    // on top of the network's own latency
  double jitter_ms{0.0};   // each packet waits up to so much longer
  double duplicates{0.0};  // share that arrives twice
  double reordered{0.0};   // share that waits for `reorder_ms`, so that later packets overtake it
  double reorder_ms{30.0};

  static constexpr double kLongestS = 86400.0;

  template <class Reader>
  void describe(Reader& r) {
    r.field("from", from)
        .field("to", to)
        .field("begin_s", begin_s, 0.0, kLongestS)
        .field("for_s", for_s, 0.0, kLongestS)
        .field("loss", loss, 0.0, 1.0)
        .field("delay_ms", delay_ms, 0.0, 5000.0)
        .field("jitter_ms", jitter_ms, 0.0, 5000.0)
        .field("duplicates", duplicates, 0.0, 1.0)
        .field("reordered", reordered, 0.0, 1.0)
        .field("reorder_ms", reorder_ms, 0.0, 5000.0);
  }
};

/// When something happens: at `at_s`, then every `every_s` (0: once; else at least kLeastPeriodS, so that a plan stays
/// small) until the plan stops.
struct Occasion {
  double at_s{0.0};
  double every_s{0.0};

  static constexpr double kLeastPeriodS = 0.01;

  template <class Reader>
  void describe(Reader& r) {
    r.field("at_s", at_s, 0.0, LinkFault::kLongestS).field("every_s", every_s, 0.0, LinkFault::kLongestS);
    if (every_s > 0.0 && every_s < kLeastPeriodS) r.reject("every_s", "neither 0 nor at least 0.01 s");
  }
};

/// Nothing passes from `from` to `to`, nor back where `both_ways`. Where a name stands for several processes, each
/// occasion takes one of them by the seed.
struct Cut : Occasion {
  std::string from{"*"};
  std::string to{"*"};
  double for_s{1.0};
  bool both_ways{true};

  template <class Reader>
  void describe(Reader& r) {
    Occasion::describe(r);
    r.field("from", from)
        .field("to", to)
        .field("for_s", for_s, 0.0, LinkFault::kLongestS)
        .field("both_ways", both_ways);
  }
};

/// One process that `process` names ends without a word, and is started anew `restart_after_s` later.
struct Crash : Occasion {
  std::string process{"*"};
  double restart_after_s{1.0};

  template <class Reader>
  void describe(Reader& r) {
    Occasion::describe(r);
    r.field("process", process).field("restart_after_s", restart_after_s, 0.0, LinkFault::kLongestS);
  }
};

/// One process that `process` names does nothing for a while, then goes on.
struct Hang : Occasion {
  std::string process{"*"};
  double for_s{1.0};

  template <class Reader>
  void describe(Reader& r) {
    Occasion::describe(r);
    r.field("process", process).field("for_s", for_s, 0.0, LinkFault::kLongestS);
  }
};

/// The wall clock of one process that `process` names jumps by `by_s`.
struct ClockJump : Occasion {
  std::string process{"*"};
  double by_s{0.0};

  template <class Reader>
  void describe(Reader& r) {
    Occasion::describe(r);
    r.field("process", process).field("by_s", by_s, -LinkFault::kLongestS, LinkFault::kLongestS);
  }
};

/// The disk of one process that `process` names: "full" takes no write for `for_s`; "torn" and "lost" hit the files
/// that lie there at that moment: each is cut off in its middle, or gone.
struct DiskFault : Occasion {
  std::string process{"*"};
  std::string kind{"full"};
  double for_s{5.0};

  template <class Reader>
  void describe(Reader& r) {
    Occasion::describe(r);
    r.field("process", process).field("kind", kind).field("for_s", for_s, 0.0, LinkFault::kLongestS);
    if (kind != "full" && kind != "torn" && kind != "lost")
      r.reject("kind", "'" + kind + "' is not full, torn or lost");
  }
};

/// In each period of `every_s` from `begin_s` on, a person holds each vehicle that `vehicle` names once, at a moment
/// that the seed draws, for `least_s` to `most_s`. The vehicle brakes, and stands until the person lets go.
struct Hold {
  std::string vehicle{"*"};  // "agv-1"
  double begin_s{0.0};
  double every_s{60.0};
  double least_s{2.0};
  double most_s{8.0};

  static constexpr double kLeastPeriodS = 1.0;

  template <class Reader>
  void describe(Reader& r) {
    r.field("vehicle", vehicle)
        .field("begin_s", begin_s, 0.0, LinkFault::kLongestS)
        .field("every_s", every_s, kLeastPeriodS, LinkFault::kLongestS)
        .field("least_s", least_s, 0.0, LinkFault::kLongestS)
        .field("most_s", most_s, 0.0, LinkFault::kLongestS);
    if (most_s < least_s) r.reject("most_s", "less than least_s");
  }
};

/// Each vehicle that `vehicle` names reaches only this share of its top speed, and says nothing of it.
struct Slow {
  std::string vehicle{"*"};
  double begin_s{0.0};
  double for_s{LinkFault::kLongestS};
  double share{0.8};

  template <class Reader>
  void describe(Reader& r) {
    r.field("vehicle", vehicle)
        .field("begin_s", begin_s, 0.0, LinkFault::kLongestS)
        .field("for_s", for_s, 0.0, LinkFault::kLongestS)
        .field("share", share, 0.05, 1.0);
  }
};

/// One vehicle that `vehicle` names and that still lives ends for good: its processes say and hear nothing any more,
/// and its body brakes and stays. `signed_off_after_s` later a person signs it off, as `aisle fleet sign-off` does, and
/// again whenever the leader counts it among the silent.
struct Death : Occasion {
  std::string vehicle{"*"};  // "agv-1"
  double signed_off_after_s{60.0};

  template <class Reader>
  void describe(Reader& r) {
    Occasion::describe(r);
    r.field("vehicle", vehicle).field("signed_off_after_s", signed_off_after_s, 0.0, LinkFault::kLongestS);
  }
};

/// Everything that goes wrong in one run.
struct FaultPlan {
  /// Then links are whole again, what was cut, hung or down comes back, and vehicles go as told; the dead stay dead.
  double stop_s{60.0};
  std::vector<LinkFault> links;
  std::vector<Cut> cuts;
  std::vector<Crash> crashes;
  std::vector<Hang> hangs;
  std::vector<ClockJump> clock_jumps;
  std::vector<DiskFault> disks;
  std::vector<Hold> holds;
  std::vector<Slow> slows;
  std::vector<Death> deaths;

  template <class Reader>
  void describe(Reader& r) {
    r.field("stop_s", stop_s, 0.0, LinkFault::kLongestS)
        .list("links", links)
        .list("cuts", cuts)
        .list("crashes", crashes)
        .list("hangs", hangs)
        .list("clock_jumps", clock_jumps)
        .list("disks", disks)
        .list("holds", holds)
        .list("slows", slows)
        .list("deaths", deaths);
  }

  /// Does nothing go wrong?
  bool is_empty() const;
};

/// @throws config::BadInput with file, line, key and limit
FaultPlan read_fault_plan(const std::filesystem::path& file);

/// A plan of several kinds of faults; the same for the same seed. It stops at 60 s.
FaultPlan random_fault_plan(std::uint64_t seed);

/// The plan as a file that read_fault_plan() takes.
std::string to_yaml(const FaultPlan& plan);

/// Does `pattern` stand for `name`? '*' in it stands for any text, also none.
bool is_named(const std::string& pattern, const std::string& name);

}  // namespace aisle::sim
