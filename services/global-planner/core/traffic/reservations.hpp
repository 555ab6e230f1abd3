#pragma once

#include <cstdint>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "services/global-planner/core/traffic/floor_bins.hpp"
#include "services/global-planner/core/traffic/meetings.hpp"

namespace aisle::global_planner::traffic {

inline constexpr double kForEver = std::numeric_limits<double>::infinity();

/// A time from `from_s` to before `to_s`.
struct Interval {
  double from_s{0.0};
  double to_s{0.0};
};

/// Sorted by time, without overlap.
using Intervals = std::vector<Interval>;

using ReservationId = std::uint32_t;

/// A shape that a vehicle takes for a time.
struct Reservation {
  enum class Use {
    kStep,  // it drives a step
    kWait,  // it stands before a step; step numbers that step
    kRest,  // it stands at the end of its plan; step is the first number beyond the plan
  };

  std::uint32_t agent{kNoId};
  std::uint64_t step{0};
  Use use{Use::kStep};
  ShapeId shape{kNoId};
  double from_s{0.0};
  double to_s{0.0};
  bool is_granted{false};  // step or wait
  bool is_frozen{false};   // the vehicle is never moved
};

/// Which reservations count for a search, and for how long.
struct View {
  std::uint32_t agent{kNoId};    // its own do not count
  double soft_rest_s{kForEver};  // a rest ends so long after it began, or after `now_s`, whichever is later
  double now_s{0.0};
  bool granted_only{false};  // only what is granted or frozen counts
};

/// What all vehicles take of the floor in times to come, found by shape.
class Reservations {
 public:
  Reservations(Meetings& meetings, double merge_s) : meetings_(meetings), merge_s_(merge_s) {}

  ReservationId add(const Reservation& reservation);
  void remove(ReservationId id);

  /// Times and marks may be changed in place, agent and shape not.
  Reservation& operator[](ReservationId id) { return all_[id]; }
  const Reservation& operator[](ReservationId id) const { return all_[id]; }

  /// Gives the numbers of shapes that have ended to others, when there are many of them.
  void tidy_up();

  /// All reservations whose shapes meet this one, in a fixed order. @pre `visit` adds and removes none
  template <class Visit>
  void visit_meeting(ShapeId shape, Visit&& visit) const {
    for (const ShapeId other : met_by(shape))
      for (const ReservationId id : of_shape_[other]) visit(all_[id]);
  }

  /// When the shape is taken by others, sorted; taken times less than `merge_s` apart are one.
  /// @param out is cleared first
  void busy(ShapeId shape, const View& view, Intervals& out) const;

  /// The time for which the reservation counts in this view; empty (`to_s` <= `from_s`): it does not count.
  static Interval counted(const Reservation& reservation, const View& view);

  /// Sorts the intervals, and makes those that are less than `merge_s` apart one.
  static void merge(Intervals& intervals, double merge_s);

 private:
  /// Shapes that were reserved in this epoch and meet one shape.
  struct Near {
    std::uint32_t epoch{0};
    std::size_t judged{0};  // entries of reserved_ that were looked at
    std::vector<ShapeId> met;
  };

  struct Reserved {
    ShapeId shape{kNoId};
    Box box;
  };

  const std::vector<ShapeId>& met_by(ShapeId shape) const;
  void note_reserved(ShapeId shape);
  void begin_epoch();

  Meetings& meetings_;
  double merge_s_;

  std::vector<Reservation> all_;
  std::vector<ReservationId> free_;  // numbers in `all_` that are not in use
  std::vector<std::vector<ReservationId>> of_shape_;
  std::size_t shapes_in_use_{0};

  // Each pair of shapes is judged once in an epoch. An epoch ends when most shapes that were reserved in it are not any
  // more: so what is remembered stays small.
  std::uint32_t epoch_{1};
  std::vector<std::uint32_t> noted_;  // by shape: the last epoch in which it was reserved
  std::vector<Reserved> reserved_;    // in the order in which they were reserved first in this epoch
  FloorBins<ShapeId> bins_;           // the same
  mutable std::vector<Near> near_;    // by shape
};

}  // namespace aisle::global_planner::traffic
