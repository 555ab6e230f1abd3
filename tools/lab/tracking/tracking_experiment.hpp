#pragma once

#include <filesystem>
#include <string>

#include "tools/lab/page/page_template.hpp"
#include "tools/lab/page/progress.hpp"

namespace aisle::lab {

/// What the section is made from.
struct TrackingExperiment {
  std::filesystem::path people;       // folder of the recordings; what is not there is left out
  std::filesystem::path empty_place;  // a scenario file, driven without its people and blocks
  std::filesystem::path pictures;     // folder that pictures are written to; must exist
  std::string pictures_from_page;     // the same, as the page links to it
  double longest_s{3600.0};           // of each recording
  double empty_s{600.0};              // in the empty place, at least
  int detour_seeds{8};                // drives of each family, with prediction and without; 0: left out
  std::string commit{"unknown"};      // that the program was built from
};

/// The section on the obstacle tracker of docs/experiments.md. The same text for the same orders: nothing in it depends
/// on the machine.
/// @throws config::BadInput when a file that is there cannot be used
FilledPage tracking_section(const TrackingExperiment& orders, const Progress& progress);

}  // namespace aisle::lab
