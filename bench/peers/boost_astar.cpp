#include "bench/peers/boost_astar.hpp"

#include <algorithm>
#include <array>
#include <boost/graph/astar_search.hpp>
#include <boost/iterator/iterator_facade.hpp>
#include <boost/property_map/function_property_map.hpp>
#include <boost/range/irange.hpp>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <utility>
#include <vector>

namespace aisle::bench {
namespace {

using Vertex = std::size_t;
using Edge = std::pair<Vertex, Vertex>;

constexpr std::array<grid::Cell, 8> kSteps{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}}};

/// The implicit graph: a vertex is a cell's index.
struct Grid {
  const grid::OccupancyGrid* cells;

  grid::Cell cell(Vertex v) const {
    const auto width = static_cast<Vertex>(cells->geometry().width);
    return {static_cast<int>(v % width), static_cast<int>(v / width)};
  }

  bool is_edge(grid::Cell at, grid::Cell step) const {
    if (!cells->is_free({at.x + step.x, at.y + step.y})) return false;
    return step.x == 0 || step.y == 0 ||
           (cells->is_free({at.x + step.x, at.y}) && cells->is_free({at.x, at.y + step.y}));
  }
};

/// Walks over the edges of a vertex that exist, in the order of kSteps.
class OutEdges : public boost::iterator_facade<OutEdges, Edge, boost::forward_traversal_tag, Edge> {
 public:
  OutEdges() = default;

  OutEdges(const Grid& grid, Vertex from, std::size_t step)
      : grid_(&grid), from_(from), at_(grid.cell(from)), step_(step) {
    skip();
  }

 private:
  friend class boost::iterator_core_access;

  void skip() {
    while (step_ < kSteps.size() && !grid_->is_edge(at_, kSteps[step_])) ++step_;
  }

  void increment() {
    ++step_;
    skip();
  }

  bool equal(const OutEdges& other) const { return step_ == other.step_; }

  Edge dereference() const {
    const grid::Cell step = kSteps[step_];
    return {from_, grid_->cells->geometry().index({at_.x + step.x, at_.y + step.y})};
  }

  const Grid* grid_{nullptr};

  Vertex from_{0};
  grid::Cell at_{};
  std::size_t step_{kSteps.size()};
};

/// What Boost.Graph's concepts are told of the graph.
struct Traversal : public virtual boost::vertex_list_graph_tag, public virtual boost::incidence_graph_tag {};

std::pair<OutEdges, OutEdges> out_edges(Vertex v, const Grid& grid) {
  return {OutEdges(grid, v, 0), OutEdges(grid, v, kSteps.size())};
}

std::size_t out_degree(Vertex v, const Grid& grid) {
  const auto [begin, end] = out_edges(v, grid);
  return static_cast<std::size_t>(std::distance(begin, end));
}

Vertex source(const Edge& edge, const Grid&) { return edge.first; }
Vertex target(const Edge& edge, const Grid&) { return edge.second; }
Vertex num_vertices(const Grid& grid) { return grid.cells->geometry().cells(); }

auto vertices(const Grid& grid) {
  const auto range = boost::irange<Vertex>(0, num_vertices(grid));
  return std::make_pair(range.begin(), range.end());
}

/// Thrown to end the search: Boost's visitors have no other way.
struct Found {};

}  // namespace
}  // namespace aisle::bench

template <>
struct boost::graph_traits<aisle::bench::Grid> {
  using vertex_descriptor = aisle::bench::Vertex;
  using edge_descriptor = aisle::bench::Edge;
  using directed_category = boost::directed_tag;
  using edge_parallel_category = boost::disallow_parallel_edge_tag;
  using traversal_category = aisle::bench::Traversal;
  using out_edge_iterator = aisle::bench::OutEdges;
  using degree_size_type = std::size_t;
  using vertices_size_type = std::size_t;
  using vertex_iterator = boost::range_iterator<boost::integer_range<std::size_t>>::type;

  static vertex_descriptor null_vertex() { return static_cast<vertex_descriptor>(-1); }
};

namespace aisle::bench {
namespace {

/// The exact distance on an empty grid with diagonal steps.
class Octile : public boost::astar_heuristic<Grid, double> {
 public:
  Octile(const Grid& grid, grid::Cell goal) : grid_(grid), goal_(goal) {}

  double operator()(Vertex v) const {
    const grid::Cell c = grid_.cell(v);
    const double dx = std::abs(c.x - goal_.x);
    const double dy = std::abs(c.y - goal_.y);
    return std::max(dx, dy) + (std::sqrt(2.0) - 1.0) * std::min(dx, dy);
  }

 private:
  const Grid& grid_;
  grid::Cell goal_;
};

/// Counts expansions and throws Found at the goal.
class StopAtGoal : public boost::default_astar_visitor {
 public:
  StopAtGoal(Vertex goal, std::size_t& expanded) : goal_(goal), expanded_(expanded) {}

  void examine_vertex(Vertex v, const Grid&) const {
    if (v == goal_) throw Found{};
    ++expanded_;
  }

 private:
  Vertex goal_;
  std::size_t& expanded_;
};

}  // namespace

struct BoostAstar::State {
  Grid grid;
  std::vector<Vertex> parents;
  std::vector<double> distances, ranks;
  std::vector<boost::default_color_type> colors;
};

BoostAstar::BoostAstar(const grid::OccupancyGrid& grid) : state_(std::make_unique<State>()) {
  state_->grid = {&grid};

  const std::size_t cells = grid.geometry().cells();
  state_->parents.resize(cells);
  state_->distances.resize(cells);
  state_->ranks.resize(cells);
  state_->colors.resize(cells);
}

BoostAstar::~BoostAstar() = default;

/// Found carries the search out of Boost's loop; the path is read from the predecessors.
PeerAnswer BoostAstar::plan(grid::Cell start, grid::Cell goal) {
  State& s = *state_;
  const Grid& grid = s.grid;
  const Vertex from = grid.cells->geometry().index(start);
  const Vertex to = grid.cells->geometry().index(goal);

  const auto weight = boost::make_function_property_map<Edge, double>([&grid](const Edge& e) {
    const grid::Cell a = grid.cell(e.first);
    const grid::Cell b = grid.cell(e.second);
    return a.x != b.x && a.y != b.y ? std::sqrt(2.0) : 1.0;
  });

  const boost::typed_identity_property_map<Vertex> index;
  PeerAnswer answer;

  try {
    boost::astar_search(grid, from, Octile(grid, goal),
                        boost::visitor(StopAtGoal(to, answer.expanded))
                            .predecessor_map(boost::make_iterator_property_map(s.parents.begin(), index))
                            .distance_map(boost::make_iterator_property_map(s.distances.begin(), index))
                            .rank_map(boost::make_iterator_property_map(s.ranks.begin(), index))
                            .color_map(boost::make_iterator_property_map(s.colors.begin(), index))
                            .weight_map(weight)
                            .vertex_index_map(index));
  } catch (const Found&) {
    std::vector<Vertex> path;
    for (Vertex v = to; v != from; v = s.parents[v]) path.push_back(v);
    answer.is_found = !path.empty() || from == to;
    answer.length_cells = s.distances[to];
  }

  return answer;
}

}  // namespace aisle::bench
