#include "services/local-planner/core/inputs.hpp"

namespace aisle::local_planner {

bool outranks(const std::string& a, const std::string& b) { return a.size() != b.size() ? a.size() < b.size() : a < b; }

}  // namespace aisle::local_planner
