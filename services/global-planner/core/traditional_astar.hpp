#pragma once

#include <memory>

#include "services/global-planner/core/planner.hpp"

namespace aisle::global_planner {

/// Estimates of the way left; moves of one step.
enum class Heuristic { kEuclidean, kChebyshev, kOctile };
enum class Moves { kEight, kFour };

/// The A* that the five papers compare with, as they draw it (row G1): it steps diagonally through the corners of
/// obstacles, so its paths are for comparison only and no vehicle may drive them. Not among all_variants(); a vehicle's
/// baseline is `astar`. Euclidean: LI, WU, QU, YU; Chebyshev: WANG. LI's figures (18.00 on a map of 10x10) are those of
/// four moves.
std::unique_ptr<Planner> traditional_astar(Heuristic heuristic, Moves moves = Moves::kEight);

}  // namespace aisle::global_planner
