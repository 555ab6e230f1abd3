#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <unordered_map>
#include <vector>

#include "services/global-planner/core/traffic/reservations.hpp"
#include "services/global-planner/core/traffic/roadmap.hpp"

namespace aisle::global_planner::traffic {

/// When a vehicle drives a motion.
struct Leg {
  MotionId motion{kNoId};
  double begin_s{0.0};
  double end_s{0.0};
};

/// Where and when a way begins: at the end of what is granted to the vehicle.
struct Departure {
  KindId kind{0};
  PlaceId place{kNoId};
  double time_s{0.0};
  double heading_rad{0.0};
  bool is_standing{true};
  MotionId before{kNoId};  // the last granted motion, whose corner with the first one counts; none: no corner
};

/// Where the way shall end. Both ends are free for ever in the view of the search.
struct Destination {
  PlaceId place{kNoId};                  // one place,
  std::function<bool(PlaceId)> is_rest;  // or, where `place` is none, the soonest of these
};

/// The soonest way of one vehicle between the reservations of all others, in space and time (safe intervals, after
/// Phillips and Likhachev 2011).
///
///   state    place, heading (8), interval in which the place is free; for each only the earliest arrival counts
///   motion   leaves at the earliest time at which it is free of others for as long as it runs, the place that it
///            leaves is free until then, and the place that it reaches is free when it arrives
///   order    arrival + weight * seconds alone to the goal
class SpaceTimeSearch {
 public:
  struct Settings {
    std::size_t most_expanded{40'000};
    double merge_s{0.3};
    double heuristic_weight{1.2};
  };

  SpaceTimeSearch(Roadmap& roadmap, Meetings& meetings, const Reservations& reservations, const Settings& settings)
      : roadmap_(roadmap), meetings_(meetings), reservations_(reservations), settings_(settings) {}

  /// @return the legs, empty when the vehicle may stay where it is; nothing when there is no way or the budget ends
  std::optional<std::vector<Leg>> find(const Departure& from, const Destination& to, const View& view);

  /// The earliest times at which these motions, one after the other, can be driven; the vehicle waits only between
  /// them. Nothing when they cannot.
  std::optional<std::vector<Leg>> time(const Departure& from, const std::vector<MotionId>& motions, const View& view);

  /// Is the place free for ever, from `from_s` on?
  bool is_free_for_ever(PlaceId place, double from_s, const View& view);

  /// Does a time come from which on the place is free for ever?
  bool gets_free(PlaceId place, const View& view);

  /// Seconds alone from the place, which may be temporary, to the goal.
  double alone_s(PlaceId from, PlaceId goal);

  /// Corridors in which others rest: whoever enters one waits until the rest has ended.
  /// @param rests of a corridor, by its number
  void set_corridor_rests(const std::unordered_map<std::uint32_t, std::vector<ReservationId>>& rests) {
    corridor_rests_ = &rests;
  }

  /// May a vehicle drive the motion? Nobody may enter a closed place. Out of one lead the motions that are open, and
  /// where an edit took the place away all that lead to open places.
  static bool may_drive(const Motion& motion, const Place& from, const Place& to);

  /// States expanded since the beginning, of all searches.
  std::uint64_t expanded() const { return expanded_; }

 private:
  struct Node {
    PlaceId place{kNoId};
    std::uint32_t interval{0};  // of the place
    double time_s{0.0};
    double heading_rad{0.0};
    MotionId by{kNoId};
    double left_s{0.0};  // when the motion began
    std::uint32_t parent{kNoId};
    bool is_standing{false};
  };

  struct Open {
    double order_s{0.0};
    double time_s{0.0};
    std::uint32_t node{0};
  };

  // What is known of a place or shape in this search; good while `search` is the number of this search.
  struct PlaceNotes {
    std::uint64_t search{0};
    std::uint32_t first{0};  // free intervals in free_
    std::uint32_t count{0};
    std::uint32_t visited{0};  // first of count * 8 earliest arrivals in visited_
  };
  struct ShapeNotes {
    std::uint64_t search{0};
    std::uint32_t first{0};  // taken intervals in busy_
    std::uint32_t count{0};
  };

  void begin(const View& view);
  const PlaceNotes& notes_of(PlaceId place);
  const PlaceNotes& notes_of_start(PlaceId place, double time_s);
  const ShapeNotes& notes_of_shape(ShapeId shape);
  PlaceNotes& write_free(PlaceId place, const Intervals& taken);

  double earliest(ShapeId shape, double from_s, double run_s);
  double earliest_into_corridor(const Motion& motion, double from_s) const;
  double earliest_corner(const Node& from, MotionId motion, double from_s, double run_s);
  double earliest_departure(const Node& from, MotionId motion, double from_s, double run_s);

  void push(Node node, double to_go_s);
  void expand(std::uint32_t from, const std::vector<double>* alone_s);
  void try_motion(std::uint32_t from, MotionId id, double to_go_s);
  bool is_end(const Node& node, const Destination& to) const;
  std::vector<Leg> legs_to(std::uint32_t node) const;
  double to_go_s(PlaceId place, const std::vector<double>* alone_s) const;

  Roadmap& roadmap_;
  Meetings& meetings_;
  const Reservations& reservations_;
  Settings settings_;
  const std::unordered_map<std::uint32_t, std::vector<ReservationId>>* corridor_rests_{nullptr};

  // The search that runs.
  View view_;
  PlaceId goal_{kNoId};
  std::uint64_t search_{0};
  std::vector<Node> nodes_;
  std::vector<Open> open_;
  std::vector<PlaceNotes> places_;
  std::vector<ShapeNotes> shapes_;
  Intervals free_;
  Intervals busy_;
  Intervals scratch_;
  std::vector<double> visited_;

  std::uint64_t expanded_{0};
};

}  // namespace aisle::global_planner::traffic
