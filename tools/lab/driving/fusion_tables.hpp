#pragma once

#include <filesystem>
#include <string>

#include "tools/lab/page/progress.hpp"

namespace aisle::lab {

/// Markdown of the papers' fused drives.
struct FusionTables {
  std::string lengths;     // the papers' and ours, driven and planned, metres
  std::string claims;      // the papers', and in how many of the drives they hold
  std::string smoothness;  // changes of speed and of turn rate, A* + DWA -> improved
  std::string curves;      // what the papers say of their curves, and ours
  std::string pictures;    // links to our curves
};

/// Drives all of them; the curves of speed and turn rate are written as SVG into `pictures`. The same text for the same
/// maps. @throws config::BadInput, config::BadEnvironment
FusionTables fusion_tables(const std::filesystem::path& maps, const std::filesystem::path& pictures,
                           const std::string& pictures_from_page, const Progress& progress);

}  // namespace aisle::lab
