#pragma once
#include <filesystem>
#include <string>

namespace aisle::scenario {

/// Where a file that a scenario names lies. "data:ros/nav2_depot.yaml" is looked for in $AISLE_DATA, else in
/// ../shared/data beside the tree that `scenario_file` is in, or beside the working directory; other names are relative
/// to the scenario file.
/// @throws config::BadInput when there is no such file; for data: it says what to set
std::filesystem::path find_named_file(const std::string& name, const std::filesystem::path& scenario_file);

}  // namespace aisle::scenario
