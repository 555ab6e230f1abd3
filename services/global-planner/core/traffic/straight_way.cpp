#include "services/global-planner/core/traffic/straight_way.hpp"

#include <algorithm>

#include "common/grid/line_of_sight.hpp"

namespace aisle::global_planner::traffic {

bool is_straight_way_free(const grid::ClearanceField& clearance, geometry::Point2 a, geometry::Point2 b,
                          double need_m) {
  if (is_line_free(clearance, a, b, need_m)) return true;

  const double at_a_m = clearance.clearance_m(a);
  const double at_b_m = clearance.clearance_m(b);
  if (at_a_m <= 0.0 || at_b_m <= 0.0 || (at_a_m >= need_m && at_b_m >= need_m)) return false;

  const double length_m = distance(a, b);
  const auto at = [&](double along_m) { return a + (length_m > 0.0 ? along_m / length_m : 0.0) * (b - a); };
  const double begin_m = at_a_m < need_m ? std::min(need_m, length_m) : 0.0;
  const double end_m = std::max(begin_m, at_b_m < need_m ? length_m - need_m : length_m);
  constexpr double kRoundingM = 1e-6;

  if (begin_m > 0.0 && !is_line_free(clearance, a, at(begin_m), std::min(at_a_m, need_m) - kRoundingM)) return false;
  if (end_m > begin_m && !is_line_free(clearance, at(begin_m), at(end_m), need_m)) return false;
  return end_m >= length_m || is_line_free(clearance, at(end_m), b, std::min(at_b_m, need_m) - kRoundingM);
}

}  // namespace aisle::global_planner::traffic
