#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "common/geometry/pose.hpp"
#include "services/global-planner/core/traffic/roadmap.hpp"

namespace aisle::lab {

/// A place of a StepGraph, by its index.
using Vertex = std::uint32_t;
inline constexpr Vertex kNoVertex = std::numeric_limits<Vertex>::max();

/// Steps from each vertex to one goal; kNoWay where there is none.
using StepTable = std::vector<std::uint32_t>;
inline constexpr std::uint32_t kNoWay = std::numeric_limits<std::uint32_t>::max();

/// A roadmap as plain multi-agent path finding sees it: one vehicle a vertex, and each motion takes one step, whatever
/// its length. Shapes, turns and speeds are left out.
struct StepGraph {
  std::vector<geometry::Point2> at_in_map;      // of each vertex
  std::vector<std::vector<Vertex>> neighbours;  // of each vertex, both ways, without itself

  std::size_t size() const { return neighbours.size(); }
};

/// The open places and motions of a kind that turns on the spot; nothing temporary.
StepGraph step_graph(const global_planner::traffic::Roadmap& roadmap, global_planner::traffic::KindId kind);

/// Breadth-first from the goal.
StepTable steps_to(const StepGraph& graph, Vertex goal);

/// Of each vertex: does it belong to the largest part whose vertices reach each other?
std::vector<bool> in_largest_part(const StepGraph& graph);

/// The vertex nearest to the point of those that `may_be` allows, empty: of all; kNoVertex: there is none.
Vertex nearest_vertex(const StepGraph& graph, geometry::Point2 in_map, const std::vector<bool>& may_be = {});

/// For each point the nearest vertex of the largest part that no point before has got.
/// @throws config::BadInput when there are more points than vertices
std::vector<Vertex> distinct_vertices(const StepGraph& graph, const std::vector<geometry::Point2>& points_in_map);

}  // namespace aisle::lab
