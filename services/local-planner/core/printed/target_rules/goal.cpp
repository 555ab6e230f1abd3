#include "services/local-planner/core/printed/target_rule.hpp"

namespace aisle::local_planner {

/// Fox, Burgard, Thrun 1997; WU eq. 4, LI eq. 8, QU eq. 10 without a path.
PrintedTarget target_rules::goal(const TargetQuestion& question) {
  const geometry::Point2 goal_in_map = question.path.points().back();
  return {goal_in_map, goal_in_map, question.path.points().size() - 1, false};
}

}  // namespace aisle::local_planner
