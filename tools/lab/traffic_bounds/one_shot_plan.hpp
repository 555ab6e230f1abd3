#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tools/lab/traffic_bounds/step_graph.hpp"

namespace aisle::lab {

/// A way of each vehicle to one goal, in unit steps: no two at one vertex, no two swap over an edge, and each stays at
/// its goal.
struct OneShotPlan {
  std::vector<std::vector<Vertex>> paths;  // of each vehicle, a vertex a step; all equally long
  std::uint64_t cost{0};                   // sum over the vehicles: steps until each is at its goal for good
  std::uint64_t least_cost{0};             // sum of the shortest ways, each vehicle alone

  /// At least 1; how much longer all together take than each alone.
  double stretch() const { return least_cost > 0 ? static_cast<double>(cost) / static_cast<double>(least_cost) : 1.0; }
};

/// Budgets count tries, not time: the same input gives the same plan.
struct OneShotBudget {
  std::size_t most_configurations{20'000};  // of the search for a first plan
  std::size_t rounds{1'500};                // of the improvement
};

/// A multi-agent plan without delays, to compare the traffic with.
///
/// How: a first plan by the search of the traffic's last resort, in unit steps (LaCAM, lazily constrained depth-first
/// search over where all vehicles stand, Okumura 2023, with PIBT as its generator). Then it is improved (large
/// neighbourhood search, Li et al. 2021): up to eight vehicles, of which one loses much and the others stand in its
/// shortest way, are planned anew one after the other between all others, and the sum of costs may not rise.
///
/// @param starts, goals all different each
/// @return nothing when the budget ends before there is a first plan
std::optional<OneShotPlan> plan_one_shot(const StepGraph& graph, const std::vector<Vertex>& starts,
                                         const std::vector<Vertex>& goals, std::uint64_t seed,
                                         const OneShotBudget& budget = {});

}  // namespace aisle::lab
