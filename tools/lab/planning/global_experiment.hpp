#pragma once

#include <filesystem>
#include <string>

#include "tools/lab/page/page_template.hpp"
#include "tools/lab/page/progress.hpp"

namespace aisle::lab {

/// What the section is made from.
struct GlobalExperiment {
  std::filesystem::path maps;      // folder of the papers' maps
  std::filesystem::path pictures;  // folder that pictures are written to; must exist
  std::string pictures_from_page;  // the same, as the page links to it
  std::filesystem::path data;      // reference data (movingai, ros, queries); empty: that part is left out
  int random_maps{1000};           // a density
  int queries{50};                 // a real map
  std::string commit{"unknown"};   // that the program was built from
};

/// The section on global planning of docs/experiments.md. The same text for the same orders: nothing in it depends on
/// the machine.
FilledPage global_section(const GlobalExperiment& orders, const Progress& progress);

}  // namespace aisle::lab
