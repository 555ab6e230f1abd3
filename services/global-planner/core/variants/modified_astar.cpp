// "Modified A*", WANG's comparator, row G8: f = g + lg(h + 1) h, h Chebyshev. WANG prints no formula for it; this is
// our reading: its own eq. 4 without the weight by distance.
#include "services/global-planner/core/distances.hpp"
#include "services/global-planner/core/logged_chebyshev.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

class Logged {
 public:
  void begin(const Ends& ends) { logged_.begin(ends); }
  std::uint32_t operator()(std::uint32_t cost, grid::Cell cell) const { return evaluated(cost, logged_(cell)); }

 private:
  LoggedChebyshev logged_;
};

}  // namespace

Variant modified_astar() {
  return {"modified-astar", "G8: g + lg(h+1) h, WANG's comparator, no passes", false,
          [] { return best_first<Logged>(Closed::kStay, kDrivableDiagonals, {}); }};
}

}  // namespace aisle::global_planner
