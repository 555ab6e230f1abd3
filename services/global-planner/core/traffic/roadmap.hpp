#pragma once

#include <cstdint>
#include <deque>
#include <limits>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "common/grid/clearance.hpp"
#include "services/global-planner/core/traffic/floor_bins.hpp"
#include "services/global-planner/core/traffic/lattice.hpp"
#include "services/global-planner/core/traffic/shape.hpp"
#include "services/global-planner/core/traffic/zone_rules.hpp"

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
  bool is_pass_only{false};       // in a zone where nobody may stop: closed, but for who is inside and leaves
  bool is_kept_clear{false};      // nobody rests here by choice: see ZoneRules::forbid_resting
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
  double speed_mps{0.0};  // at most, by the kind's limits and by zones
  bool is_reverse{false};
  bool is_temporary{false};
  bool is_closed{false};
  Shape shape;             // swept from place to place, tube included
  bool is_blocked{false};  // closed by something that stands there, or by a one-way zone; a motion that is closed and
                           // not blocked was taken away by an edit: whoever is inside may leave by it
  bool is_through{false};  // leads through a zone where nobody may stop, from one side to another
};

/// Places and motions of all kinds of vehicles, made from the map alone. Ids survive edits elsewhere. No lane is drawn
/// by hand: places are the points of a lattice, moved to where there is room.
///
///   clearance ─► lattice points ─► joins of neighbours ─► bridges between parts that the floor joins
///             ─► places and motions with shapes ─► corridors and cuts
///
/// What an edit takes away is closed, and ends at the next sweep() that does not name it, so that a vehicle inside may
/// still leave. References to places and motions stay good until these end.
class Roadmap {
 public:
  /// @param gap_m between a shape and what closes it; and between two vehicles
  explicit Roadmap(double gap_m = 0.05);

  /// The number of the kind; its places and motions are made when it is new and there is a map. Equal kinds share one.
  KindId kind(const Kind& kind);
  const Kind& kind(KindId id) const;

  /// A new map: only what lies near the changed cells (`low` to `high`, both included) is made anew; all of it where
  /// the map's size or place changed. `clearance` is not copied and must outlive the next call.
  void set_map(const grid::ClearanceField& clearance, grid::Cell low, grid::Cell high);

  /// Zones of the map; what lies in those that changed is made anew, as after an edit of the map. Floor that nobody may
  /// enter is no affair of it: it is occupied in the clearance.
  void set_zones(const std::vector<fleet::Zone>& zones);
  const ZoneRules& zones() const { return zones_; }

  /// The map itself, in which floor that nobody may enter is free, so that a vehicle which stands there finds a way
  /// out. Must outlive the next call. Null: there is no such floor.
  void set_bare_map(const grid::OccupancyGrid* map) { bare_map_ = map; }

  /// Of an id that has ended: a closed one without neighbours.
  const Place& place(PlaceId id) const;
  const Motion& motion(MotionId id) const;
  std::size_t places() const { return places_.size(); }  // ids are below this; some of them have ended
  std::size_t motions() const { return motions_.size(); }

  /// The place (not temporary, open) that the vehicle can reach straight from here, the nearest; kNoId: none.
  PlaceId nearest(KindId kind, const geometry::Pose2& base_in_map) const;

  /// A temporary place, joined both ways to all places in straight reach (within 1.6 m, else 2.5 m, else 4 m, else by a
  /// short search to one; none: kNoId). An existing place within 1 cm is returned instead. It may stand nearer to a
  /// wall than others: then the ways to it may begin as near. Of a kind that does not turn on the spot: joined by
  /// arcs and straights, each way where there is room; it may be that it can only be entered, or only be left.
  /// @param is_joined false: no motions yet, for a cut of an own way
  PlaceId temporary_place(KindId kind, const geometry::Pose2& base_in_map, bool is_joined = true);

  /// A temporary motion along the path between two places, with a motion back where the kind turns on the spot. That of
  /// an equal path (within 1 cm) is returned instead.
  /// @param headings_rad at each point, for kinds that do not turn on the spot; empty: along the path
  MotionId temporary_motion(PlaceId from, PlaceId to, std::vector<geometry::Point2> path_in_map,
                            std::vector<double> headings_rad = {});

  /// Ids of places and motions that ended.
  struct Ended {
    std::vector<PlaceId> places;
    std::vector<MotionId> motions;
  };

  /// Temporary places and motions that are not in `in_use` end. The ends of a motion in use are in use, and so are the
  /// motion back over it and the ways between a place in use and the places around. A place in use that is left without
  /// a way to the others is joined anew.
  /// @return all that ended since the last sweep; ten sweeps later these ids may be used again
  Ended sweep(const std::vector<PlaceId>& places_in_use, const std::vector<MotionId>& motions_in_use);

  /// Closes what meets the shape (a box, a parked vehicle, a dead one) under a name, until it is opened again, and
  /// makes places and motions round it where there is room; these are temporary once it is opened. A motion that leads
  /// away from it out of a closed place stays open. The same shape as before changes nothing.
  void close(const std::string& name, const Shape& shape);
  void open(const std::string& name);

  /// Seconds from each place to `goal` by the shortest way alone, without turns, infinity where there is none; of ids
  /// below the table's size that are not temporary. `goal` may be temporary. Kept until the map or a closure changes,
  /// or a sweep() does not name the goal.
  const std::vector<double>& seconds_to(PlaceId goal);

  /// The same from one place, which may be temporary.
  double seconds_to(PlaceId from, PlaceId goal);

  /// Counts up with each change of places, motions or closures, but for temporary ones.
  std::uint64_t revision() const { return revision_; }

 private:
  /// The places and motions of one kind.
  struct Net {
    Kind kind;
    LatticeSpec spec;
    FloorBins<PlaceId> places;                        // neither temporary nor taken away
    std::unordered_map<std::int64_t, PlaceId> poses;  // of a kind that does not turn on the spot
  };

  struct Ids {
    std::vector<PlaceId> places;
    std::vector<MotionId> motions;
  };

  /// Something that stands on the floor: what it closes, and what was made round it.
  struct Closure {
    Shape shape;
    Ids closed;
    Ids made;
  };

  /// A place or motion that so many things close was taken away by an edit.
  static constexpr std::uint16_t kForGood = 1000;

  /// Which floor is looked at, and what is made there.
  struct Work {
    const grid::ClearanceField& clearance;
    Box region;        // new places lie in it
    Box window;        // places in it are looked at
    bool with_closed;  // closed places and motions count as well
  };

  // --- ids: roadmap.cpp
  PlaceId add_place(KindId kind, const geometry::Pose2& base_in_map, bool has_heading, bool is_temporary);
  MotionId add_motion(Motion motion);
  std::pair<MotionId, MotionId> add_both_ways(KindId kind, PlaceId a, PlaceId b,
                                              const std::vector<geometry::Point2>& path_in_map, bool is_temporary);
  void end_place(PlaceId id);
  void end_motion(MotionId id);
  bool is_joined(PlaceId a, PlaceId b) const;

  // --- the map: repair.cpp
  void make_near(KindId kind, const Box& changed);
  void take_away_blocked(KindId kind, const Box& region);
  void retire(PlaceId id);
  void retire_motion(MotionId id);
  void take_away(PlaceId id);
  void take_away_motion(MotionId id);
  Ids make_turning_places(KindId kind, const Work& work);
  void find_corridors(KindId kind);
  bool is_spur(PlaceId id) const;

  // --- steered_places.cpp: kinds that do not turn on the spot
  void make_steered_places(KindId kind, const Box& region);
  void join_steered(PlaceId id);
  bool join_by_arcs(PlaceId id, PlaceId other, bool leaves);
  PlaceId nearest_pose(KindId kind, const geometry::Pose2& base_in_map) const;
  PlaceId pose_id(KindId kind, std::int64_t number) const;
  void forget_pose(PlaceId id);

  // --- zones.cpp
  void make_anew_in(const fleet::Zone& zone);
  void make_ways_through(KindId kind, const Box& region);
  std::vector<Motion> ways_through_from(PlaceId entrance) const;
  bool has_way_round(PlaceId from, PlaceId to, double most_m) const;
  bool join_out_of_keep_out(PlaceId id);

  // --- temporary.cpp
  void join_temporary(PlaceId id);
  bool join_straight(PlaceId id, double reach_m);
  bool join_by_search(PlaceId id);
  void settle_temporary(PlaceId id);
  PlaceId place_at(KindId kind, const geometry::Pose2& base_in_map) const;
  MotionId motion_along(const Motion& wanted) const;
  void free_ended();

  // --- closures.cpp
  void close_place(PlaceId id, Closure& closure);
  void close_motion(MotionId id, Closure& closure);
  void make_room(Closure& closure);
  void closures_changed();

  double gap_m_;
  ZoneRules zones_;
  const grid::OccupancyGrid* bare_map_{nullptr};
  const grid::ClearanceField* clearance_{nullptr};
  grid::Geometry geometry_;
  std::vector<Net> nets_;                       // by kind
  std::vector<std::unique_ptr<Place>> places_;  // null: ended
  std::vector<std::unique_ptr<Motion>> motions_;
  std::vector<std::uint16_t> place_closed_by_;  // closures and edits that close it
  std::vector<std::uint16_t> motion_closed_by_;
  std::vector<PlaceId> temporary_places_;
  std::vector<MotionId> temporary_motions_;
  FloorBins<PlaceId> place_shapes_;  // of all kinds, by the standing shape
  FloorBins<MotionId> motion_shapes_;
  std::map<std::string, Closure> closures_;
  std::map<PlaceId, std::vector<double>> seconds_to_;
  Ended ended_;             // since the last sweep
  std::deque<Ended> told_;  // by the last sweeps
  Ended free_;              // told by earlier ones: these ids may be used again
  std::uint64_t revision_{0};
};

/// Seconds that a vehicle takes over a motion: length / (0.9 v), and 1 s a right angle to turn before it, 0.5 s when it
/// starts from standing (spec section 8.2).
double run_s(const Kind& kind, const Motion& motion, double heading_before_rad, bool from_standing);

}  // namespace aisle::global_planner::traffic
