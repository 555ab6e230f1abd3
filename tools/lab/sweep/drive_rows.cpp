#include "tools/lab/sweep/drive_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/geometry/footprint.hpp"
#include "common/geometry/separation.hpp"
#include "tools/sim/scenarios/gap_to_walls.hpp"

namespace aisle::lab {
namespace {

double mean(const std::vector<double>& of) {
  return std::accumulate(of.begin(), of.end(), 0.0) / static_cast<double>(of.size());
}

/// Nearest rank. @pre there is one at least
double quantile(std::vector<double> of, double part) {
  const auto rank = static_cast<std::size_t>(std::ceil(part * static_cast<double>(of.size())));
  const auto at = of.begin() + static_cast<std::ptrdiff_t>(std::max<std::size_t>(rank, 1) - 1);
  std::nth_element(of.begin(), at, of.end());
  return *at;
}

}  // namespace

std::vector<std::string> drive_columns() { return columns_of({drive_figures({}, {})}); }

Row drive_figures(const sim::Totals& totals, const std::vector<double>& compute_us) {
  const bool has_cycles = !compute_us.empty();
  const bool has_least = totals.least_clearance_m < sim::kNothingNearM;
  return {{"goals_assigned", totals.goals_assigned},
          {"goals_reached", totals.goals_reached},
          {"contacts", totals.contacts},
          {"contacts_moving_vehicle", totals.contacts_moving_vehicle},
          {"least_clearance_m", has_least ? finite(totals.least_clearance_m) : Row(nullptr)},
          {"distance_m", finite(totals.distance_m)},
          {"driven_s", finite(totals.driven_s)},
          {"replans", totals.replans},
          {"turn_sign_changes", totals.omega_sign_changes},
          {"jerk_rms", finite(totals.jerk_rms)},
          {"trace_hash", fmt::format("{:016x}", totals.trace_hash)},
          {"compute_us_mean", has_cycles ? finite(mean(compute_us)) : Row(nullptr)},
          {"compute_us_p99", has_cycles ? finite(quantile(compute_us, 0.99)) : Row(nullptr)}};
}

void DriveRows::take(const sim::Cycle& cycle) {
  const std::vector<scenario::Vehicle>& vehicles = setup_.scenario.vehicles;
  const auto vehicle = static_cast<std::size_t>(
      std::find_if(vehicles.begin(), vehicles.end(), [&](const auto& it) { return it.id == cycle.agv_id; }) -
      vehicles.begin());
  if (vehicle == vehicles.size()) return;

  take_plan(cycle, vehicle);
  const geometry::Twist2& twist = cycle.output.twist;
  rows_.push_back({{"kind", "cycle"},
                   {"seed", setup_.seed},
                   {"query", query_},
                   {"agv", cycle.agv_id},
                   {"t_s", cycle.t_s},
                   {"x_m", cycle.base_in_map.x},
                   {"y_m", cycle.base_in_map.y},
                   {"yaw_rad", cycle.base_in_map.yaw},
                   {"v_mps", twist.linear_mps},
                   {"w_radps", twist.angular_radps},
                   {"sideways_mps", twist.sideways_mps},
                   {"clearance_m", finite(clearance_m(cycle, vehicle))},
                   {"compute_us", finite(cycle.compute_us)},
                   {"phase", name(cycle.output.phase)}});
}

/// A plan that is published again under the same id is the same way.
void DriveRows::take_plan(const sim::Cycle& cycle, std::size_t vehicle) {
  const fleet::Plan* plan = cycle.around.plans[vehicle];
  if (plan == nullptr || newest_plan_[cycle.agv_id] == plan->id) return;

  newest_plan_[cycle.agv_id] = plan->id;
  for (std::size_t i = 0; i < plan->waypoints_in_map.size(); ++i)
    rows_.push_back({{"kind", "waypoint"},
                     {"seed", setup_.seed},
                     {"query", query_},
                     {"agv", cycle.agv_id},
                     {"t_s", cycle.t_s},
                     {"x_m", plan->waypoints_in_map[i].x},
                     {"y_m", plan->waypoints_in_map[i].y},
                     {"plan", plan->id},
                     {"index", i}});
}

double DriveRows::clearance_m(const sim::Cycle& cycle, std::size_t vehicle) const {
  const geometry::Body own = geometry::body_of(setup_.scenario.vehicles[vehicle].footprint(), cycle.base_in_map);
  double least_m = sim::gap_to_walls_m(setup_.grid, own, kLookM);

  for (const geometry::Body& thing : cycle.around.things)
    least_m = std::min(least_m, geometry::separation_m(own, thing));

  for (std::size_t i = 0; i < cycle.around.vehicles_in_map.size(); ++i) {
    if (i == vehicle) continue;
    const geometry::Footprint outline = setup_.scenario.vehicles[i].footprint();
    least_m =
        std::min(least_m, geometry::separation_m(own, geometry::body_of(outline, cycle.around.vehicles_in_map[i])));
  }

  return least_m;
}

}  // namespace aisle::lab
