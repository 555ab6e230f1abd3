#pragma once
#include <filesystem>
#include <string>

#include "tools/lab/planning/progress.hpp"

namespace aisle::lab {

/// The papers' tables of fused drives beside ours, their claims and whether they hold, and their speed curves, written
/// as SVG into `pictures`. The same text for the same maps. @throws config::BadInput, config::BadEnvironment
std::string fusion_tables(const std::filesystem::path& maps, const std::filesystem::path& pictures,
                          const std::string& pictures_from_page, const Progress& progress);

}  // namespace aisle::lab
