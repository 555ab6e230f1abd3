// Each search against its paper's formula, written down again here and searched plainly: both expand the same cells.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "services/global-planner/core/planner.hpp"
#include "services/global-planner/core/search_memory.hpp"
#include "services/global-planner/core/traditional_astar.hpp"
#include "services/global-planner/core/variant.hpp"
#include "tests/support/random_grid.hpp"

namespace aisle::global_planner {
namespace {

using grid::Cell;

/// A map of cells of 1 m; a search from the lower left to the upper right corner.
struct World {
  grid::OccupancyGrid grid;
  Cell start, goal;

  bool is_free(Cell cell) const { return grid.geometry().contains(cell) && grid.is_free(cell); }
};

// Distances in cells.
double euclid(Cell a, Cell b) { return std::hypot(a.x - b.x, a.y - b.y); }
double manhattan(Cell a, Cell b) { return std::abs(a.x - b.x) + std::abs(a.y - b.y); }
double chebyshev_cells(Cell a, Cell b) { return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)); }

/// YU eq. 5: the share of obstacles in the rectangle from n to t, both included.
double obstacle_rate(const World& world, Cell n) {
  const Cell t = world.goal;
  double cells = 0.0, obstacles = 0.0;
  for (int y = std::min(n.y, t.y); y <= std::max(n.y, t.y); ++y)
    for (int x = std::min(n.x, t.x); x <= std::max(n.x, t.x); ++x) {
      cells += 1.0;
      obstacles += world.is_free({x, y}) ? 0.0 : 1.0;
    }
  return obstacles / cells;
}

/// QU eq. 4, clamped to [0, 1]; d_t is at least a cell.
double qu_weight(const World& world, Cell n) {
  const double to_goal = std::max(euclid(n, world.goal), 1.0);
  const double share = euclid(n, world.start) / to_goal + to_goal / euclid(world.start, world.goal);
  return std::clamp(1.0 - std::log(share), 0.0, 1.0);
}

/// WANG eq. 4 without its weight by distance.
double logged(const World& world, Cell n) {
  const double h = chebyshev_cells(n, world.goal);
  return std::log10(h + 1.0) * h;
}

/// d_t/D.
double way_left(const World& world, Cell n) { return euclid(n, world.goal) / euclid(world.start, world.goal); }

enum class Diagonals { kNone, kBesideOpenCells, kAny };

/// h of f = g + h, in cells, and how the search goes on.
struct Formula {
  std::string name;
  std::function<double(const World&, Cell)> h;
  bool reopens;  // expands a cell again that it reaches at a lower cost
  Diagonals diagonals;
};

void PrintTo(const Formula& formula, std::ostream* out) { *out << formula.name; }

struct Searched {
  std::size_t expanded{0};
  double length_m{0.0};
};

/// Best-first search as in a textbook, the open list a plain list. Ranks are as coarse as BucketQueue's, and among
/// equals the newest goes first, so that ties are broken as there.
class PlainSearch {
 public:
  PlainSearch(const World& world, const Formula& formula) : world_(world), formula_(formula) {
    costs_.assign(world.grid.geometry().cells(), kUnknown);
    is_closed_.assign(costs_.size(), false);
  }

  Searched run() {
    reach(world_.start, 0);
    std::uint32_t found = kUnknown;
    Searched searched;
    while (!open_.empty()) {
      const Entry entry = pop();
      if (found != kUnknown && entry.rank > BucketQueue::rank_of(found)) break;
      const std::size_t at = world_.grid.geometry().index(entry.cell);
      if (is_closed_[at] || costs_[at] != entry.cost) continue;
      is_closed_[at] = true;
      if (entry.cell == world_.goal) {
        found = entry.cost;
        if (!formula_.reopens) break;
        continue;
      }
      if (found != kUnknown && evaluated(entry.cost, entry.cell) >= found) continue;
      ++searched.expanded;
      expand(entry);
    }
    if (found != kUnknown) searched.length_m = static_cast<double>(found) / kStraightCost;
    return searched;
  }

 private:
  struct Entry {
    Cell cell;
    std::uint32_t cost, rank;
  };

  std::uint32_t evaluated(std::uint32_t cost, Cell cell) const {
    return cost + static_cast<std::uint32_t>(formula_.h(world_, cell) * kStraightCost);
  }

  void reach(Cell cell, std::uint32_t cost) {
    const std::size_t at = world_.grid.geometry().index(cell);
    costs_[at] = cost;
    is_closed_[at] = false;
    open_.push_back({cell, cost, BucketQueue::rank_of(evaluated(cost, cell))});
  }

  /// Of the lowest rank, the newest.
  Entry pop() {
    std::size_t best = open_.size() - 1;
    for (std::size_t i = open_.size(); i-- > 0;)
      if (open_[i].rank < open_[best].rank) best = i;
    const Entry entry = open_[best];
    open_.erase(open_.begin() + static_cast<std::ptrdiff_t>(best));
    return entry;
  }

  void expand(const Entry& entry) {
    static constexpr int kAround[8][2]{{1, 0}, {0, 1}, {-1, 0}, {0, -1}, {1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    for (const auto& [dx, dy] : kAround) {
      const Cell next{entry.cell.x + dx, entry.cell.y + dy};
      if (!world_.is_free(next) || !may_step(entry.cell, dx, dy)) continue;
      const std::size_t at = world_.grid.geometry().index(next);
      const std::uint32_t cost = entry.cost + (dx != 0 && dy != 0 ? kDiagonalCost : kStraightCost);
      if (cost >= costs_[at] || (is_closed_[at] && !formula_.reopens)) continue;
      reach(next, cost);
    }
  }

  bool may_step(Cell from, int dx, int dy) const {
    if (dx == 0 || dy == 0 || formula_.diagonals == Diagonals::kAny) return true;
    return formula_.diagonals == Diagonals::kBesideOpenCells && world_.is_free({from.x + dx, from.y}) &&
           world_.is_free({from.x, from.y + dy});
  }

  static constexpr std::uint32_t kUnknown = std::numeric_limits<std::uint32_t>::max();

  const World& world_;
  const Formula& formula_;
  std::vector<std::uint32_t> costs_;
  std::vector<bool> is_closed_;
  std::vector<Entry> open_;
};

std::unique_ptr<Planner> planner_named(const std::string& name) {
  if (name == "traditional, Euclidean") return traditional_astar(Heuristic::kEuclidean);
  if (name == "traditional, Chebyshev") return traditional_astar(Heuristic::kChebyshev);
  if (name == "traditional, four moves") return traditional_astar(Heuristic::kEuclidean, Moves::kFour);
  Parameters bare;
  bare.set("passes", "none");
  return find_variant(name)->make(bare);
}

std::vector<Formula> formulas() {
  const auto euclidean = [](const World& world, Cell n) { return euclid(n, world.goal); };
  const auto chebyshev = [](const World& world, Cell n) { return chebyshev_cells(n, world.goal); };
  const auto li = [](const World& world, Cell n) { return (1.0 + way_left(world, n)) * euclid(n, world.goal); };
  const auto qu = [](const World& world, Cell n) { return qu_weight(world, n) * euclid(n, world.goal); };
  const auto yu = [](const World& world, Cell n) {
    return std::exp(obstacle_rate(world, n)) * (euclid(n, world.goal) + 0.5 * manhattan(n, world.goal)) / 2.0;
  };
  const auto wang = [](const World& world, Cell n) { return (1.0 + way_left(world, n)) * logged(world, n); };
  return {{"traditional, Euclidean", euclidean, true, Diagonals::kAny},
          {"traditional, Chebyshev", chebyshev, true, Diagonals::kAny},
          {"traditional, four moves", euclidean, true, Diagonals::kNone},
          {"li", li, false, Diagonals::kBesideOpenCells},
          {"wu", euclidean, true, Diagonals::kBesideOpenCells},
          {"qu", qu, true, Diagonals::kBesideOpenCells},
          {"yu", yu, false, Diagonals::kBesideOpenCells},
          {"wang", wang, false, Diagonals::kBesideOpenCells},
          {"modified-astar", logged, false, Diagonals::kBesideOpenCells}};
}

class PrintedFormula : public testing::TestWithParam<Formula> {};

TEST_P(PrintedFormula, ExpandsWhatAPlainSearchByItExpands) {
  const std::unique_ptr<Planner> planner = planner_named(GetParam().name);
  double ours = 0.0, plain = 0.0, ours_m = 0.0, plain_m = 0.0;
  int found = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    std::mt19937 random(seed);
    const int blocks = test_support::random_between(random, 8, 19);
    const World world{test_support::random_blocks(random, 20, blocks, 4), {0, 0}, {19, 19}};
    const grid::ClearanceField clearance(world.grid, 20.0);
    const PlannedPath plan = planner->plan({clearance, {0.5, 0.5}, {19.5, 19.5}}, nullptr);
    if (plan.outcome != Outcome::kFound) continue;
    ++found;
    const Searched searched = PlainSearch(world, GetParam()).run();
    ours += static_cast<double>(plan.expanded), plain += static_cast<double>(searched.expanded);
    ours_m += plan.length_m, plain_m += searched.length_m;
  }
  EXPECT_GT(found, 30);
  EXPECT_NEAR(ours, plain, 0.005 * plain) << "but for rounding";
  EXPECT_NEAR(ours_m, plain_m, 0.001 * plain_m);
}

INSTANTIATE_TEST_SUITE_P(OfEachPaper, PrintedFormula, testing::ValuesIn(formulas()), [](const auto& formula) {
  std::string name = formula.param.name;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; }, '_');
  return name;
});

// LI table II: 18.00 and 38.00 from corner to corner are lengths of four moves.
TEST(TraditionalAStar, OfFourMovesHasTheLengthsThatLiPrints) {
  const std::unique_ptr<Planner> planner = traditional_astar(Heuristic::kEuclidean, Moves::kFour);
  for (const int edge : {10, 20}) {
    const grid::ClearanceField clearance(grid::OccupancyGrid(grid::Geometry{edge, edge, 1.0, {}}), 20.0);
    const PlannedPath plan = planner->plan({clearance, {0.5, 0.5}, {edge - 0.5, edge - 0.5}}, nullptr);
    EXPECT_DOUBLE_EQ(plan.length_m, 2.0 * (edge - 1));
  }
}

}  // namespace
}  // namespace aisle::global_planner
