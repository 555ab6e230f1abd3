#pragma once
#include <array>
#include <cstdint>

#include "services/global-planner/core/search_memory.hpp"

namespace aisle::global_planner {

struct Step {
  int dx;
  int dy;
  std::uint32_t cost;
};

/// East, north, west, south, then the diagonals counter-clockwise from north-east. Bit i of a mask stands for step i.
inline constexpr std::array<Step, 8> kSteps{{{1, 0, kStraightCost},
                                             {0, 1, kStraightCost},
                                             {-1, 0, kStraightCost},
                                             {0, -1, kStraightCost},
                                             {1, 1, kDiagonalCost},
                                             {-1, 1, kDiagonalCost},
                                             {-1, -1, kDiagonalCost},
                                             {1, -1, kDiagonalCost}}};

/// Which steps a search may take, by the mask of traversable neighbours.
using NeighbourRule = std::array<std::uint8_t, 256>;

namespace detail {
constexpr NeighbourRule drivable_diagonals() {
  NeighbourRule rule{};
  for (unsigned mask = 0; mask < 256; ++mask) {
    unsigned allowed = mask & 0x0FU;
    for (unsigned i = 0; i < 4; ++i) {
      const unsigned both = (1U << i) | (1U << ((i + 1U) % 4U));   // the diagonal between step i and the next one
      if ((mask & both) == both) allowed |= mask & (0x10U << i);
    }
    rule[mask] = static_cast<std::uint8_t>(allowed);
  }
  return rule;
}
}  // namespace detail

/// A diagonal step needs both orthogonal neighbours beside it: no corner is cut. This is also LI's sub-node rule (its table I).
inline constexpr NeighbourRule kDrivableDiagonals = detail::drivable_diagonals();

}  // namespace aisle::global_planner
