#pragma once
#include "common/geometry/body.hpp"

namespace aisle::geometry {

/// Distance between the outlines of two bodies; negative where they overlap: then they must move by that much to come
/// apart (separating axes: Gottschalk, Lin, Manocha 1996). Exact for discs and rectangles.
double separation_m(const Body& a, const Body& b);

}  // namespace aisle::geometry
