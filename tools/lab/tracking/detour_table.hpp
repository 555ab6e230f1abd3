#pragma once

#include <string>

#include "tools/lab/page/progress.hpp"

namespace aisle::lab {

/// The worth of prediction: the suite's drives among people with the tracks' velocities, and with every
/// track held still, `seeds` of each family. @returns a Markdown table, the same for the same seeds
std::string detour_table(int seeds, const Progress& progress);

}  // namespace aisle::lab
