#pragma once
#include <memory>
#include <string>
#include <vector>

#include "services/global-planner/core/best_first.hpp"
#include "services/global-planner/core/distances.hpp"
#include "services/global-planner/core/parameters.hpp"

// What the papers' searches share, as named parameters.
namespace aisle::global_planner {

/// `neighbours`: which diagonal steps a search may take. `passes`: what optimises its path. `closed`: whether a cell
/// that was expanded is expanded again when it is reached at a lower cost.
struct SearchShape {
  Closed closed;
  NeighbourRule neighbours;
  std::vector<Pass> passes;
};

/// Reads the shape; the defaults are what the paper prints.
/// @throws std::invalid_argument for an unknown word
SearchShape search_shape(Parameters& parameters, Closed closed, const std::string& passes);

/// Reads the parameter `heuristic` and calls `make` with a function from two cells to their distance in cells.
/// @throws std::invalid_argument for an unknown heuristic
template <class Make>
std::unique_ptr<Planner> with_heuristic(Parameters& parameters, const std::string& default_value, const Make& make) {
  const std::string name =
      parameters.word("heuristic", default_value, {"euclidean", "manhattan", "chebyshev", "octile"}, "distance h");
  if (name == "manhattan") return make(Manhattan{});
  if (name == "chebyshev") return make(Chebyshev{});
  if (name == "octile") return make(OctileDistance{});
  return make(Euclid{});
}

/// A best-first search of this shape with this evaluation.
template <class Evaluation>
std::unique_ptr<Planner> best_first(SearchShape shape, Evaluation evaluation) {
  return std::make_unique<BestFirst<Evaluation>>(shape.closed, shape.neighbours, std::move(shape.passes),
                                                 Looks::kAround, std::move(evaluation));
}

}  // namespace aisle::global_planner
