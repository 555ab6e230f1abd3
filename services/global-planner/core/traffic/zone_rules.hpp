#pragma once

#include <vector>

#include "common/fleet/zone.hpp"
#include "services/global-planner/core/traffic/shape.hpp"

namespace aisle::global_planner::traffic {

/// The axis-aligned box around the zone.
Box box_around(const fleet::Zone& zone);

/// Does any part of the shape lie in the zone?
bool meets(const fleet::Zone& zone, const Shape& shape);

/// Does the path lead against a one-way zone's direction where it lies in the zone? Up to 90 degrees off is along it.
/// False for zones of other kinds.
bool goes_against(const fleet::Zone& zone, const std::vector<geometry::Point2>& path_in_map);

/// What the zones of the map say of places to stand and of ways. Keep-out zones are no affair of it: their floor counts
/// as occupied in the clearance that the roadmap is made of.
class ZoneRules {
 public:
  ZoneRules() = default;
  explicit ZoneRules(std::vector<fleet::Zone> zones);

  const std::vector<fleet::Zone>& zones() const { return zones_; }

  /// May no vehicle stop with this floor under it?
  bool forbid_stopping(const Shape& standing) const;

  /// Is it floor on which no vehicle without a goal should rest? That where none may stop, and where only one may be.
  bool forbid_resting(const Shape& standing) const;

  bool is_parking(geometry::Point2 at_in_map) const;
  bool has_parking() const;

  /// Does the path lead against the direction of a one-way zone?
  bool forbid_way(const std::vector<geometry::Point2>& path_in_map) const;

  /// The least of `most_mps` and what the speed zones allow that the shape meets.
  double speed_mps(const Shape& swept, double most_mps) const;

  /// The floor that a vehicle holds which stands on the shape or sweeps it. Shapes of two vehicles that meet one zone
  /// for one vehicle meet each other, wherever in the zone they are.
  ///
  /// How: each gets the same point of the zone as a further part.
  Shape held(Shape shape) const;

 private:
  /// Calls `visit(zone)` for each zone of the kind that the shape meets.
  template <class Visit>
  void each_met(fleet::Zone::Kind kind, const Shape& shape, Visit&& visit) const;

  std::vector<fleet::Zone> zones_;
  std::vector<Box> boxes_;  // around each of them
};

}  // namespace aisle::global_planner::traffic
