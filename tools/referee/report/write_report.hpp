#pragma once

#include <filesystem>
#include <vector>

#include "common/fleet/zone.hpp"
#include "tools/referee/core/run_report.hpp"
#include "tools/referee/core/walls.hpp"

namespace aisle::referee {

/// Writes report.json, fleet.svg and speeds.svg into `folder`, made if missing; each file is whole or not there.
/// @throws std::system_error
void write_report(const RunReport& report, const Walls& walls, const std::filesystem::path& folder,
                  const std::vector<fleet::Zone>& zones = {});

}  // namespace aisle::referee
