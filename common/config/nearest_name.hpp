#pragma once

#include <string>
#include <vector>

namespace aisle::config {

/// The candidate with the fewest edits (Levenshtein 1966) to `name`; empty when none is near enough to be what was
/// meant (more than two edits, and more than a third of the longer name).
std::string nearest_name(const std::string& name, const std::vector<std::string>& candidates);

}  // namespace aisle::config
