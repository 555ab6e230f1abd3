#pragma once
#include <cstddef>
#include <random>
#include <vector>

#include "common/geometry/pose.hpp"

namespace aisle::local_planner {

inline geometry::Twist2 some_twist(std::mt19937_64& random) {
  std::uniform_real_distribution<double> speed(-0.5, 1.5), turn(-1.6, 1.6);
  const bool stands = random() % 8 == 0, is_straight = random() % 8 == 0;
  return {stands ? 0.0 : speed(random), is_straight ? 0.0 : turn(random), 0.0};
}

inline std::vector<geometry::Twist2> some_twists(std::mt19937_64& random, std::size_t count) {
  std::vector<geometry::Twist2> twists;
  for (std::size_t i = 0; i < count; ++i) twists.push_back(some_twist(random));
  return twists;
}

}  // namespace aisle::local_planner
