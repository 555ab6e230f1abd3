#pragma once

#include "common/geometry/body.hpp"

namespace aisle::geometry {

/// Distance in metres between the outlines of two bodies; negative where they overlap: then the least
/// way that one of them must move to come free (separating axes: Gottschalk, Lin, Manocha 1996). Exact
/// for discs and rectangles.
double separation_m(const Body& a, const Body& b);

}  // namespace aisle::geometry
