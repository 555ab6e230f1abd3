#pragma once

#include <string>

#include "tools/referee/core/run_report.hpp"

namespace aisle::referee {

/// Speed over time, one strip a vehicle on a common time axis: waiting shaded amber, holds red; goals reached, map
/// edits and contacts marked.
std::string speeds_svg(const RunReport& report);

}  // namespace aisle::referee
