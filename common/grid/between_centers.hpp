#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "common/grid/clearance.hpp"

namespace aisle::grid {

/// The square between the centres of four neighbouring cells, and what their clearances say about the
/// points in it. Points are given in cells from the lower left centre: s to the right, t upwards, both
/// in [0, 1].
///
/// Why the bounds hold, with d(p) the true distance from p to the union of occupied squares, all in
/// cells:
///
/// 1. d(p) >= the least d of the four centres. A square covers [k-1/2, k+1/2] along each axis, so along
/// each axis p is no nearer to it than the nearer of the two centre coordinates.
///
/// 2. d is the least of the distances to single squares, each of them convex. For a square outside the
/// four cells, bilinear interpolation overestimates the convex distance by at most kWorst, and by at
/// most kSlope (s(1-s) + t(1-t)). Both were found by scanning all squares near by; a test against brute
/// force guards them.
///
/// 3. If one of the four cells is occupied, it decides: everything outside the four is at least half a
/// cell away.
class BetweenCenters {
 public:
  /// In cells from the lower left centre, each in [0, 1].
  struct Point {
    double s;
    double t;
  };

  /// `x`, `y`: the cell with the lower left centre; may be -1, since outside the grid is occupied.
  BetweenCenters(const ClearanceField& field, int x, int y);

  /// The coordinate itself, or the centre line that rounding has just missed.
  static double snapped(double cells) {
    const auto whole = static_cast<double>(static_cast<std::int64_t>(cells + (cells < 0.0 ? -0.5 : 0.5)));
    return std::fabs(cells - whole) < 1e-9 ? whole : cells;
  }

  /// Lower bound in metres of the clearance at a point, exact at the four centres.
  double clearance_m(Point p) const;

  /// The same for a point on none of the square's edges, of corners (lower left, lower right, upper left, upper right)
  /// that are all free; 0 when one is not. Number: double, or geometry::Batch for four points.
  template <class Number>
  [[gnu::always_inline]] static Number between_free_m(const Number (&corner_m)[4], const Number& s, const Number& t,
                                                      double cell_m) {
    const Number lower = corner_m[1] < corner_m[0] ? corner_m[1] : corner_m[0];
    const Number upper = corner_m[3] < corner_m[2] ? corner_m[3] : corner_m[2];
    const Number least = upper < lower ? upper : lower;
    const Number below = corner_m[0] + s * (corner_m[1] - corner_m[0]);
    const Number above = corner_m[2] + s * (corner_m[3] - corner_m[2]);
    const Number worst = Number{} + kWorst;
    const Number bent = kSlope * (s * (1.0 - s) + t * (1.0 - t));
    const Number slack = bent < worst ? bent : worst;
    const Number blended = below + t * (above - below) - slack * cell_m;

    return least > 0.0 ? (least < blended ? blended : least) : Number{};
  }

  /// True when the clearance is surely at least `radius_m`, and above 0, all along the straight piece
  /// from a to b.
  bool is_free_along(Point a, Point b, double radius_m) const;

 private:
  /// Cells, of rule 2 above: the most that interpolation can say too much, and its slope near the
  /// centres.
  static constexpr double kWorst = 0.115;
  static constexpr double kSlope = 0.54;

  static constexpr double kFar = 1e9;

  /// Bilinear interpolation of the four corners, metres; and its least value along a piece.
  double blended_m(Point p) const;
  double least_blended_m(Point a, Point b) const;

  /// Least clearance of the centres that surround the piece: all four, or two when it lies on the line
  /// between them, or one.
  double least_around_m(Point a, Point b) const;

  /// From the point to the nearest occupied one of the four cells, at most half a cell, in metres.
  double nearest_of_four_m(Point p) const;

  /// Is the piece nowhere nearer than `radius_m` to those of the four cells that are occupied, and touches none?
  bool is_clear_of_four(Point a, Point b, double radius_m) const;

  double cell_m_;
  std::array<double, 4> corner_m_{};  // lower left, lower right, upper left, upper right
  double least_m_;
};

}  // namespace aisle::grid
