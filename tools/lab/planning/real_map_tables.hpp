#pragma once

#include <filesystem>
#include <string>

#include "tools/lab/page/progress.hpp"

namespace aisle::lab {

/// Every planner on the maps of the reference data, `queries` of each map's .q file: for a point, and on the ROS maps
/// for a radius of 0.3 m where start and goal offer that. @throws config::BadInput
std::string real_map_tables(const std::filesystem::path& data, int queries, const Progress& progress);

}  // namespace aisle::lab
