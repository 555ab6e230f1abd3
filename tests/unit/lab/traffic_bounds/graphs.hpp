#pragma once

// Graphs small enough to count on by hand.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "tools/lab/traffic_bounds/step_graph.hpp"

namespace aisle::lab {

inline StepGraph graph_of(std::size_t vertices, const std::vector<std::pair<Vertex, Vertex>>& edges) {
  StepGraph graph;
  graph.neighbours.resize(vertices);
  for (Vertex v = 0; v < vertices; ++v) graph.at_in_map.push_back({static_cast<double>(v), 0.0});
  for (const auto& [a, b] : edges) {
    graph.neighbours[a].push_back(b);
    graph.neighbours[b].push_back(a);
  }
  return graph;
}

/// 0 - 1 - ... - (vertices - 1).
inline StepGraph line(std::size_t vertices) {
  std::vector<std::pair<Vertex, Vertex>> edges;
  for (Vertex v = 0; v + 1 < vertices; ++v) edges.emplace_back(v, v + 1);
  return graph_of(vertices, edges);
}

/// Four neighbours; vertex y * side + x.
inline StepGraph square(std::size_t side) {
  std::vector<std::pair<Vertex, Vertex>> edges;
  for (std::size_t y = 0; y < side; ++y) {
    for (std::size_t x = 0; x < side; ++x) {
      const auto v = static_cast<Vertex>(y * side + x);
      if (x + 1 < side) edges.emplace_back(v, v + 1);
      if (y + 1 < side) edges.emplace_back(v, v + static_cast<Vertex>(side));
    }
  }
  return graph_of(side * side, edges);
}

/// Each vehicle stays or follows an edge, no two are at one vertex, and no two swap over an edge.
inline void expect_good_step(const StepGraph& graph, const std::vector<Vertex>& before,
                             const std::vector<Vertex>& after) {
  std::set<std::pair<Vertex, Vertex>> driven;
  for (std::size_t i = 0; i < after.size(); ++i) {
    const std::vector<Vertex>& near = graph.neighbours[before[i]];
    const bool follows_edge = std::find(near.begin(), near.end(), after[i]) != near.end();
    EXPECT_TRUE(after[i] == before[i] || follows_edge) << "vehicle " << i;
    if (after[i] != before[i]) driven.emplace(before[i], after[i]);
  }

  EXPECT_EQ(std::set<Vertex>(after.begin(), after.end()).size(), after.size()) << "two at one vertex";
  for (const auto& [from, to] : driven)
    EXPECT_EQ(driven.count({to, from}), 0U) << "a swap of " << from << " and " << to;
}

}  // namespace aisle::lab
