#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "services/global-planner/core/search_memory.hpp"

namespace aisle::global_planner {

/// A step to a neighbouring cell, and its cost.
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

/// A diagonal only between two open orthogonal neighbours.
constexpr NeighbourRule drivable_diagonals() {
  NeighbourRule rule{};
  for (unsigned mask = 0; mask < 256; ++mask) {
    unsigned allowed = mask & 0x0FU;

    for (unsigned i = 0; i < 4; ++i) {
      const unsigned both = (1U << i) | (1U << ((i + 1U) % 4U));  // the diagonal between step i and the next one
      if ((mask & both) == both) allowed |= mask & (0x10U << i);
    }

    rule[mask] = static_cast<std::uint8_t>(allowed);
  }

  return rule;
}
constexpr NeighbourRule whatever_is_among(unsigned moves) {
  NeighbourRule rule{};
  for (unsigned mask = 0; mask < 256; ++mask) rule[mask] = static_cast<std::uint8_t>(mask & moves);
  return rule;
}
}  // namespace detail

/// Also through the corners of obstacles, as the papers draw traditional A*; no vehicle may drive that.
inline constexpr NeighbourRule kAnyDiagonal = detail::whatever_is_among(0xFF);

/// No diagonal step at all: LI's baseline.
inline constexpr NeighbourRule kFourNeighbours = detail::whatever_is_among(0x0F);

/// A diagonal step needs both orthogonal neighbours beside it: no corner is cut. This is also LI's sub-node rule (its
/// table I).
inline constexpr NeighbourRule kDrivableDiagonals = detail::drivable_diagonals();

/// Bit of each step's cell in a mask of the nine cells around one, row by row from the lower left; bit 4 is the cell
/// itself.
inline constexpr std::array<unsigned, 8> kBitInNine{5, 7, 3, 1, 8, 6, 0, 2};

/// Which steps are worth taking from a cell, by the step that led to it and by which of the nine cells around it are
/// traversable.
///
/// An exact search need not look back: a cell that is reached from x's parent as cheaply without x is left to the
/// parent (Harabor, Grastien 2011). What remains, without cut corners: after a diagonal step that step and its two
/// straight ones; after a straight step only that, and the turns around a corner that has just been passed. Why no
/// optimum is lost, whatever parent a cell keeps among equals: if some optimal parent of n lies straight beside it, any
/// optimal way into that parent leaves n among its steps, or n had a shorter way; if all lie diagonally, a straight
/// step into one of them before would give n a straight parent of equal cost.
class StepTable {
 public:
  static constexpr std::size_t kStart = 8;  // no step led here

  /// @param looks_back also steps that an exact search may leave out; with it the direction makes no difference
  StepTable(const NeighbourRule& rule, bool looks_back) {
    for (std::size_t direction = 0; direction <= kStart; ++direction) {
      for (unsigned nine = 0; nine < 512; ++nine) {
        unsigned open = 0;
        for (unsigned i = 0; i < 8; ++i) open |= ((nine >> kBitInNine[i]) & 1U) << i;

        const unsigned worth = looks_back || direction == kStart ? 0xFFU : ahead(direction, open);
        steps_[direction][nine] = static_cast<std::uint8_t>(rule[open] & worth);
      }
    }
  }

  /// @param direction of the step that led to the cell, or kStart
  /// @param nine which of the nine cells are traversable, as Surroundings::nine() has them
  unsigned steps(std::size_t direction, unsigned nine) const { return steps_[direction][nine]; }

 private:
  /// The steps worth taking after this one.
  static unsigned ahead(std::size_t direction, unsigned open) {
    const auto straight = [](std::size_t d) { return 1U << (d % 4); };
    const auto diagonal_after = [](std::size_t d) { return 0x10U << (d % 4); };  // between straight step d and the next
    if (direction >= 4) return diagonal_after(direction) | straight(direction) | straight(direction + 1);

    unsigned worth = straight(direction);

    // The cells beside the one before this: blocked, they hide what lies beside this one.
    const bool is_left_hidden = (open & diagonal_after(direction + 1)) == 0;
    const bool is_right_hidden = (open & diagonal_after(direction + 2)) == 0;

    if (is_left_hidden) worth |= straight(direction + 1) | diagonal_after(direction);
    if (is_right_hidden) worth |= straight(direction + 3) | diagonal_after(direction + 3);

    return worth;
  }

  std::array<std::array<std::uint8_t, 512>, kStart + 1> steps_{};
};

}  // namespace aisle::global_planner
