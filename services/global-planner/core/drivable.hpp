#pragma once

#include <cstdint>

#include "common/grid/line_of_sight.hpp"
#include "services/global-planner/core/planner.hpp"

namespace aisle::global_planner {

/// A disc around a start or goal in which less than the full radius is accepted.
struct TightEnd {
  geometry::Point2 center_in_map;
  double range_m{0.0};   // 0: no exception
  double radius_m{0.0};  // that the end itself offers
};

/// Where the vehicle of one problem may be: the clearance field seen through its radius, tight ends included. Refers to
/// the problem's field, which must outlive it. @pre start and goal are in the map
class Drivable {
 public:
  explicit Drivable(const Problem& problem);

  /// Of the grid: size, resolution and origin.
  const grid::Geometry& geometry() const { return geometry_; }

  /// May the vehicle's centre be at the centre of this cell? False outside the grid.
  bool is_traversable(grid::Cell c) const { return geometry_.contains(c) && is_traversable(geometry_.index(c), c); }

  /// The same for a cell known to lie in the grid.
  bool is_traversable(std::size_t index, grid::Cell c) const {
    const float clearance_m = clearances_m_[index];
    return clearance_m >= least_m_ || (has_tight_end_ && is_traversable_at_tight_end(clearance_m, c));
  }

  /// What decides is_traversable(): the field, the least clearance in metres, and whether an end is an exception from
  /// it.
  std::uint64_t field_revision() const { return clearance_.revision(); }
  float least_m() const { return least_m_; }
  const float* clearances_m() const { return clearances_m_; }  // of every cell
  bool has_tight_end() const { return has_tight_end_; }

  /// The exceptions at both ends; range_m is 0 where there is none.
  const TightEnd& start() const { return start_; }
  const TightEnd& goal() const { return goal_; }

  /// Is the cell itself not free, whatever the vehicle's size? Outside the grid everything is.
  bool is_obstacle(grid::Cell c) const { return !geometry_.contains(c) || clearances_m_[geometry_.index(c)] <= 0.0F; }

  /// May the vehicle's centre be at this point?
  bool is_free(geometry::Point2 in_map) const { return clearance_.clearance_m(in_map) >= radius_at(in_map); }

  /// May the vehicle sweep the straight segment?
  bool is_line_free(geometry::Point2 from_in_map, geometry::Point2 to_in_map) const;

  /// The same; where one cell alone stopped it, `blocker` is that cell.
  bool is_line_free(geometry::Point2 from_in_map, geometry::Point2 to_in_map, grid::Blocker& blocker) const;

  /// Does this cell stop the vehicle on the straight segment as well? False when that is not sure.
  bool is_stopped_by(const grid::Blocker& blocker, geometry::Point2 from_in_map, geometry::Point2 to_in_map) const {
    return blocker.blocks(geometry_, from_in_map, to_in_map, radius_m_);
  }

  /// May the vehicle sweep the segment, and is it nowhere nearer to an obstacle than the problem's safe distance?
  bool is_line_safe(geometry::Point2 from_in_map, geometry::Point2 to_in_map) const;

 private:
  /// The exception at a start or goal that lies nearer to an obstacle than the radius, but not nearer than the bare
  /// vehicle.
  TightEnd tight_end(const Problem& problem, geometry::Point2 end_in_map) const;

  /// is_traversable() for a cell with less than the full radius, near an end with an exception.
  bool is_traversable_at_tight_end(float clearance_m, grid::Cell c) const;

  /// The radius to keep at this point.
  double radius_at(geometry::Point2 in_map) const;

  const grid::ClearanceField& clearance_;
  const grid::Geometry& geometry_;
  const float* clearances_m_;
  double radius_m_;
  double safe_distance_m_;
  float least_m_;  // radius_m_, rounded up
  TightEnd start_;
  TightEnd goal_;
  bool has_tight_end_;
};

}  // namespace aisle::global_planner
