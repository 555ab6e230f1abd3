// Jump points, then every pass that makes the path shorter: the optimum of the grid in the least time, pulled tight. No paper's own;
// for who wants short paths quickly.
#include <memory>

#include "services/global-planner/core/passes/passes.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {

Variant jps();

namespace {

class SmoothedJumpPoints final : public Planner {
 public:
  void rest() override { on_grid_->rest(); }

 private:
  Plan search(const Problem& problem, const Drivable& drivable, const OutOfTime& out_of_time) override {
    Plan plan = blank();
    on_grid_->plan(problem, out_of_time, plan);
    if (plan.outcome != Outcome::kFound) return plan;
    passes::collinear(drivable, plan.waypoints_in_map);
    passes::greedy_line_of_sight(drivable, plan.waypoints_in_map);
    passes::interpolated_forward(drivable, plan.waypoints_in_map);
    passes::interpolated_backward(drivable, plan.waypoints_in_map);
    return plan;
  }

  std::unique_ptr<Planner> on_grid_{jps().make()};
};

}  // namespace

Variant jps_smooth() {
  return {"jps-smooth", "jump point search, then collinear points, lines of sight, and interpolation forwards and backwards", false,
          []() -> std::unique_ptr<Planner> { return std::make_unique<SmoothedJumpPoints>(); }, true};
}

}  // namespace aisle::global_planner
