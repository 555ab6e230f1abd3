#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tools/lab/traffic_bounds/step_graph.hpp"

namespace aisle::lab {

/// Where all vehicles stand, step by step: from `starts` to the vertices to which the tables lead. LaCAM (Okumura
/// 2023).
///
///   node        where each vehicle stands
///   constraint  moves that are prescribed to the first few vehicles; each node tries them one more at a time, so all
///               joint steps are tried in the end
///
/// @param to_go of each vehicle the steps to its goal
/// @return nothing when there is none within so many configurations
std::optional<std::vector<std::vector<Vertex>>> find_configurations(const StepGraph& graph,
                                                                    const std::vector<Vertex>& starts,
                                                                    const std::vector<StepTable>& to_go,
                                                                    std::uint64_t seed,
                                                                    std::size_t most_configurations);

}  // namespace aisle::lab
