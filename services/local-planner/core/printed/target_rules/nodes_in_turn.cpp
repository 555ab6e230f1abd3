// QU's key points, YU's path nodes, WANG's turning points: targets one after the other.
#include <algorithm>
#include <cmath>

#include "services/local-planner/core/printed/target_rule.hpp"

namespace aisle::local_planner {
namespace {

constexpr double kTurnRad = 1e-6;  // a smaller change of direction is none

bool is_turning_point(const Route& path, std::size_t i) {
  const auto& nodes = path.points();
  if (i + 1 >= nodes.size()) return true;  // the goal
  const double before_rad = geometry::bearing(nodes[i - 1], nodes[i]);
  const double after_rad = geometry::bearing(nodes[i], nodes[i + 1]);
  return std::abs(geometry::wrap(after_rad - before_rad)) > kTurnRad;
}

/// From `next_node` on, the first node that counts and is not reached; the goal where all are.
template <class Counts>
PrintedTarget next_of(const TargetQuestion& question, const Counts& counts) {
  const auto& nodes = question.path.points();
  const std::size_t last = nodes.size() - 1;
  const geometry::Point2 here = question.scene.base_in_map.position();
  std::size_t next = std::min(std::max<std::size_t>(question.next_node, 1), last);
  while (next < last && (!counts(next) || geometry::distance(here, nodes[next]) < question.printed.next_target_m))
    ++next;
  return {nodes[next], nodes[next], next, false};
}

}  // namespace

PrintedTarget target_rules::path_nodes(const TargetQuestion& question) {
  return next_of(question, [](std::size_t) { return true; });
}

PrintedTarget target_rules::turning_points(const TargetQuestion& question) {
  return next_of(question, [&](std::size_t i) { return is_turning_point(question.path, i); });
}

}  // namespace aisle::local_planner
