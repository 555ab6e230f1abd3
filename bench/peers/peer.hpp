#pragma once

#include <cstddef>

namespace aisle::bench {

/// What a planner that is not ours answered. Lengths in cells, 8-connected without cut corners unless it says
/// otherwise.
struct PeerAnswer {
  bool is_found{false};
  double length_cells{0.0};
  std::size_t expanded{0};
};

}  // namespace aisle::bench
