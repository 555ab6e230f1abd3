#include "services/local-planner/core/planner.hpp"

#include "services/local-planner/core/local_planner.hpp"
#include "services/local-planner/core/printed/printed_planner.hpp"

namespace aisle::local_planner {

std::unique_ptr<Planner> make_planner(const Settings& settings, const Variant& variant) {
  if (settings.as_printed) return std::make_unique<PrintedPlanner>(settings, variant);
  return std::make_unique<LocalPlanner>(settings, variant);
}

}  // namespace aisle::local_planner
