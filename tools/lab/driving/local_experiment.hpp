#pragma once

#include <filesystem>
#include <string>

#include "tools/lab/page/page_template.hpp"
#include "tools/lab/page/progress.hpp"

namespace aisle::lab {

/// What the section is made from.
struct LocalExperiment {
  std::filesystem::path maps;      // folder of the papers' maps
  std::filesystem::path pictures;  // folder that pictures are written to; must exist
  std::string pictures_from_page;  // the same, as the page links to it
  int seeds{30};                   // of each of the suite's families; 0: no suite
  std::string commit{"unknown"};   // that the program was built from
};

/// The section on local planning of docs/experiments.md. The same text for the same orders: nothing in it depends on
/// the machine.
FilledPage local_section(const LocalExperiment& orders, const Progress& progress);

}  // namespace aisle::lab
