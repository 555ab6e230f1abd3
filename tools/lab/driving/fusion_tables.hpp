#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/lab/driving/fused_drive.hpp"
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

/// Files of the pictures of curves that the page shows, one for each case that a paper prints curves of.
std::vector<std::string> curve_files();

/// May their figures stand beside each other? Both arrived and met what was asked for (DriveFigures::met).
bool are_comparable(const DriveFigures& a, const DriveFigures& b, const Surprises& asked);

/// Both arrived and were within 0.6 m of a wall or box, and this drive was slower there.
bool is_slower_near(const DriveFigures& drive, const DriveFigures& reference);

/// A drive in the table of curves: the mean speed near walls and boxes, the range and changes of w, the time, and
/// whether it met none of the movers that were asked for.
std::string curve_figures(const DriveFigures& drive, const Surprises& asked);

/// Drives all of them past the same movers and boxes (encounters_of_paper); curves of speed and turn rate and the ways
/// are written as SVG into `pictures`. The same text for the same
/// maps. @throws config::BadInput, config::BadEnvironment
FusionTables fusion_tables(const std::filesystem::path& maps, const std::filesystem::path& pictures,
                           const std::string& pictures_from_page, const Progress& progress);

}  // namespace aisle::lab
