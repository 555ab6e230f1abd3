#pragma once

#include <vector>

#include "common/geometry/body.hpp"
#include "common/scenario/scenario.hpp"
#include "services/fake-world/core/recording.hpp"

namespace aisle::fake_world {

/// A scripted person: walks along its waypoints at its speed, to and fro when it loops, else to the end and stays
/// there. Courteous ones stop short of a vehicle in their way, as people do, and turn back when they have waited too
/// long. No walker walks through another person: it lets those pass that go first, and waits behind the others.
class Walker {
 public:
  /// Another person, as a walker sees them.
  struct Neighbour {
    geometry::Point2 position_in_map;
    geometry::Point2 velocity_in_map;  // m/s; 0 while they stand
    double radius_m{0.0};
    bool goes_first{false};  // where the two would meet, the walker lets this person pass
  };

  /// Metres walked from the first waypoint, and where to; what a restart needs to go on from here.
  struct Progress {
    double along_m{0.0};
    bool back{false};
    double waited_s{0.0};
  };

  /// `mover.speed_mps` is taken as it is; varying it is the caller's part. @pre two or more waypoints
  Walker(const scenario::Mover& mover, const Progress& progress);

  /// Walks on by dt_s seconds, or waits. `vehicles`: bodies in map; `persons`: all others. @pre dt_s >= 0
  void step(double dt_s, const std::vector<geometry::Body>& vehicles, const std::vector<Neighbour>& persons = {});

  /// Place and velocity now; velocity 0 while waiting and at the end.
  Motion motion() const;

  const scenario::Mover& mover() const { return mover_; }
  const Progress& progress() const { return progress_; }

  /// Of the whole way, from the first waypoint to the last.
  double length_m() const { return lengths_m_.back(); }

  static constexpr double kCourtesyM = 0.6;  // free space that they leave to a vehicle

  static constexpr double kPatienceS = 6.0;  // then a walker that loops turns back

  static constexpr double kPersonGapM = 0.05;  // least free space between two persons

  static constexpr double kForesightS = 1.5;  // so early a walker sees that it would meet a person that goes first

 private:
  /// Unit vector of the walk; 0 on a segment without length.
  geometry::Point2 direction_in_map() const;
  geometry::Point2 position_in_map() const;
  /// Index of the waypoint at which the present segment begins.
  std::size_t segment() const;
  /// Is a vehicle ahead, nearer than kCourtesyM?
  bool must_wait(const std::vector<geometry::Body>& vehicles) const;
  /// Would the next steps lead into this person?
  bool must_let_pass(const Neighbour& person) const;
  void walk(double distance_m);

  scenario::Mover mover_;
  std::vector<double> lengths_m_;  // along the way, at each waypoint
  Progress progress_;
  bool walks_{false};
};

}  // namespace aisle::fake_world
