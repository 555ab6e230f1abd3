#include <algorithm>

#include "services/local-planner/core/printed/target_rule.hpp"
#include "services/local-planner/core/rolling_window.hpp"

namespace aisle::local_planner {

/// WU's flow chart (figure 7): is a collision predicted on the way along the path, then the improved dynamic window
/// drives to the sub-target of eq. 13; where no bearing is free, to the point of the path, as near as it gets. Else the
/// path is followed.
PrintedTarget target_rules::local_sub_target(const TargetQuestion& question) {
  const Route& path = question.path;
  const geometry::Point2 ahead_in_map =
      path.at(std::min(path.length_m(), question.s_m + question.printed.path_ahead_m));
  const std::size_t next = std::min(path.point_before(question.s_m) + 1, path.points().size() - 1);
  const Window window{question.scene, question.room, path, question.s_m};
  if (meeting_towards(window, ahead_in_map).encounter == Encounter::kNone)
    return {ahead_in_map, ahead_in_map, next, true};

  const geometry::Point2 target_in_map = aisle::local_planner::local_sub_target(window).value_or(ahead_in_map);
  return {target_in_map, target_in_map, next, false};
}

}  // namespace aisle::local_planner
