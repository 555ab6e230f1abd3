#include "tools/lab/traffic_bounds/step_graph.hpp"

#include <algorithm>
#include <string>

#include "common/config/reader.hpp"

namespace aisle::lab {

using global_planner::traffic::KindId;
using global_planner::traffic::Motion;
using global_planner::traffic::MotionId;
using global_planner::traffic::Place;
using global_planner::traffic::PlaceId;
using global_planner::traffic::Roadmap;

StepGraph step_graph(const Roadmap& roadmap, KindId kind) {
  StepGraph graph;
  std::vector<Vertex> vertex_of(roadmap.places(), kNoVertex);
  std::vector<PlaceId> place_of;

  for (PlaceId id = 0; id < roadmap.places(); ++id) {
    const Place& place = roadmap.place(id);
    if (place.kind != kind || place.is_closed || place.is_temporary || place.leaving.empty()) continue;

    vertex_of[id] = static_cast<Vertex>(place_of.size());
    place_of.push_back(id);
    graph.at_in_map.push_back(place.base_in_map.position());
  }

  graph.neighbours.resize(place_of.size());
  for (Vertex from = 0; from < place_of.size(); ++from) {
    for (const MotionId id : roadmap.place(place_of[from]).leaving) {
      const Motion& motion = roadmap.motion(id);
      const Vertex to = motion.is_closed ? kNoVertex : vertex_of[motion.to];
      if (to != kNoVertex && to != from) graph.neighbours[from].push_back(to);
    }

    std::vector<Vertex>& all = graph.neighbours[from];
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
  }

  return graph;
}

StepTable steps_to(const StepGraph& graph, Vertex goal) {
  StepTable steps(graph.size(), kNoWay);
  std::vector<Vertex> reached{goal};
  steps[goal] = 0;

  for (std::size_t next = 0; next < reached.size(); ++next) {
    for (const Vertex neighbour : graph.neighbours[reached[next]]) {
      if (steps[neighbour] != kNoWay) continue;
      steps[neighbour] = steps[reached[next]] + 1;
      reached.push_back(neighbour);
    }
  }

  return steps;
}

std::vector<bool> in_largest_part(const StepGraph& graph) {
  std::vector<bool> is_known(graph.size(), false), largest(graph.size(), false);
  std::size_t most = 0;

  for (Vertex first = 0; first < graph.size(); ++first) {
    if (is_known[first]) continue;

    const StepTable steps = steps_to(graph, first);
    std::vector<bool> part(graph.size(), false);
    std::size_t count = 0;
    for (Vertex v = 0; v < graph.size(); ++v) {
      if (steps[v] == kNoWay) continue;
      part[v] = is_known[v] = true;
      ++count;
    }

    if (count <= most) continue;
    most = count;
    largest = std::move(part);
  }

  return largest;
}

Vertex nearest_vertex(const StepGraph& graph, geometry::Point2 in_map, const std::vector<bool>& may_be) {
  Vertex best = kNoVertex;
  double least_m = std::numeric_limits<double>::infinity();

  for (Vertex v = 0; v < graph.size(); ++v) {
    const double away_m = geometry::distance(graph.at_in_map[v], in_map);
    if (away_m >= least_m || (!may_be.empty() && !may_be[v])) continue;
    least_m = away_m;
    best = v;
  }

  return best;
}

std::vector<Vertex> distinct_vertices(const StepGraph& graph, const std::vector<geometry::Point2>& points_in_map) {
  std::vector<bool> is_free = in_largest_part(graph);
  std::vector<Vertex> out;

  for (const geometry::Point2 point : points_in_map) {
    const Vertex vertex = nearest_vertex(graph, point, is_free);
    if (vertex == kNoVertex)
      throw config::BadInput("the roadmap has no room for " + std::to_string(points_in_map.size()) + " vehicles");

    is_free[vertex] = false;
    out.push_back(vertex);
  }

  return out;
}

}  // namespace aisle::lab
