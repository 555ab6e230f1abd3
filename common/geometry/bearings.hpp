#pragma once

#include "common/geometry/pose.hpp"

namespace aisle::geometry {

/// The angle of (x, y) from the x axis, in [-pi, pi]: std::atan2 of a number, or of a vector of them, without a branch;
/// right to 1e-15 rad. 0 for (0, 0). After atan of the Cephes library (Moshier 1989): pi/8 is taken off where the angle
/// is more than 33.4 degrees, the rest is a quotient of polynomials.
template <class Number>
[[gnu::always_inline]] inline void find_bearing_rad(const Number& y, const Number& x, Number& bearing_rad) {
  constexpr double kQuarter = 0.25 * kPi, kHalf = 0.5 * kPi, kRoundedOff = 6.123233995736765886130e-17;  // of kHalf
  const Number along = x < 0.0 ? -x : x, across = y < 0.0 ? -y : y;
  const Number less = across < along ? across : along, more = across < along ? along : across;
  const Number upper = less - more, lower = less + more;
  const auto is_steep = less > 0.66 * more;
  const Number divided = is_steep ? upper : less, by = is_steep ? lower : more;
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
  const Number within = is_steep ? kQuarter + (rest + 0.5 * kRoundedOff) : rest;
  const Number upright = along < across ? kHalf - (within - kRoundedOff) : within;
  const Number turned = x < 0.0 ? kPi - (upright - 2.0 * kRoundedOff) : upright;
  bearing_rad = y < 0.0 ? -turned : turned;
}

}  // namespace aisle::geometry
