#pragma once

#include <string>
#include <vector>

#include "services/global-planner/core/variant.hpp"

namespace aisle::lab {

/// The planners of these names, in their order; every one when no name is given.
/// @throws config::BadInput for an unknown name, with the nearest one and all there are
std::vector<const global_planner::Variant*> chosen_planners(const std::vector<std::string>& names);

}  // namespace aisle::lab
