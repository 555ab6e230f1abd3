#include <algorithm>

#include "services/local-planner/core/critic.hpp"

namespace aisle::local_planner {

bool Variant::asks_for(const Critic& critic) const {
  return std::any_of(critics.begin(), critics.end(),
                     [&](const WeightedCritic& weighted) { return weighted.critic == critic; });
}

const Variant* find_variant(const std::string& name) {
  const std::vector<Variant>& variants = all_variants();
  const auto found =
      std::find_if(variants.begin(), variants.end(), [&](const Variant& variant) { return variant.name == name; });
  return found == variants.end() ? nullptr : &*found;
}

std::string variant_names() {
  std::string names;
  for (const Variant& variant : all_variants()) names += (names.empty() ? "" : ", ") + variant.name;
  return names;
}

}  // namespace aisle::local_planner
