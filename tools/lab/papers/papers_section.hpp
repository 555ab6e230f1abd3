#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "tools/lab/page/page_template.hpp"
#include "tools/lab/page/progress.hpp"
#include "tools/lab/papers/reproduce.hpp"

namespace aisle::lab {

struct PapersExperiment {
  std::filesystem::path pictures;  // folder that pictures are written to; must exist
  std::string pictures_from_page;  // the same, as the page links to it
  int maps{200};                   // of each kind, for paths
  int drives{30};                  // of each scene
  int seed{1};
};

/// The rows as the page shows them.
std::string papers_rows_table(const std::vector<ReproducedRow>& rows);

/// Writes pictures of the first maps of each kind into `folder`. Returns links to them, as the page has them.
std::string papers_pictures(const std::filesystem::path& folder, const std::string& from_page);

/// The section of docs/experiments.md on the five papers' tables, row by row, and on their maps.
FilledPage papers_section(const PapersExperiment& orders, const Progress& progress);

}  // namespace aisle::lab
