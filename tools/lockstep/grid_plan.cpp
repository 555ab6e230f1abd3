#include "tools/lockstep/grid_plan.hpp"

#include <algorithm>
#include <queue>

#include "common/grid/line_of_sight.hpp"

namespace aisle::lockstep {

using geometry::Point2;
using grid::Cell;

std::vector<Point2> grid_plan(const grid::ClearanceField& clearance, Point2 start, Point2 goal, double radius_m) {
  const grid::Geometry& g = clearance.geometry();
  const Cell from = g.cell_at(start);
  const Cell to = g.cell_at(goal);
  if (!g.contains(from) || !g.contains(to)) return {};
  std::vector<float> cost(g.cells(), 1e30F);
  std::vector<std::uint32_t> parent(g.cells(), 0);
  using Entry = std::pair<float, std::uint32_t>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> open;
  const auto start_index = static_cast<std::uint32_t>(g.index(from));
  cost[start_index] = 0.0F;
  open.push({0.0F, start_index});
  const auto width = static_cast<std::uint32_t>(g.width);
  const auto cell = [&](std::uint32_t i) { return Cell{static_cast<int>(i % width), static_cast<int>(i / width)}; };
  const auto needed = [&](Cell c) { return std::hypot(c.x - from.x, c.y - from.y) * g.resolution_m < 0.6 ? radius_m - 0.08 : radius_m; };
  while (!open.empty()) {
    const auto [f, i] = open.top();
    open.pop();
    const Cell c = cell(i);
    const auto h = [&](Cell a) { return static_cast<float>(std::hypot(a.x - to.x, a.y - to.y)); };
    if (f > cost[i] + h(c) + 1e-3F) continue;
    if (c == to) {
      std::vector<Point2> way{goal};
      for (std::uint32_t j = parent[i]; i != start_index && j != start_index; j = parent[j]) way.push_back(g.center_in_map(cell(j)));
      way.push_back(start);
      std::reverse(way.begin(), way.end());
      std::vector<Point2> out{way.front()};
      for (std::size_t kept = 0; kept + 1 < way.size();) {
        std::size_t next = kept + 1;
        while (next + 1 < way.size() && grid::is_line_free(clearance, way[kept], way[next + 1], radius_m)) ++next;
        out.push_back(way[next]);
        kept = next;
      }
      return out;
    }
    for (int dy = -1; dy <= 1; ++dy)
      for (int dx = -1; dx <= 1; ++dx) {
        const Cell n{c.x + dx, c.y + dy};
        if ((dx == 0 && dy == 0) || !g.contains(n) || clearance.clearance_m(n) < needed(n)) continue;
        const auto k = static_cast<std::uint32_t>(g.index(n));
        const float total = cost[i] + static_cast<float>(std::hypot(dx, dy));
        if (total < cost[k]) cost[k] = total, parent[k] = i, open.push({total + h(n), k});
      }
  }
  return {};
}

}  // namespace aisle::lockstep
