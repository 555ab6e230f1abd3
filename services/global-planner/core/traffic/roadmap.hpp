#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "common/grid/clearance.hpp"
#include "services/global-planner/core/traffic/shape.hpp"

namespace aisle::global_planner::traffic {

using KindId = std::uint32_t;
using PlaceId = std::uint32_t;
using MotionId = std::uint32_t;
inline constexpr std::uint32_t kNoId = std::numeric_limits<std::uint32_t>::max();

/// A pose at which a vehicle of one kind may stand.
struct Place {
  geometry::Pose2 base_in_map;
  KindId kind{0};
  bool has_heading{false};   // of a kind that does not turn on the spot
  bool may_rest{true};       // false: a vehicle without a goal does not stay here (cut of the roadmap, zone)
  bool is_temporary{false};  // a start, goal or cut of an own way; gone when it is left
  bool is_closed{false};
  std::uint32_t corridor{kNoId};  // where two cannot pass: all places of a corridor have one number

  Shape standing;
  std::vector<MotionId> leaving;
  std::vector<MotionId> entering;
};

/// A way between two places without a stop, of one kind.
struct Motion {
  PlaceId from{kNoId};
  PlaceId to{kNoId};
  KindId kind{0};
  std::vector<geometry::Point2> path_in_map;  // from the first place to the second
  std::vector<double> headings_rad;           // at each point; empty for a kind that turns on the spot
  double length_m{0.0};
  double entry_rad{0.0};  // heading at the beginning and at the end, of the vehicle
  double exit_rad{0.0};
  double speed_mps{0.0};   // at most, by the kind's limits and by zones
  bool is_reverse{false};
  bool is_temporary{false};
  bool is_closed{false};
  Shape shape;  // swept from place to place, tube included
};

/// Places and motions of all kinds of vehicles, made from the map alone. Ids survive edits elsewhere and are never used
/// twice. No lane is drawn by hand: places are the points of a lattice, moved to where there is room.
class Roadmap {
 public:
  /// The number of the kind; its places and motions are made when it is new and there is a map. Equal kinds share one.
  KindId kind(const Kind& kind);
  const Kind& kind(KindId id) const;

  /// A new map: only what lies near the changed cells (`low` to `high`, both included) is made anew.
  /// `clearance` is not copied and must outlive the next call.
  void set_map(const grid::ClearanceField& clearance, grid::Cell low, grid::Cell high);

  const Place& place(PlaceId id) const;
  const Motion& motion(MotionId id) const;
  std::size_t places() const;  // ids are below this
  std::size_t motions() const;

  /// The place (not temporary, open) that the vehicle can reach straight from here, the nearest; kNoId: none.
  PlaceId nearest(KindId kind, const geometry::Pose2& base_in_map) const;

  /// A temporary place, joined both ways to all places in straight reach (within 1.6 m, else 2.5 m, else 4 m; none:
  /// kNoId); an existing place within 1 cm is returned instead.
  PlaceId temporary_place(KindId kind, const geometry::Pose2& base_in_map);

  /// A temporary motion along the path between two places, with a motion back where the kind turns on the spot.
  MotionId temporary_motion(PlaceId from, PlaceId to, std::vector<geometry::Point2> path_in_map);

  /// Temporary places and motions that are not in `in_use` end: their ids stay invalid for ever.
  void sweep(const std::vector<PlaceId>& places_in_use, const std::vector<MotionId>& motions_in_use);

  /// Closes what meets the shape (a box, a parked vehicle, a dead one) under a name, until it is opened again.
  void close(const std::string& name, const Shape& shape);
  void open(const std::string& name);

  /// Seconds from each place to `goal` by the shortest way alone, infinity where there is none: for places that are not
  /// temporary. Kept until the map or a closure changes.
  const std::vector<double>& seconds_to(PlaceId goal);

  /// Counts up with each change of places, motions or closures.
  std::uint64_t revision() const { return revision_; }

 private:
  std::uint64_t revision_{0};
};

/// Seconds that a vehicle takes over a motion: length / (0.9 v), and 1 s a right angle to turn before it, 0.5 s when it
/// starts from standing (spec section 8.2).
double run_s(const Kind& kind, const Motion& motion, double heading_before_rad, bool from_standing);

}  // namespace aisle::global_planner::traffic
