#pragma once

#include <string>
#include <vector>

#include "common/fleet/map_edit.hpp"

namespace aisle::cli {

/// The shape of an edit as typed; one of the three.
struct TypedShape {
  std::string rectangle;             // "x1,y1,x2,y2"
  std::string disc;                  // "x,y,radius"
  std::vector<std::string> polygon;  // "x,y" each, 3 to 64 corners
};

/// Fills shape, points and radius of `edit`. @throws config::BadInput for none, several, or numbers that do not fit
void set_shape(const TypedShape& typed, fleet::MapEdit& edit);

}  // namespace aisle::cli
