#pragma once

#include <cstdint>
#include <random>
#include <vector>

#include "tools/lab/traffic_bounds/step_graph.hpp"

namespace aisle::lab {

/// One step of all vehicles on a StepGraph: plain PIBT (priority inheritance with backtracking; Okumura, Machida,
/// Defago, Tamura 2022). No two vehicles are at one vertex after the step, and no two swap over an edge.
///
/// How: vehicles choose in their order, each the free neighbour nearest to its goal. The vehicle that stands there
/// chooses next, with the chooser's priority; when it finds no vertex, the chooser takes its next best one.
class PibtStep {
 public:
  /// @param seed of the choice between neighbours that are as near; the graph must outlive this
  PibtStep(const StepGraph& graph, std::uint64_t seed);

  /// @param now the vertex of each vehicle, all different
  /// @param order all vehicles, the highest priority first
  /// @param to_go of each vehicle the steps to its goal
  /// @param next in: the vertex to which a vehicle must go, or kNoVertex; out: where each vehicle goes
  /// @return false: what is prescribed cannot be, or leaves a vehicle without a vertex
  bool plan(const std::vector<Vertex>& now, const std::vector<std::size_t>& order,
            const std::vector<const StepTable*>& to_go, std::vector<Vertex>& next);

 private:
  static constexpr std::uint32_t kNobody = std::numeric_limits<std::uint32_t>::max();

  bool take_prescribed(const std::vector<Vertex>& now, const std::vector<Vertex>& next);
  bool choose(std::size_t vehicle);
  std::vector<Vertex> wishes_of(std::size_t vehicle);
  void clear();

  const StepGraph& graph_;
  std::mt19937_64 random_;
  std::vector<std::uint32_t> stands_;  // at each vertex now, kNobody: free
  std::vector<std::uint32_t> comes_;   // to each vertex in this step

  // The step that is planned.
  const std::vector<Vertex>* now_{nullptr};
  const std::vector<const StepTable*>* to_go_{nullptr};
  std::vector<Vertex>* next_{nullptr};
  std::vector<Vertex> touched_;
};

}  // namespace aisle::lab
