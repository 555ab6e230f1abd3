#include <algorithm>
#include <cmath>

#include "services/local-planner/core/printed/target_rule.hpp"

namespace aisle::local_planner {

using geometry::Point2;

/// LI eq. 10: heading looks to the goal, Yheading to G_i, "the subgoal point closest to the global planning path". Read
/// as the nearest of the path's points, one a cell, that is not reached yet: a point beside or behind the vehicle would
/// turn it back.
PrintedTarget target_rules::nearest_path_point(const TargetQuestion& question) {
  const Route& path = question.path;
  const double step_m = question.printed.path_step_m;
  const Point2 here = question.scene.base_in_map.position();
  double s_m = std::ceil(question.s_m / step_m) * step_m;
  while (s_m < path.length_m() && geometry::distance(here, path.at(s_m)) < question.printed.next_target_m)
    s_m += step_m;
  s_m = std::min(s_m, path.length_m());
  return {path.points().back(), path.at(s_m), std::min(path.point_before(s_m) + 1, path.points().size() - 1), false};
}

}  // namespace aisle::local_planner
