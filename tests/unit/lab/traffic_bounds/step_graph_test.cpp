#include "tools/lab/traffic_bounds/step_graph.hpp"

#include <gtest/gtest.h>

#include "common/config/reader.hpp"
#include "common/grid/clearance.hpp"
#include "tests/unit/lab/traffic_bounds/graphs.hpp"

namespace aisle::lab {
namespace {

TEST(StepGraph, CountsStepsAndKnowsWhatCannotBeReached) {
  const StepGraph graph = graph_of(5, {{0, 1}, {1, 2}, {3, 4}});

  EXPECT_EQ(steps_to(graph, 2), (StepTable{2, 1, 0, kNoWay, kNoWay}));
  EXPECT_EQ(in_largest_part(graph), (std::vector<bool>{true, true, true, false, false}));
}

TEST(StepGraph, GivesEachPointAVertexOfItsOwnInTheLargestPart) {
  const StepGraph graph = graph_of(5, {{0, 1}, {1, 2}, {3, 4}});

  EXPECT_EQ(distinct_vertices(graph, {{1.1, 0.0}, {1.1, 0.0}, {4.0, 0.0}}), (std::vector<Vertex>{1, 2, 0}));
  EXPECT_THROW(distinct_vertices(graph, std::vector<geometry::Point2>(4)), config::BadInput);
}

TEST(StepGraph, OfARoadmapHasItsPlacesAndMotionsBothWays) {
  grid::OccupancyGrid grid{grid::Geometry{120, 80, 0.1, {0.0, 0.0}}};
  const grid::ClearanceField clearance(grid);
  global_planner::traffic::Roadmap roadmap;
  roadmap.set_map(clearance, {0, 0}, {119, 79});
  global_planner::traffic::Kind kind;
  kind.footprint = geometry::disc(0.35);
  const StepGraph graph = step_graph(roadmap, roadmap.kind(kind));

  EXPECT_GT(graph.size(), 20U);
  for (Vertex a = 0; a < graph.size(); ++a) {
    EXPECT_FALSE(graph.neighbours[a].empty());
    for (const Vertex b : graph.neighbours[a]) {
      const std::vector<Vertex>& back = graph.neighbours[b];
      EXPECT_NE(std::find(back.begin(), back.end(), a), back.end());
    }
  }
}

}  // namespace
}  // namespace aisle::lab
