#pragma once

#include <string>
#include <vector>

#include "common/fleet/zone.hpp"
#include "tools/referee/core/run_report.hpp"
#include "tools/referee/core/walls.hpp"

namespace aisle::referee {

/// The run as one picture: walls, zones, plans (thin), ways driven (thick, with the vehicle's outline every
/// kOutlineEvery_s), people (dotted), hidden blocks, map edits (hatched), goals, contacts (red), the figures and a
/// legend. Shows the part of the map where something happened.
std::string fleet_svg(const RunReport& report, const Walls& walls, const std::vector<fleet::Zone>& zones = {});

inline constexpr double kOutlineEvery_s = 3.0;

}  // namespace aisle::referee
