#pragma once

#include <nlohmann/json_fwd.hpp>

#include "tools/referee/core/run_report.hpp"

namespace aisle::referee {

/// report.json: one object; figures that were not measured are null. Seconds, metres, milliseconds, as their names say.
nlohmann::ordered_json to_json(const RunReport& report);

}  // namespace aisle::referee
