#include "services/global-planner/core/variant.hpp"

#include <algorithm>

namespace aisle::global_planner {

std::unique_ptr<Planner> Variant::make() const {
  Parameters none;
  return build(none);
}

std::unique_ptr<Planner> Variant::make(Parameters parameters) const {
  std::unique_ptr<Planner> planner = build(parameters);
  parameters.refuse_unknown();
  return planner;
}

std::vector<Parameter> Variant::parameters() const {
  Parameters none;
  build(none);
  return none.known();
}

const Variant* find_variant(const std::string& name) {
  const std::vector<Variant>& variants = all_variants();
  const auto found = std::find_if(variants.begin(), variants.end(), [&](const Variant& v) { return v.name == name; });
  return found == variants.end() ? nullptr : &*found;
}

}  // namespace aisle::global_planner
