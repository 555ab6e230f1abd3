#pragma once

#include <filesystem>
#include <string>

#include "tools/lab/page/progress.hpp"

namespace aisle::lab {

/// The papers' tables of global planning: published figures beside ours, on maps of their sizes
/// (deploy/experiments/*.txt), as Markdown. Writes one picture a map into `pictures`, which the page finds under
/// `pictures_from_page`.
/// @throws config::BadInput for a map that cannot be read
std::string paper_tables(const std::filesystem::path& maps, const std::filesystem::path& pictures,
                         const std::string& pictures_from_page, const Progress& progress);

}  // namespace aisle::lab
