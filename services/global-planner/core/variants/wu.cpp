// WU: "smoothing A*", row G4 with passes P1, P5 and P6: plain A* with the Euclidean distance, smoothed forwards and
// backwards.
#include "services/global-planner/core/best_first.hpp"
#include "services/global-planner/core/distances.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {
namespace {

class Euclidean {
 public:
  void begin(const Ends& ends) { goal_ = ends.goal; }
  std::uint32_t operator()(std::uint32_t cost, grid::Cell cell) const { return cost + euclidean(cell, goal_); }

 private:
  grid::Cell goal_;
};

}  // namespace

Variant wu() {
  return {"wu", "WU: g + h, then collinear points and interpolation forwards and backwards", false,
          [] {
            return best_first<Euclidean>(
                Closed::kReopen, kDrivableDiagonals,
                {passes::collinear, passes::interpolated_forward, passes::interpolated_backward});
          },
          true};
}

}  // namespace aisle::global_planner
