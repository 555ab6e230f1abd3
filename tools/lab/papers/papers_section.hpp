#pragma once
#include <filesystem>
#include <string>

#include "tools/lab/page/page_template.hpp"
#include "tools/lab/page/progress.hpp"

namespace aisle::lab {

struct PapersExperiment {
  std::filesystem::path pictures;  // folder that pictures are written to; must exist
  std::string pictures_from_page;  // the same, as the page links to it
  int maps{200};                   // of each kind, for paths
  int drives{30};                  // of each scene
  int seed{1};
};

/// The section of docs/experiments.md on the five papers' tables, row by row, and on their maps.
FilledPage papers_section(const PapersExperiment& orders, const Progress& progress);

}  // namespace aisle::lab
