#include "services/global-planner/core/search_parameters.hpp"

#include <utility>

namespace aisle::global_planner {
namespace {

struct NamedPass {
  const char* name;
  Pass pass;
};

const std::vector<NamedPass>& named_passes() {
  static const std::vector<NamedPass> all{
      {"collinear", passes::collinear},
      {"collinear-but-one-beside-obstacles", passes::collinear_but_one_beside_obstacles},
      {"right-angle", passes::right_angle},
      {"line-of-sight", passes::greedy_line_of_sight},
      {"safe-distance", passes::safe_distance},
      {"interpolated-forward", passes::interpolated_forward},
      {"interpolated-at-safe-distance", passes::interpolated_at_safe_distance},
      {"interpolated-backward", passes::interpolated_backward}};
  return all;
}

NeighbourRule neighbours_of(const std::string& name) {
  if (name == "any") return kAnyDiagonal;
  if (name == "four") return kFourNeighbours;
  return kDrivableDiagonals;
}

}  // namespace

SearchShape search_shape(Parameters& parameters, Closed closed, const std::string& passes) {
  const std::string neighbours =
      parameters.word("neighbours", "drivable", {"drivable", "any", "four"},
                      "diagonal steps: those that cut no corner (LI's sub-nodes), also through corners, or none");
  const std::string on_lower_cost =
      parameters.word("closed", closed == Closed::kReopen ? "reopen" : "stay", {"reopen", "stay"},
                      "an expanded cell that is reached at less cost");
  std::vector<std::string> names;
  for (const NamedPass& named : named_passes()) names.emplace_back(named.name);

  std::vector<Pass> chosen;
  for (const std::string& word : parameters.words("passes", passes, names, "optimise the path, in this order"))
    for (const NamedPass& named : named_passes())
      if (word == named.name) chosen.push_back(named.pass);
  return {on_lower_cost == "reopen" ? Closed::kReopen : Closed::kStay, neighbours_of(neighbours), std::move(chosen)};
}

}  // namespace aisle::global_planner
