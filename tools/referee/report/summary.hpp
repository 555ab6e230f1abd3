#pragma once

#include <string>

#include "tools/referee/core/run_report.hpp"

namespace aisle::referee {

/// The table of figures that a run prints at its end; lines end with '\n'.
std::string summary(const RunReport& report);

}  // namespace aisle::referee
