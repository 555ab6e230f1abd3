#pragma once

#include <string>
#include <vector>

namespace aisle::cli {

/// The names in one line, separated by commas: "li, qu, wang".
std::string listed(const std::vector<std::string>& names);

/// @throws config::BadInput, with the nearest name, when `name` is none of `known`
void check_name(const char* flag, const std::string& name, const std::vector<std::string>& known);

/// The `name` of each variant of a planner, in the given order.
template <class Variant>
std::vector<std::string> names_of(const std::vector<Variant>& variants) {
  std::vector<std::string> names;
  for (const Variant& variant : variants) names.push_back(variant.name);
  return names;
}

}  // namespace aisle::cli
