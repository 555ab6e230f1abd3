#pragma once

#include <map>
#include <string>
#include <vector>

namespace aisle::sim {

/// What a vehicle does at one moment, for the watch on stand-offs.
struct Doing {
  bool has_open_goal{false};
  bool is_moving{false};   // or turns
  bool is_excused{false};  // works at its goal, is held by a person, closed in, dead, or without a leader
  std::vector<std::string> waits_for;
  std::string reason;
};

/// The longest of its kind, and what the vehicle said of it at its end.
struct LongestStand {
  double seconds{0.0};
  double begin_s{0.0};
  std::string agv_id;
  std::string cause;
};

/// Stand-off: a vehicle with an open goal stands, and nobody in its chain of waiting (itself, those it waits for, those
/// they wait for, ...) moves, turns, works at its goal, is held by a person, closed in, dead or without a leader.
/// Wait: a vehicle with an open goal stands and is not held itself, whatever for.
class StandoffWatch {
 public:
  void look(double now_s, const std::map<std::string, Doing>& fleet);

  const LongestStand& longest_standoff() const { return standoff_; }
  const LongestStand& longest_wait() const { return wait_; }

 private:
  std::map<std::string, double> standing_since_, stuck_since_;
  LongestStand standoff_, wait_;
};

}  // namespace aisle::sim
