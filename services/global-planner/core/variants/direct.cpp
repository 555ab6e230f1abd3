// The quick one: the grid's optimum by jump points, then straightened (P1, P3, P5, P6). No search of the papers is as
// fast on a large map; lengths come near Theta*'s, and are never longer than the grid's optimum.
#include "services/global-planner/core/passes/passes.hpp"
#include "services/global-planner/core/variant.hpp"

namespace aisle::global_planner {

Variant jps();

namespace {

class Direct final : public Planner {
 public:
  void rest() override { on_grid_->rest(); }

 private:
  PlannedPath search(const Problem& problem, const Drivable& drivable, const OutOfTime& out_of_time) override {
    PlannedPath plan = blank();
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

Variant direct() {
  return {
      "direct",
      "jump point search, then collinear points, lines of sight, interpolation forwards and backwards; the quick one",
      false, [](Parameters&) -> std::unique_ptr<Planner> { return std::make_unique<Direct>(); }, true};
}

}  // namespace aisle::global_planner
