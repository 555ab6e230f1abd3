// In place of ompl_planners.cpp where the build found no OMPL.
#include "common/config/reader.hpp"
#include "tools/lab/planning/ompl_planners.hpp"

namespace aisle::lab {

std::string ompl_version() { return ""; }

std::unique_ptr<global_planner::Planner> ompl_planner(const std::string& name, const SamplingBounds&, unsigned) {
  throw config::BadEnvironment(name +
                               " is a planner of OMPL, which is not built in: install libompl-dev "
                               "(deploy/packages/lab.txt) and build again");
}

}  // namespace aisle::lab
