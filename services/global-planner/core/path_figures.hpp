#pragma once

#include <vector>

#include "common/grid/clearance.hpp"

namespace aisle::global_planner {

/// The figures by which the papers compare paths: of a planned path in map, before anything is driven.
struct PathFigures {
  double length_m{0.0};
  int nodes{0};                   // points of the path, both ends included
  int turning_points{0};          // nodes where the direction changes by more than 1e-6 rad
  double turning_angle_rad{0.0};  // all changes of direction together

  /// A safe lower bound between cell centres, see ClearanceField; at most the field's cap.
  double least_clearance_m{0.0};
};

/// Measures a path in map. Points that repeat the one before count as nodes, not as turns.
PathFigures path_figures(const grid::ClearanceField& clearance, const std::vector<geometry::Point2>& path_in_map);

}  // namespace aisle::global_planner
