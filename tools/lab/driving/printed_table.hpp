#pragma once
#include <filesystem>
#include <string>

#include "tools/lab/driving/encounters.hpp"
#include "tools/lab/page/progress.hpp"
#include "tools/sim/result.hpp"

namespace aisle::lab {

/// A fused planner on a map of its paper, with what the paper puts there.
struct PrintedCase {
  const char* paper;  // its global and its local planner
  const char* map;    // deploy/experiments/<map>.txt
  Surprises surprises;
};

/// Static and dynamic ones of each paper.
const std::vector<PrintedCase>& printed_cases();

/// The drive as printed (printed_setup), past encounters_of_paper. @throws config::BadInput without the map
sim::Result drive_as_printed(const PrintedCase& of, const std::filesystem::path& maps);

/// Markdown: how each of these drives ends as printed, beside our own drive past the same movers and boxes. The same
/// text on every machine. @throws config::BadInput without the maps
std::string printed_table(const std::filesystem::path& maps, const Progress& progress);

}  // namespace aisle::lab
