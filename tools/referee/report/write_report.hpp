#pragma once

#include <filesystem>

#include "tools/referee/core/run_report.hpp"
#include "tools/referee/core/walls.hpp"

namespace aisle::referee {

/// Writes report.json, fleet.svg and speeds.svg into `folder`, made if missing; each file is whole or not there.
/// @throws std::system_error
void write_report(const RunReport& report, const Walls& walls, const std::filesystem::path& folder);

}  // namespace aisle::referee
