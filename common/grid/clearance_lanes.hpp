#pragma once
#include <array>
#include <cstddef>

#include "common/grid/clearance.hpp"

namespace aisle::grid {

/// So many points are looked up at once.
inline constexpr std::size_t kClearanceLanes = 32;

/// `ClearanceField::clearance_m` of 32 points in map, `x[i]`, `y[i]`, in metres; to the bit what it says of each, several times as fast.
/// @pre 32 values each; they may be anything, infinite too
void clearances_m(const ClearanceField& field, const double* x, const double* y, std::array<double, kClearanceLanes>& clearance_m);

}  // namespace aisle::grid
