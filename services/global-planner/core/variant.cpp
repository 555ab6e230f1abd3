#include "services/global-planner/core/variant.hpp"

#include <algorithm>

namespace aisle::global_planner {

const Variant* find_variant(const std::string& name) {
  const std::vector<Variant>& variants = all_variants();
  const auto found = std::find_if(variants.begin(), variants.end(), [&](const Variant& v) { return v.name == name; });
  return found == variants.end() ? nullptr : &*found;
}

}  // namespace aisle::global_planner
