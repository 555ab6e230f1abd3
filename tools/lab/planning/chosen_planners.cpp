#include "tools/lab/planning/chosen_planners.hpp"

#include "common/config/nearest_name.hpp"
#include "common/config/reader.hpp"

namespace aisle::lab {

std::vector<const global_planner::Variant*> chosen_planners(const std::vector<std::string>& names) {
  std::vector<const global_planner::Variant*> chosen;
  if (names.empty()) {
    for (const global_planner::Variant& variant : global_planner::all_variants()) chosen.push_back(&variant);
  }

  for (const std::string& name : names) {
    if (const global_planner::Variant* variant = global_planner::find_variant(name)) {
      chosen.push_back(variant);
      continue;
    }

    std::vector<std::string> known;
    for (const global_planner::Variant& variant : global_planner::all_variants()) known.push_back(variant.name);

    std::string all;
    for (const std::string& one : known) all += (all.empty() ? "" : ", ") + one;

    const std::string nearest = config::nearest_name(name, known);
    throw config::BadInput("--planner: '" + name + "' is unknown" +
                           (nearest.empty() ? "." : "; did you mean " + nearest + "?") + " There are " + all);
  }

  return chosen;
}

}  // namespace aisle::lab
