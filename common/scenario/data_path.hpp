#pragma once

#include <filesystem>
#include <string>

namespace aisle::scenario {

/// The path of a file that a scenario names.
///
/// "data:ros/nav2_depot.yaml" is looked for in $AISLE_DATA when that is set, else in ../shared/data
/// beside the tree that `scenario_file` is in, then beside the working directory. Other names are
/// relative to the folder of the scenario file. @throws config::BadInput when there is no such file;
/// for data: it says what to set
std::filesystem::path find_named_file(const std::string& name, const std::filesystem::path& scenario_file);

}  // namespace aisle::scenario
