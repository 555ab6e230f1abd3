#include "tools/lab/planning/subject.hpp"

#include <fmt/format.h>

#include <utility>

#include "common/config/reader.hpp"

namespace aisle::lab {
namespace {

/// The place that was given, else the map's own.
Place place_of(const char* flag, const std::optional<Place>& given, const std::optional<geometry::Point2>& drawn,
               const SubjectOrders& orders) {
  if (!given && !drawn)
    throw config::BadInput(fmt::format("{}: give {} X,Y in metres, --scen FILE, or a text map with start S and goal T",
                                       orders.map.string(), flag));

  return given ? *given : Place{*drawn};
}

}  // namespace

Subject read_subject(const SubjectOrders& orders) {
  LabMap map = read_lab_map(orders.map, orders.cell_m);

  if (!orders.scen.empty()) {
    if (orders.start || orders.goal)
      throw config::BadInput("--scen has starts and goals: leave out --start and --goal");

    std::vector<Query> queries = read_queries(orders.scen, map.grid.geometry(), orders.limit);
    return {std::move(map.grid), std::move(queries)};
  }

  const Place start = place_of("--start", orders.start, map.start_in_map, orders);
  const Place goal = place_of("--goal", orders.goal, map.goal_in_map, orders);

  return {std::move(map.grid), {{start.in_map, goal.in_map, 0.0}}, start.yaw_rad, goal.yaw_rad};
}

}  // namespace aisle::lab
