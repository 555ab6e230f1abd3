// A* with the octile distance (Hart, Nilsson, Raphael 1968): optimal among 8-connected paths, and the baseline of the
// others.
#include "services/global-planner/core/best_first.hpp"
#include "services/global-planner/core/distances.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

class Octile {
 public:
  void begin(const Ends& ends) { goal_ = ends.goal; }
  std::uint32_t operator()(std::uint32_t cost, grid::Cell cell) const { return cost + octile(cell, goal_); }

 private:
  grid::Cell goal_;
};

}  // namespace

Variant astar() {
  return {"astar", "G1: g + h, h octile; optimal on the grid, no passes", true,
          [](Parameters&) { return best_first<Octile>(Closed::kReopen, kDrivableDiagonals, {}, Looks::kAhead); }};
}

}  // namespace aisle::global_planner
