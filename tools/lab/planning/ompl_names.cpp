#include <algorithm>

#include "tools/lab/planning/ompl_planners.hpp"

namespace aisle::lab {

const std::vector<std::string>& ompl_planner_names() {
  static const std::vector<std::string> names{"rrtconnect", "rrtstar", "informed-rrtstar", "bitstar"};
  return names;
}

bool is_ompl_planner(const std::string& name) {
  const std::vector<std::string>& names = ompl_planner_names();
  return std::find(names.begin(), names.end(), name) != names.end();
}

}  // namespace aisle::lab
