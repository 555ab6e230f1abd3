#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/lab/planning/tally.hpp"

namespace aisle::lab {

/// One object a planner, figures that are not there as null.
nlohmann::ordered_json json_of(const std::vector<Tally>& tallies);

/// The same as a table's rows, heading first.
std::vector<std::vector<std::string>> rows_of(const std::vector<Tally>& tallies);

}  // namespace aisle::lab
