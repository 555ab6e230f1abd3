#pragma once
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "services/global-planner/core/planner.hpp"

namespace aisle::lab {

/// What ends a search of a sampling planner, whichever comes first.
struct SamplingBounds {
  std::size_t iterations{0};       // of the planner's loop: a sample of RRT*, an edge or a batch of BIT*; 0: no bound
  double seconds{0.0};             // of wall time; 0: no bound
  bool ends_at_first_path{false};  // else the planner improves its path until a bound ends it
};

/// OMPL's sampling planners, comparators of the searches on the grid: "rrtconnect", "rrtstar", "informed-rrtstar",
/// "bitstar". The names are known also where OMPL is not built in.
const std::vector<std::string>& ompl_planner_names();
bool is_ompl_planner(const std::string& name);

/// "OMPL 1.5.2", or "" where the build found no OMPL.
std::string ompl_version();

/// Plans in the plane within the map, for the problem's disc, by the same checks of points and lines as our own
/// planners; the path is OMPL's own, neither shortened nor smoothed by us. `expanded` counts iterations. Each plan
/// begins from `seed`, so that without a bound in seconds the same problem has the same path; a search that ends
/// without one is out of time.
/// @throws config::BadEnvironment where OMPL is not built in, std::invalid_argument for another name
std::unique_ptr<global_planner::Planner> ompl_planner(const std::string& name, const SamplingBounds& bounds,
                                                      unsigned seed = 1);

}  // namespace aisle::lab
