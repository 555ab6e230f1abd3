#pragma once

#include <filesystem>
#include <string>

#include "tools/lab/page/progress.hpp"

namespace aisle::lab {

/// Markdown of the papers' fused drives.
struct FusionTables {
  std::string lengths;     // the papers' and ours, driven and planned, metres
  std::string claims;      // the papers', and in how many of the drives they hold
  std::string smoothness;  // changes of speed and of turn rate, reference -> improved
  std::string curves;      // what the papers say of their curves, and ours
  std::string pictures;    // links to our curves
  std::string ways;        // links to pictures of all contestants' ways, one a map
};

/// Drives all of them past the same movers and boxes (encounters_of_paper); curves of speed and turn rate and the ways
/// are written as SVG into `pictures`. The same text for the same
/// maps. @throws config::BadInput, config::BadEnvironment
FusionTables fusion_tables(const std::filesystem::path& maps, const std::filesystem::path& pictures,
                           const std::string& pictures_from_page, const Progress& progress);

}  // namespace aisle::lab
