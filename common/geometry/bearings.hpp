#pragma once

#include "common/geometry/batch.hpp"
#include "common/geometry/pose.hpp"

namespace aisle::geometry {

/// The angle of (x, y) from the x axis, in [-pi, pi], in radians: std::atan2 of a double or of a Batch, without a
/// branch; right to 1e-15 rad. 0 for (0, 0).
///
/// How (atan of the Cephes library, Moshier 1989): the point is mirrored into the half quadrant where 0 <= y <= x;
/// above 33.4 degrees (y / x > 0.66), pi/4 is taken off by tan(a - pi/4) = (y - x) / (y + x); the rest is t + t^3
/// P(t^2) / Q(t^2). Then each mirror is undone. kHalfPiError is what pi/2 as a double lacks.
template <class Number>
[[gnu::always_inline]] inline Number bearing_rad(const Number& y, const Number& x) {
  constexpr double kQuarterPi = 0.25 * kPi, kHalfPi = 0.5 * kPi, kHalfPiError = 6.123233995736765886130e-17;
  constexpr double kSteep = 0.66;
  const Number along = x < 0.0 ? -x : x, across = y < 0.0 ? -y : y;
  const Number less = across < along ? across : along, more = across < along ? along : across;
  const Number difference = less - more, sum = less + more;

  const auto is_steep = less > kSteep * more;
  const Number divided = is_steep ? difference : less, by = is_steep ? sum : more;
  const Number t = divided / (by > 0.0 ? by : Number{} + 1.0);
  const Number z = t * t;
  const Number p =
      (((-8.750608600031904122785e-1 * z - 1.615753718733365076637e1) * z - 7.500855792314704667340e1) * z -
       1.228866684490136173410e2) *
          z -
      6.485021904942025371773e1;
  const Number q =
      ((((z + 2.485846490142306297962e1) * z + 1.650270098316988542046e2) * z + 4.328810604912902668951e2) * z +
       4.853903996359136964868e2) *
          z +
      1.945506571482613964425e2;
  const Number rest = t + t * (z * p / q);

  const Number below_diagonal = is_steep ? kQuarterPi + (rest + 0.5 * kHalfPiError) : rest;
  const Number in_quadrant = along < across ? kHalfPi - (below_diagonal - kHalfPiError) : below_diagonal;
  const Number upper_half = x < 0.0 ? kPi - (in_quadrant - 2.0 * kHalfPiError) : in_quadrant;

  return y < 0.0 ? -upper_half : upper_half;
}

}  // namespace aisle::geometry
