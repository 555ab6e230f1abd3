#pragma once

#include <string>

#include "tools/lab/page/progress.hpp"

namespace aisle::lab {

/// The suite with every local planner: one table of planners, one of each planner's families. `seeds` a family.
std::string suite_tables(int seeds, const Progress& progress);

}  // namespace aisle::lab
