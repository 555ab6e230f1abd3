#pragma once

#include <random>
#include <vector>

#include "services/global-planner/core/traffic/shape.hpp"

namespace aisle::global_planner::traffic {

/// One to three capsules with spines of up to 2 m in a square of `size_m` metres, radii up to 0.6 m; every fourth spine
/// is a point.
inline Shape random_shape(std::mt19937& random, double size_m) {
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };

  std::vector<Capsule> capsules;
  for (int left = std::uniform_int_distribution<>(1, 3)(random); left > 0; --left) {
    const geometry::Point2 from{uniform(0.0, size_m), uniform(0.0, size_m)};
    const double length_m = random() % 4 == 0 ? 0.0 : uniform(0.0, 2.0);
    const double angle = uniform(-geometry::kPi, geometry::kPi);
    capsules.push_back({from, from + length_m * geometry::Point2{std::cos(angle), std::sin(angle)}, uniform(0.0, 0.6)});
  }

  return Shape(capsules);
}

}  // namespace aisle::global_planner::traffic
